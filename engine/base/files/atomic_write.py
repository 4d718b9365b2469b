"""Writing files so that they are there whole or not at all.

In: the paths of output files. Out: binary file objects to write to. The bytes go to a temporary
name in the same folder, which takes the target's name only when everything was written; whatever
stood there before stays untouched until then, and a failure, or a signal that Python turns into an
exception, leaves nothing behind. The bytes are on the disk before the name is, and the name is when
the block ends: after a power cut there is the old file or the new one. Files that belong together
appear one right after the other.

What may be replaced: a path that somebody named may be a symbolic link, and what it leads to is
replaced. Where somebody named a folder, and engine3d the files in it, nothing outside of that
folder is: a link in a file's place is itself replaced, and folders that lead out are an error.
"""

from __future__ import annotations

import contextlib
import errno
import os
import re
import stat
from collections.abc import Iterator
from typing import Any, BinaryIO

from ...errors import FileAccessError, InvalidArgumentError
from ..numbers import shown
from ..system import AT_ONCE, READ_WRITE, WRITE, set_mode, sync_folder

#: What stays where a process was killed while it wrote.
LEFT_BEHIND = re.compile(r"\.(?P<name>.*)\.[0-9a-f]{16}\.part", re.DOTALL)


@contextlib.contextmanager
def atomic_write(
    path: str | os.PathLike[str], *, below: str | os.PathLike[str] | None = None
) -> Iterator[BinaryIO]:
    """Open ``path`` for writing; it appears when the ``with`` block ends without an exception.

    Parameters
    ----------
    path : str or path-like
        The output file. An existing file is replaced and its permissions are kept, but for bits
        that let it run as another user. What is not a regular file (a device such as
        ``/dev/stdout``, a FIFO that somebody reads) is written to directly.
    below : str or path-like, optional
        The folder that somebody named, where the name of the file is engine3d's own: no link leads
        out of it.

    Yields
    ------
    file : binary file object, writable and seekable (seekable for regular files only)

    Raises
    ------
    FileAccessError
        The folder does not exist, cannot be written to, the disk is full, the path is none, is a
        FIFO that nobody reads, or leads out of ``below``.
    """
    with AtomicFiles() as files:
        yield files.create(path, below=below)


def checked_path(path: str | bytes | os.PathLike[str]) -> str:
    """Return the path of an output file as a string."""
    try:
        decoded = os.fsdecode(path)
    except TypeError:
        raise InvalidArgumentError(f"path must be a str or path-like, not {shown(path)}") from None
    if "\0" in decoded:
        raise FileAccessError("cannot write: the path holds a zero byte", decoded)
    return decoded


class AtomicFiles:
    """Files that appear together, when the ``with`` block ends without an exception.

    They are written one after the other, and take their names in the order of creation: one that
    names others comes last. Raises `FileAccessError` as `atomic_write`; it names the file.
    """

    def __init__(self) -> None:
        self._parts: list[_Part] = []

    def create(
        self, path: str | os.PathLike[str], *, below: str | os.PathLike[str] | None = None
    ) -> BinaryIO:
        """Begin the next file, as `atomic_write`; the one before is whole, and closed."""
        if self._parts:
            with _named(self._parts[-1].path):
                self._parts[-1].finish()
        part = _Part(checked_path(path), None if below is None else checked_path(below))
        self._parts.append(part)
        with _named(part.path):
            part.open()
        return part.file

    def __enter__(self) -> AtomicFiles:
        return self

    def __exit__(self, kind: Any, error: Any, trace: Any) -> None:
        try:
            if isinstance(error, OSError) and self._parts:
                with _named(self._parts[-1].path):
                    raise error
            if error is None and self._parts:
                with _named(self._parts[-1].path):
                    self._parts[-1].finish()
                for part in self._parts:
                    with _named(part.path):
                        part.appear()
                for folder, path in {part.folder: part.path for part in self._parts}.items():
                    with _named(path):
                        sync_folder(folder)
        finally:
            for part in self._parts:
                part.discard()


