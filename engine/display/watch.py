"""Tells when a file has been written anew.

In: a path. Out: True once after each change, when the file's stamp has settled.
"""

from __future__ import annotations

import time

from ..file_states import file_stamp, was_written

#: How often the file is looked at.
CHECK_SECONDS = 0.25


class FileWatch:
    """Watches one file, or none.

    Parameters
    ----------
    path : path-like or None
        The file.
    """

    def __init__(self, path):
        self.follow(path)

    def follow(self, path) -> None:
        """Watch another file from now on; None watches nothing."""
        self.path = path
        self._seen = self._pending = self._stamp()
        self._next_check = time.monotonic() + CHECK_SECONDS

    def changed(self) -> bool:
        """Return whether the file has changed since it was last looked at, and is complete.

        A file whose stamp still moves between two checks is being written: it is not reported yet.
        """
        if self.path is None or time.monotonic() < self._next_check:
            return False
        self._next_check = time.monotonic() + CHECK_SECONDS
        stamp = self._stamp()
        settled = stamp == self._pending
        self._pending = stamp
        if stamp is None or not settled:
            return False
        seen, self._seen = self._seen, stamp
        return was_written(seen, stamp)

    def _stamp(self):
        if self.path is None:
            return None
        return file_stamp(self.path)
