"""File stamps: detect whether a file changed, if possible without reading it.

In: paths. Out: stamps, and whether a file was written between two of them. A write changes the
size, the time of writing, the place on the disk, or at least the time of the last change, which no
program can set back; changes of permissions, owners or links alone do not count. File systems count
time in steps, and two writes within one step give the same stamp: so a file that had just changed
when it was checked is read again after that step is surely over.
"""

from __future__ import annotations

import os
import time
from typing import NamedTuple

from .hashing import hash_of_file

_STEP = 2 * 10**9  # nanoseconds; FAT has the longest step


class FileStamp(NamedTuple):
    """A file's metadata from the system; times are in nanoseconds."""

    size: int
    inode: int
    written: int
    changed: int
    # permissions, owner, group, links: they also change the time of the last change
    rights: tuple[int, ...]


def file_stamp(path: str | os.PathLike[str]) -> FileStamp | None:
    """Return a stamp that differs after a file is written; None if there is no such file."""
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    rights = status.st_mode, status.st_uid, status.st_gid, status.st_nlink
    times = status.st_mtime_ns, status.st_ctime_ns
    return FileStamp(status.st_size, status.st_ino, *times, rights)


def was_written(then: FileStamp | None, now: FileStamp | None) -> bool:
    """Return whether the file appeared, disappeared or was written between two stamps."""
    if then is None or now is None:
        return then is not now
    return then[:3] != now[:3] or (then.changed != now.changed and then.rights == now.rights)


class FileState:
    """The state of a file at creation; a reader that starts afterwards misses no change.

    Parameters
    ----------
    path : path-like
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = path
        self._stamp = file_stamp(path)
        self._content = _digest(path) if self._is_young() else None

    def changed(self) -> bool:
        """Return whether the file has changed; this may take two seconds right after a change."""
        stamp = file_stamp(self._path)
        if was_written(self._stamp, stamp):
            return True
        self._stamp = stamp
        if self._content is None or self._is_young():
            return False
        content, self._content = self._content, None
        return _digest(self._path) != content

    def _is_young(self) -> bool:
        now = time.time_ns()
        stamp = self._stamp
        times = () if stamp is None else (stamp.written, stamp.changed)
        return any(abs(now - at) < _STEP for at in times)


def _digest(path: str | os.PathLike[str]) -> str | None:
    import hashlib  # here, because it takes milliseconds

    try:
        return hash_of_file(path, hashlib.blake2b(digest_size=20))
    except OSError:
        return None
