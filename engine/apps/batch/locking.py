"""One batch at a time writes to a folder.

In: a folder. Out: a lock that ends with the process, however it ends. Where the system has none, as
on some network file systems, two batches may meet: they write whole files all the same.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

from ...base.system import NO_LINK, READ_WRITE, locked
from ...errors import FileAccessError


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
        handle = os.open(path, READ_WRITE | os.O_CREAT | NO_LINK, 0o666)
    except OSError as error:
        raise FileAccessError(f"cannot write: {error.strerror}", path) from error
    try:
        if not locked(handle):
            raise FileAccessError("another batch writes to this folder", path)
        yield
    finally:
        os.close(handle)
