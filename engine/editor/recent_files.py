"""The files that were opened lately, over all runs of the editor.

In: paths. Out: the same, the latest first, of those that are still there. What is stored is only
for convenience: a list that is damaged is a warning, one that cannot be written nothing at all.
"""

from __future__ import annotations

import contextlib
import json
import os
from pathlib import Path

from ..errors import FileAccessError, FileFormatError, warn
from ..files import json_records
from ..files.atomic_write import atomic_write
from .user_folders import state_folder

MOST = 20
_LIST = json_records.listed(json_records.path_text)


class RecentFiles:
    """A list of paths in a file.

    Parameters
    ----------
    path : path-like, optional
        The list; ``recent.json`` in the user's folder if left out.
    """

    def __init__(self, path: str | os.PathLike[str] | None = None) -> None:
        self._path = state_folder() / "recent.json" if path is None else Path(path)
        self._told = False

    def paths(self) -> tuple[str, ...]:
        """Return the paths of the files that are there, the latest first."""
        return tuple(path for path in self._stored() if os.path.isfile(path))

    def add(self, path: str | os.PathLike[str]) -> None:
        """Put a path at the top."""
        added = os.path.abspath(os.fspath(path))
        self._store([added, *(other for other in self._stored() if other != added)][:MOST])

    def clear(self) -> None:
        """Forget all of them."""
        self._store([])

    def _stored(self) -> list[str]:
        if not os.path.lexists(self._path):
            return []
        try:
            return json_records.read_json(self._path, _LIST)[:MOST]
        except (FileAccessError, FileFormatError) as error:
            if not self._told:
                warn(f"{error}: the list of recent files begins anew")
            self._told = True
            return []

    def _store(self, paths: list[str]) -> None:
        with contextlib.suppress(OSError, FileAccessError):
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with atomic_write(self._path) as file:
                file.write(json.dumps(paths, indent=1).encode("ascii"))
