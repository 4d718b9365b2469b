"""Atomic writing: output files appear whole or not at all.

In: the paths of output files. Out: binary file objects to write to. The bytes go to a temporary
file in the same folder, which is renamed to the target when everything is written; until then the
old file stays untouched, and a failure, or a signal that Python turns into an exception, leaves
nothing behind. The bytes are synced before the rename, and the name when the block ends: after a
power cut there is the old file or the new one. Files that belong together appear one right after
the other.

A path named by the user may be a symbolic link, whose target is replaced. In a folder named by the
user, engine3d names the files, and replaces nothing outside: it replaces links themselves, and
refuses folders that lead out.
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
from ..system import AT_ONCE, READ_WRITE, WRITE, replace_file, set_mode, sync_file, sync_folder
from .portable_names import fault_on_windows

_ON_WINDOWS = os.name == "nt"
#: Temporary files left by a process that was killed while writing.
LEFT_BEHIND = re.compile(r"\.(?P<name>.*)\.[0-9a-f]{16}\.part", re.DOTALL)


@contextlib.contextmanager
def atomic_write(
    path: str | os.PathLike[str], *, below: str | os.PathLike[str] | None = None
) -> Iterator[BinaryIO]:
    """Open ``path`` for writing; the file appears when the block ends without an exception.

    Parameters
    ----------
    path : str or path-like
        The output file. An existing file is replaced; its permissions are kept, except set-user and
        set-group bits. Anything but a regular file (a device such as ``/dev/stdout``, a FIFO with a
        reader) is written to directly.
    below : str or path-like, optional
        The folder named by the user, if engine3d chose the file's name; links must not lead out of
        it.

    Yields
    ------
    file : binary file object, writable and seekable (seekable for regular files only)

    Raises
    ------
    FileAccessError
        The folder does not exist or cannot be written to, the disk is full, or the path is invalid,
        is a FIFO without a reader, or leads out of ``below``.
    """
    with AtomicFiles() as files:
        yield files.create(path, below=below)


def checked_path(path: str | bytes | os.PathLike[str]) -> str:
    """Return the path of an output file as a string."""
    try:
        decoded = os.fsdecode(path)
    except (TypeError, UnicodeDecodeError):
        raise InvalidArgumentError(f"path must be a str or path-like, not {shown(path)}") from None
    if "\0" in decoded:
        raise FileAccessError("cannot write: the path holds a zero byte", decoded)
    if "://" in decoded and not os.path.isdir(os.path.dirname(decoded)):
        raise FileAccessError("cannot write to an address: give a path of this machine", decoded)
    return decoded


class AtomicFiles:
    """Files that appear together when the ``with`` block ends without an exception.

    They are written one after the other, and renamed in the order of creation: a file that refers
    to others comes last. Raises `FileAccessError` as `atomic_write` does; it names the file.
    """

    def __init__(self) -> None:
        self._parts: list[_Part] = []

    def create(
        self, path: str | os.PathLike[str], *, below: str | os.PathLike[str] | None = None
    ) -> BinaryIO:
        """Close the previous file, and open the next one as `atomic_write` does."""
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
    """Replaces `AtomicFiles` when a single file goes to an open stream.

    Parameters
    ----------
    stream : binary file object
        The stream; it stays open.
    """

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream

    def create(self, path: str, **_: object) -> BinaryIO:
        """Return the stream for any path."""
        return self._stream

    def __enter__(self) -> StreamFiles:
        return self

    def __exit__(self, *_: Any) -> None:
        """Do nothing: no file has to appear."""


Files = AtomicFiles | StreamFiles


class _Part:
    """A file in progress.

    Attributes
    ----------
    path : str
        The path as the caller gave it.
    folder : str or None
        The folder to sync after a rename.
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
        # Not asked of paths before, which may still hold variables, such as {:03}.
        if _ON_WINDOWS and (fault := fault_on_windows(self.path)) is not None:
            raise FileAccessError(f"cannot write: {fault}", self.path)
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
        # Only 32 characters of the name, at most 128 of the 255 bytes that a name may have.
        self._temporary = os.path.join(folder, f".{name[:32]}.{os.urandom(8).hex()}.part")
        # A file that replaces a private one must be private from the start.
        mode = 0o666 if self._mode is None else 0o600
        flags = READ_WRITE | os.O_CREAT | os.O_EXCL
        self.file = os.fdopen(os.open(self._temporary, flags, mode), "wb")

    def finish(self) -> None:
        self.file.flush()
        if self._mode is not None:
            set_mode(self.file.fileno(), self._temporary or self._target, self._mode)
        if self._temporary is not None:
            sync_file(self.file.fileno())
        self.file.close()

    def appear(self) -> None:
        if self._temporary is not None:
            replace_file(self._temporary, self._target)
            self._temporary = None
            self.folder = os.path.dirname(self._target)

    def discard(self) -> None:
        """Close the file, and remove it if it was not renamed."""
        with contextlib.suppress(AttributeError, OSError):
            self.file.close()
        if self._temporary is not None:
            with contextlib.suppress(OSError):
                os.unlink(self._temporary)


def path_below(path: str, folder: str) -> str:
    """Return a path with its folder resolved; the folder must be ``below`` or inside it.

    Raises `FileAccessError` where links lead out of the folder.
    """
    root, parent = os.path.realpath(folder), os.path.realpath(os.path.dirname(path))
    if parent != root and not parent.startswith(os.path.join(root, "")):
        raise FileAccessError(f"cannot write: a link leads out of {folder}", path)
    return os.path.join(parent, os.path.basename(path))


def _opened_device(path: str) -> int:
    """Open a device or FIFO; a FIFO without a reader is an error, instead of waiting forever."""
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
    """Turn system errors within the block into errors that name the file."""
    try:
        yield
    except FileAccessError:
        raise
    except (OSError, ValueError) as error:
        message = f"cannot write: {getattr(error, 'strerror', None) or error}"
        raise FileAccessError(message, path) from error