class StreamFiles:
    """Takes the place of `AtomicFiles` where one file goes to an open stream.

    Parameters
    ----------
    stream : binary file object
        Stays open.
    """

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream

    def create(self, path: str, **_: object) -> BinaryIO:
        """Return the stream, whatever the path."""
        return self._stream

    def __enter__(self) -> StreamFiles:
        return self

    def __exit__(self, *_: Any) -> None:
        """Nothing has to appear."""


Files = AtomicFiles | StreamFiles


class _Part:
    """A file that is being written.

    Attributes
    ----------
    path : str
        As the caller gave it.
    folder : str or None
        Where its name is new, once it appeared.
    file : binary file object
    """

    file: BinaryIO

    def __init__(self, path: str, below: str | None) -> None:
        self.path = path
        self.folder: str | None = None
        self._below = below
        self._temporary: str | None = None
        self._mode: int | None = None

    def open(self) -> None:
        if self._below is not None:
            self._target = path_below(self.path, self._below)
        else:
            self._target = os.path.realpath(self.path)
            if os.path.exists(self.path) and not os.path.isfile(self.path):
                self.file = os.fdopen(_opened_device(self.path), "wb")
                return
        with contextlib.suppress(FileNotFoundError):
            status = os.stat(self._target, follow_symlinks=self._below is None)
            mode = status.st_mode
            self._mode = stat.S_IMODE(mode) & 0o777 if stat.S_ISREG(mode) else None
        folder, name = os.path.split(self._target)
        # Some letters of the name: at most 128 of the 255 bytes that a name may have.
        self._temporary = os.path.join(folder, f".{name[:32]}.{os.urandom(8).hex()}.part")
        # A file that replaces a private one is private from the beginning.
        mode = 0o666 if self._mode is None else 0o600
        flags = READ_WRITE | os.O_CREAT | os.O_EXCL
        self.file = os.fdopen(os.open(self._temporary, flags, mode), "wb")

    def finish(self) -> None:
        self.file.flush()
        if self._mode is not None:
            set_mode(self.file.fileno(), self._temporary or self._target, self._mode)
        if self._temporary is not None:
            os.fsync(self.file.fileno())
        self.file.close()

    def appear(self) -> None:
        if self._temporary is not None:
            os.replace(self._temporary, self._target)
            self._temporary = None
            self.folder = os.path.dirname(self._target)

    def discard(self) -> None:
        """Close the file, and remove it if it did not appear."""
        with contextlib.suppress(AttributeError, OSError):
            self.file.close()
        if self._temporary is not None:
            with contextlib.suppress(OSError):
                os.unlink(self._temporary)


def path_below(path: str, folder: str) -> str:
    """Return a path without links, but for its last part, which is in a folder or below it.

    Raises `FileAccessError` where links lead out of the folder.
    """
    root, parent = os.path.realpath(folder), os.path.realpath(os.path.dirname(path))
    if parent != root and not parent.startswith(os.path.join(root, "")):
        raise FileAccessError(f"cannot write: a link leads out of {folder}", path)
    return os.path.join(parent, os.path.basename(path))


def _opened_device(path: str) -> int:
    """Open what is no regular file; a FIFO that nobody reads is an error, not a wait for ever."""
    try:
        handle = os.open(path, WRITE | AT_ONCE)
    except OSError as error:
        if error.errno == errno.ENXIO and stat.S_ISFIFO(os.stat(path).st_mode):
            raise OSError(errno.ENXIO, "a FIFO that nobody reads") from error
        raise
    if AT_ONCE:
        os.set_blocking(handle, True)
    return handle


@contextlib.contextmanager
def _named(path: str | None) -> Iterator[None]:
    """Let errors of the system name the file."""
    try:
        yield
    except FileAccessError:
        raise
    except (OSError, ValueError) as error:
        message = f"cannot write: {getattr(error, 'strerror', None) or error}"
        raise FileAccessError(message, path) from error
