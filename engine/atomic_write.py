"""Writing a file so that it is there whole or not at all.

In: the path of an output file. Out: a binary file object to write to. The bytes go to a temporary
name in the same folder, which takes the target's name only when everything was written; whatever
stood there before stays untouched until then, and a failure leaves nothing behind.
"""

from __future__ import annotations

import contextlib
import os
import stat
from collections.abc import Iterator
from typing import BinaryIO

from .errors import FileAccessError


@contextlib.contextmanager
def atomic_write(path: str | os.PathLike) -> Iterator[BinaryIO]:
    """Open ``path`` for writing; it appears when the ``with`` block ends without an exception.

    Parameters
    ----------
    path : str or path-like
        The output file. An existing file is replaced and its permissions are kept. What is not a
        regular file (a device such as ``/dev/stdout``, a FIFO) is written to directly.

    Yields
    ------
    file : binary file object, writable and seekable (seekable for regular files only)

    Raises
    ------
    FileAccessError
        The folder does not exist, cannot be written to, or the disk is full.
    """
    path = os.fspath(path)
    try:
        if os.path.exists(path) and not os.path.isfile(path):
            with open(path, "wb") as device:
                yield device
            return
        with _replaced_when_done(os.path.realpath(path)) as file:
            yield file
    except OSError as error:
        if isinstance(error, FileAccessError):
            raise
        raise FileAccessError(f"cannot write: {error.strerror or error}", path) from error


@contextlib.contextmanager
def _replaced_when_done(target: str) -> Iterator[BinaryIO]:
    folder, name = os.path.split(target)
    temporary = os.path.join(folder, f".{name[:64]}.{os.urandom(8).hex()}.part")
    handle = os.open(temporary, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        with os.fdopen(handle, "wb") as file:
            yield file
            file.flush()
            os.fchmod(file.fileno(), _permissions(target))
        os.replace(temporary, target)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(temporary)
        raise


def _permissions(target: str) -> int:
    """The mode bits of the file to replace, or those a new file gets from the process's umask."""
    try:
        return stat.S_IMODE(os.stat(target).st_mode)
    except FileNotFoundError:
        umask = os.umask(0)
        os.umask(umask)
        return 0o666 & ~umask
