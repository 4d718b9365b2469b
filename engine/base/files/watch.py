"""Tells when a file has been written anew, or is gone.

In: a path. Out: True once after each change, when the file's stamp has settled.
"""

from __future__ import annotations

import os
import time

from .stamps import file_stamp, was_written

#: How often the file is looked at.
CHECK_SECONDS = 0.25


class FileWatch:
    """Watches one file.

    Parameters
    ----------
    path : path-like
        The file.

    Attributes
    ----------
    missing : bool
        Whether it was not there when it was last looked at.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = path
        self._seen = self._pending = file_stamp(path)
        self._next_check = time.monotonic() + CHECK_SECONDS

    @property
    def missing(self) -> bool:
        return self._seen is None

    def changed(self) -> bool:
        """Return whether the file was written, came or went since it was last looked at.

        A file whose stamp still moves between two checks is being written: it is not reported yet.
        Nor is one that is away for so short a time, as when another takes its name.
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
