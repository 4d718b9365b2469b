"""Detects when a file is rewritten or deleted.

In: a path. Out: True once after each change, when the file's stamp has settled.
"""

from __future__ import annotations

import os
import time

from .stamps import file_stamp, was_written

#: Seconds between checks.
CHECK_SECONDS = 0.25


class FileWatch:
    """Watches one file for changes.

    Parameters
    ----------
    path : path-like
        The file.

    Attributes
    ----------
    missing : bool
        Whether the file was missing at the last check.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = path
        self._seen = self._pending = file_stamp(path)
        self._next_check = time.monotonic() + CHECK_SECONDS

    @property
    def missing(self) -> bool:
        return self._seen is None

    def changed(self) -> bool:
        """Return whether the file was written, appeared or disappeared since the last report.

        A file whose stamp changes between two checks is still being written, and is not reported
        yet. Nor is a file that is missing only briefly, as during a rename.
        """
        if time.monotonic() < self._next_check:
            return False
        self._next_check = time.monotonic() + CHECK_SECONDS
        stamp = file_stamp(self.path)
        settled = stamp == self._pending
        self._pending = stamp
        if not settled:
            return False
        seen, self._seen = self._seen, stamp
        return was_written(seen, stamp)
