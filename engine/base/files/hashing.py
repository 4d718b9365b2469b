"""Hashes of files.

In: a path. Out: a hash, read in pieces to save memory. Anything but a regular file is an error: a
FIFO might never get a writer.
"""

from __future__ import annotations

import errno
import os
import stat
from typing import Any

from ..system import AT_ONCE

_PIECE = 1 << 20


def hash_of_file(path: str | os.PathLike[str], digest: Any) -> str:
    """Return the hash of a file as hexadecimal digits, computed by a `hashlib` object.

    Raises
    ------
    OSError
        The file cannot be read, or is not a regular file.
    """
    _check(os.stat(path), path)  # opening and closing a FIFO would kill its writer
    with open(path, "rb", opener=_opened_at_once) as file:
        _check(os.fstat(file.fileno()), path)
        while piece := file.read(_PIECE):
            digest.update(piece)
    return digest.hexdigest()


def _check(status: os.stat_result, path: str | os.PathLike[str]) -> None:
    if not stat.S_ISREG(status.st_mode):
        raise OSError(errno.EINVAL, "not a regular file", os.fspath(path))


def _opened_at_once(path: str, flags: int) -> int:
    return os.open(path, flags | AT_ONCE)
