"""The list of recently opened files, shared by all runs of viewer and editor.

In: paths. Out: the same, latest first, without missing files. The list is only a convenience: a
damaged one gives a warning, and a failure to write is ignored.
"""

from __future__ import annotations

import contextlib
import json
import os
from pathlib import Path

from ...base.files import json_records
from ...base.files.atomic_write import atomic_write
from ...base.system import decoded_name
from ...errors import FileAccessError, FileFormatError, warn
from .user_folders import user_path

MOST = 20
_LIST = json_records.listed(json_records.path_text)
_LARGEST = 1 << 20  # bytes


class RecentFiles:
    """The list of recently opened files, stored in a file.

    Parameters
    ----------
    path : path-like, optional
        The list; the one that the user's programs share if left out.
    """

    def __init__(self, path: str | os.PathLike[str] | None = None) -> None:
        self._path = user_path("state", "recent.json") if path is None else Path(path)
        # Earlier viewers kept their own list, one path per line.
        self._earlier = user_path("state", "recent-files") if path is None else None
        self._told = False

    def paths(self) -> tuple[str, ...]:
        """Return the paths of the existing files, latest first."""
        return tuple(path for path in self._stored() if os.path.isfile(path))[:MOST]

    def add(self, *paths: str | os.PathLike[str]) -> None:
        """Put files at the top, the first of them first."""
        added = [os.path.abspath(os.fsdecode(path)) for path in paths if os.path.isfile(path)]
        if added:
            self._store(list(dict.fromkeys([*added, *self._stored()]))[:MOST])

    def clear(self) -> None:
        """Remove all entries."""
        self._store([])

    def _stored(self) -> list[str]:
        return list(dict.fromkeys([*self._listed(), *_lines(self._earlier)]))

    def _listed(self) -> list[str]:
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
            if self._earlier is not None:
                self._earlier.unlink(missing_ok=True)


def _lines(path: Path | None) -> list[str]:
    """Return the lines of a file, if it can be read."""
    try:
        text = b"" if path is None else json_records.read_small(path, _LARGEST)
    except (FileAccessError, FileFormatError):
        return []
    return [decoded_name(line) for line in text.splitlines() if b"\0" not in line]
