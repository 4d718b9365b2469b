"""What tells whether a file is another than it was, without reading it where that can be helped.

In: paths. Out: stamps, which differ where size, times or place on the disk do; the time of the last
change of any kind is among them, which no program can set back. File systems count time in steps,
and what is written twice within one keeps its stamp: a file that had only just changed when it was
looked at is therefore read once more when that step is surely over.
"""

from __future__ import annotations

import hashlib
import os
import time

_STEP = 2 * 10**9  # nanoseconds; FAT has the longest step


def file_stamp(path: str | os.PathLike) -> tuple | None:
    """Return what differs once a file was written; None if there is no such file."""
    try:
        status = os.stat(path)
    except OSError:
        return None
    return status.st_size, status.st_ino, status.st_mtime_ns, status.st_ctime_ns


class FileState:
    """A file as it is when this is made; whoever reads it afterwards misses no change.

    Parameters
    ----------
    path : path-like
    """

    def __init__(self, path: str | os.PathLike) -> None:
        self._path = path
        self._stamp = file_stamp(path)
        readable = self._is_young() and os.path.isfile(path)  # not a FIFO
        self._content = _digest(path) if readable else None

    def changed(self) -> bool:
        """Whether the file is another now; within two seconds of a change, it may take so long."""
        if file_stamp(self._path) != self._stamp:
            return True
        if self._content is None or self._is_young():
            return False
        content, self._content = self._content, None
        return _digest(self._path) != content

    def _is_young(self) -> bool:
        now = time.time_ns()
        return self._stamp is not None and any(abs(now - at) < _STEP for at in self._stamp[2:])


def _digest(path: str | os.PathLike) -> bytes | None:
    digest = hashlib.blake2b(digest_size=20)
    try:
        with open(path, "rb") as file:
            while piece := file.read(1 << 20):
                digest.update(piece)
    except OSError:
        return None
    return digest.digest()
