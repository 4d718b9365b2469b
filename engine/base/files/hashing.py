"""Hashes of what files hold.

In: a path. Out: a hash, read piece by piece, so that it needs little memory. What is no file, such
as a FIFO, is an error: whoever writes to it might never begin.
"""

from __future__ import annotations

import errno
import os
import stat
from typing import Any

from ..system import AT_ONCE

_PIECE = 1 << 20


def hash_of_file(path: str | os.PathLike[str], digest: Any) -> str:
    """Return the hash of a file, by an object of `hashlib`, in hexadecimal digits.

    Raises
    ------
    OSError
        It cannot be read, or is no regular file.
    """
    _check(os.stat(path), path)  # opening a FIFO and closing it would end whoever writes to it
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
