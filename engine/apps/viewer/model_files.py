"""The model files that the viewer shows: what opens them again, and what has become of them.

In: paths, and how the command line said to open them. Out: scenes to view; whether files were
written or went away meanwhile.
"""

from __future__ import annotations

import os
from collections.abc import Sequence

from ...base.files.watch import FileWatch
from ...io.loaders import formats
from ...stage.open_models import open_models
from ...stage.played_clips import play_clips
from ...stage.viewed_scene import ViewedScene

#: Names of model files end so, in lower case.
MODEL_EXTENSIONS = tuple(end for kind in formats("mesh") for end in kind.extensions)


class ModelFiles:
    """The files that are shown.

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
        """Open other files, which take the place of these if they can be read."""
        viewed = open_models(paths, animation=play_clips, **self._always)
        self._options = {}
        self._follow(paths)
        return viewed

    def first(self) -> str | None:
        """Return the absolute path of the first of the files that is there, or None."""
        here = next((path for path in self.paths if os.path.isfile(path)), None)
        return None if here is None else os.path.abspath(os.fsdecode(here))

    def beside(self, step: int) -> str | None:
        """Return the path of the next model of the list or the folder, or of one before, or None.

        Called again, it goes on from there, even if that file could not be opened.
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
        """Open the same files again, as they were opened first."""
        return open_models(self.paths, **self._always, **self._options)

    def changed(self) -> bool:
        """Return whether one of the files was written, came or went since it was last looked at."""
        changed = [file.changed() for file in self._files]  # all of them: each tells it once
        return any(changed)

    def missing(self) -> list[str]:
        """Return the names of the files that were not there when they were last looked at."""
        return [os.path.basename(file.path) for file in self._files if file.missing]
