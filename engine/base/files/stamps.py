"""Stamps: tell whether a file changed, without reading it if possible.

In: paths. Out: stamps, and whether a file was written between two of them: size, time of writing or
place on the disk differ then, or the time of the last change of any kind does, which no program can
set back, and not because of other permissions, owners or links. File systems count time in steps,
and what is written twice within one keeps its stamp: a file that had only just changed when it was
looked at is therefore read once more when that step is surely over.
"""

from __future__ import annotations

import hashlib
import os
import time
from typing import NamedTuple

from .hashing import hash_of_file

_STEP = 2 * 10**9  # nanoseconds; FAT has the longest step


class FileStamp(NamedTuple):
    """The system's data on a file; times are in nanoseconds."""

    size: int
    inode: int
    written: int
    changed: int
    rights: tuple[int, ...]  # permissions, owner, group, links: these change, too


def file_stamp(path: str | os.PathLike[str]) -> FileStamp | None:
    """Return what differs once a file was written; None if there is no such file."""
    try:
        status = os.stat(path)
    except (OSError, ValueError):
        return None
    rights = status.st_mode, status.st_uid, status.st_gid, status.st_nlink
    times = status.st_mtime_ns, status.st_ctime_ns
    return FileStamp(status.st_size, status.st_ino, *times, rights)


def was_written(then: FileStamp | None, now: FileStamp | None) -> bool:
    """Whether the file came, went or was written between two stamps."""
    if then is None or now is None:
        return then is not now
    return then[:3] != now[:3] or (then.changed != now.changed and then.rights == now.rights)


class FileState:
    """A file as it is when this is made; whoever reads it afterwards misses no change.

    Parameters
    ----------
    path : path-like
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = path
        self._stamp = file_stamp(path)
        self._content = _digest(path) if self._is_young() else None

    def changed(self) -> bool:
        """Whether the file is another now; within two seconds of a change, it may take so long."""
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
    try:
        return hash_of_file(path, hashlib.blake2b(digest_size=20))
    except OSError:
        return None
