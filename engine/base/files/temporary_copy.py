"""Content as a file on the disk, for libraries that read nothing but paths."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator


@contextlib.contextmanager
def temporary_copy(data: bytes, name: str) -> Iterator[str]:
    """Yield the path of a file of that name with that content, within a folder of its own.

    It is closed: on Windows nobody else opens a file that is open for writing. When the block ends
    it is removed.
    """
    # A library that failed may hold it for a while: its error counts, not that of removing.
    with tempfile.TemporaryDirectory(prefix="engine3d-", ignore_cleanup_errors=True) as folder:
        path = os.path.join(folder, name)
        with open(path, "wb") as file:
            file.write(data)
        yield path
