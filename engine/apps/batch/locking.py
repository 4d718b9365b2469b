"""Ensures that only one batch writes to a folder.

In: a folder. Out: a lock that ends with the process, however it ends. On file systems without locks
two batches may overlap; they still write whole files.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

from ...base.system import NO_LINK, READ_WRITE, locked
from ...errors import FileAccessError


@contextmanager
def locked_folder(folder: str) -> Iterator[None]:
    """Lock a folder against other batches within the block.

    Raises
    ------
    FileAccessError
        Another batch writes there.
    """
    path = os.path.join(folder, "lock")
    try:
        handle = os.open(path, READ_WRITE | os.O_CREAT | NO_LINK, 0o666)
    except OSError as error:
        raise FileAccessError(f"cannot write: {error.strerror}", path) from error
    try:
        if not locked(handle):
            raise FileAccessError("another batch writes to this folder", path)
        yield
    finally:
        os.close(handle)
