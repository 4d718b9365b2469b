"""The files that were opened lately, over all runs of the editor.

In: paths. Out: the same, the latest first, of those that are still there. What is stored is only
for convenience: a list that is damaged or cannot be written is no error.
"""

from __future__ import annotations

import contextlib
import json
import os
from pathlib import Path

from ..errors import FileAccessError
from ..files.atomic_write import atomic_write
from .user_folders import state_folder

MOST = 20


class RecentFiles:
    """A list of paths in a file.

    Parameters
    ----------
    path : path-like, optional
        The list; ``recent.json`` in the user's folder if left out.
    """

    def __init__(self, path: str | os.PathLike[str] | None = None) -> None:
        self._path = state_folder() / "recent.json" if path is None else Path(path)

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
        try:
            paths = json.loads(self._path.read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            return []
        is_list = isinstance(paths, list)
        return [path for path in paths if isinstance(path, str)][:MOST] if is_list else []

    def _store(self, paths: list[str]) -> None:
        with contextlib.suppress(OSError, FileAccessError):
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with atomic_write(self._path) as file:
                file.write(json.dumps(paths, indent=1).encode("ascii"))
