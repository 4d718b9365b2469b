"""One batch at a time writes to a folder.

In: a folder. Out: a lock that ends with the process, however it ends. Where the system has none, as
on some network file systems, two batches may meet: they write whole files all the same.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager

from ..errors import FileAccessError

try:
    import fcntl
except ImportError:  # no POSIX
    fcntl = None


@contextmanager
def locked_folder(folder: str) -> Iterator[None]:
    """Keep other batches out of a folder within the block.

    Raises
    ------
    FileAccessError
        Another batch writes there.
    """
    path = os.path.join(folder, "lock")
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_CLOEXEC", 0), 0o666)
    except OSError as error:
        raise FileAccessError(f"cannot write: {error.strerror}", path) from error
    try:
        if fcntl is not None:
            _lock(handle, path)
        yield
    finally:
        os.close(handle)


def _lock(handle: int, path: str) -> None:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in (errno.EAGAIN, errno.EACCES):
            raise FileAccessError("another batch writes to this folder", path) from None
