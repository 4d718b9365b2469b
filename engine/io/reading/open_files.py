"""Open files that are read on demand.

In: an open file. Out: its bytes, whole or in pieces: a file that is scanned once need not be in
memory at once.
"""

from __future__ import annotations

import errno
import io
import os

from ..._native.loaders import read_bytes
from ...base.system import AT_ONCE, FOLDER, NO_LINK, READ
from ...errors import FileAccessError

#: Flags to open files: without O_NONBLOCK, opening a FIFO without a writer would hang.
READING = READ | AT_ONCE


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


def opened_below(folder: str, real: str) -> int:
    """Open a file by its real path from a folder around it, without following links.

    A link that has since taken the place of the file, or of a folder on its path, leads nowhere.
    """
    if not FOLDER:  # on systems that cannot open folders
        return os.open(real, READING)
    *folders, name = os.path.relpath(real, folder).split(os.sep)
    handle = os.open(folder, FOLDER)
    try:
        for inner in folders:
            outer, handle = handle, os.open(inner, FOLDER | NO_LINK, dir_fd=handle)
            os.close(outer)
        return os.open(name, READING | NO_LINK, dir_fd=handle)
    finally:
        os.close(handle)


def unreadable(path: str, error: Exception) -> FileAccessError:
    """Return the error to raise for a system error."""
    reason = getattr(error, "strerror", None) or error
    if isinstance(error, PermissionError) and os.path.isdir(path):
        reason = os.strerror(errno.EISDIR)  # Windows only says that it may not be opened
    return FileAccessError(f"cannot read: {reason}", path)
