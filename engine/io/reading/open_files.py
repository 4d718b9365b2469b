"""Open files that are read on demand.

In: an open file. Out: its bytes, whole or in pieces: a file that is scanned once need not be in
memory at once.
"""

from __future__ import annotations

import errno
import io
import os

from ..._native.loaders import read_bytes
from ...errors import FileAccessError


class OpenFile:
    """A regular file.

    Parameters
    ----------
    path : str
        The path as messages show it.
    file : io.FileIO
        The file; `whole` and `close` close it.

    Attributes
    ----------
    size : int
        Its size in bytes when it was opened.
    """

    def __init__(self, path: str, file: io.FileIO) -> None:
        self._path = path
        self._file = file
        self._data: bytes | None = None
        self.size = os.fstat(file.fileno()).st_size

    @property
    def is_whole(self) -> bool:
        """Whether all of the file is in memory."""
        return self._data is not None

    def whole(self) -> bytes:
        """Return all bytes; read them the first time.

        Raises
        ------
        FileAccessError
        """
        if self._data is None:
            try:
                with self._file as file:
                    file.seek(0)
                    data = read_bytes(file.readinto, self.size)
                    # Some files, such as those in /proc, are longer than their size says.
                    self._data = data + file.readall()
            except (OSError, ValueError) as error:
                raise unreadable(self._path, error) from error
            except MemoryError as error:
                reason = "too large for this machine's memory"
                raise FileAccessError(f"cannot read: {reason}", self._path) from error
            self.size = len(self._data)
        return self._data

    def head(self, count: int) -> bytes:
        """Return at most ``count`` of the first bytes."""
        if self._data is not None:
            return self._data[:count]
        start = bytearray(min(count, self.size))
        self.read_into(memoryview(start), 0)
        return bytes(start)

    def read_into(self, view: memoryview, start: int) -> None:
        """Fill a view with the bytes from ``start`` on.

        Raises
        ------
        FileAccessError
            Also if the file ends before the view does.
        """
        done = 0
        try:
            self._file.seek(start)
            while done < len(view) and (count := self._file.readinto(view[done:])):
                done += count
        except (OSError, ValueError) as error:
            raise unreadable(self._path, error) from error
        if done < len(view):
            raise FileAccessError("cannot read: it became shorter meanwhile", self._path)

    def close(self) -> None:
        self._file.close()


def unreadable(path: str, error: Exception) -> FileAccessError:
    """Return the error to raise for a system error."""
    reason = getattr(error, "strerror", None) or error
    if isinstance(error, PermissionError) and os.path.isdir(path):
        reason = os.strerror(errno.EISDIR)  # Windows only says that it may not be opened
    return FileAccessError(f"cannot read: {reason}", path)
