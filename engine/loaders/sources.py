"""The bytes of a file, read whole, and the name they go by in messages.

Only regular files are read: a FIFO or a device could block for ever or never end.
"""

from __future__ import annotations

import os
import stat
from typing import NamedTuple

from ..errors import FileAccessError


class Source(NamedTuple):
    """A file's content.

    Attributes
    ----------
    path : str
        As the caller gave it; messages name it.
    data : bytes
    """

    path: str
    data: bytes

    @property
    def folder(self) -> str:
        """The folder that files named inside this one are looked for in."""
        return os.path.dirname(self.path) or "."

    @property
    def stem(self) -> str:
        """The file's name without folder and extension."""
        return os.path.splitext(os.path.basename(self.path))[0]


def read_source(path: str | os.PathLike) -> Source:
    """Read a regular file whole.

    Raises
    ------
    FileAccessError
        It does not exist, cannot be read, or is no regular file.
    """
    path = os.fspath(path)
    try:
        # Without O_NONBLOCK, opening a FIFO that nobody writes to would wait for ever.
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | os.O_CLOEXEC)
        with os.fdopen(handle, "rb") as file:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise FileAccessError("not a regular file", path)
            return Source(path, file.read())
    except FileAccessError:
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise FileAccessError(f"cannot read: {reason}", path) from error
    except MemoryError as error:
        raise FileAccessError("cannot read: too large for this machine's memory", path) from error
