"""The model files that the viewer shows, with their options and changes.

In: paths, and options for opening them. Out: scenes to view; whether files were written or deleted
meanwhile.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

from ...base.files.watch import FileWatch
from ...io.loaders import formats
from ...stage.open_models import open_models
from ...stage.played_clips import play_clips
from ...stage.viewed_scene import ViewedScene

#: Extensions of model files, in lower case.
MODEL_EXTENSIONS = tuple(end for kind in formats("mesh") for end in kind.extensions)


class ModelFiles:
    """The shown files.

    Parameters
    ----------
    paths : sequence of path-like
        May be empty: a scene of no file's.
    listed : sequence of path-like
        What `beside` goes through, rather than the folder.
    watch : bool
        Look whether they change.
    remembered : bool
        Whether files that are opened are remembered (`RecentFiles`).
    side_by_side, up
        As in `open_models`, for files that are dropped, too.
    **options
        More options of `open_models`, for these files only.
    """

    def __init__(
        self,
        paths: Sequence = (),
        *,
        listed: Sequence = (),
        watch: bool = False,
        remembered: bool = False,
        side_by_side: bool = False,
        up: str | None = None,
        **options,
    ):
        self._always = {"side_by_side": side_by_side, "up": up}
        self._options = options
        self._listed = [os.path.abspath(os.fsdecode(path)) for path in listed]
        self._watches = watch
        self.remembered = remembered
        self._follow(paths)

    def _follow(self, paths: Sequence) -> None:
        self.paths = tuple(paths)
        self._tried: str | None = None
        self._files = [FileWatch(path) for path in self.paths] if self._watches else []

    def replace(self, paths: Sequence) -> ViewedScene:
        """Open other files, which replace these if they can be read."""
        viewed = open_models(paths, animation=play_clips, **self._always)
        self._options = {}
        self._follow(paths)
        return viewed

    def first(self) -> str | None:
        """Return the absolute path of the first existing file, or None."""
        here = next((path for path in self.paths if os.path.isfile(path)), None)
        return None if here is None else os.path.abspath(os.fsdecode(here))

    def beside(self, step: int) -> str | None:
        """Return the path of the next or previous model in the list or folder, or None.

        Repeated calls continue from there, even if that file could not be opened.
        """
        here = self._tried or self.first()
        if here is None:
            return None
        here = os.path.abspath(here)
        if here in self._listed:
            place = (self._listed.index(here) + step) % len(self._listed)
            self._tried = self._listed[place]
            return self._tried
        folder, name = os.path.split(here)
        names = {entry for entry in os.listdir(folder) if entry.lower().endswith(MODEL_EXTENSIONS)}
        names = sorted(names | {name}, key=lambda entry: (entry.lower(), entry))
        if len(names) == 1:
            return None
        following = names[(names.index(name) + step) % len(names)]
        self._tried = os.path.join(folder, following)
        return self._tried

    def reload(self) -> ViewedScene:
        """Reopen the same files with the same options."""
        return open_models(self.paths, **self._always, **self._options)

    def changed(self) -> bool:
        """Return whether a file was written, appeared or disappeared since the last check."""
        # check all, since each reports a change only once
        changed = [file.changed() for file in self._files]
        return any(changed)

    def missing(self) -> list[str]:
        """Return the names of the files that were missing at the last check."""
        return [os.path.basename(file.path) for file in self._files if file.missing]
