"""The content of a file, and the name it goes by in messages.

In: a path, bytes, or a binary file object. Out: a `Source`, unpacked if it was compressed by gzip.
Of paths only regular files are read: a FIFO or a device could block for ever or never end. Large
ones are not in memory before somebody asks for all their bytes.
"""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple, TypeAlias

import numpy as np

from ...base.system import AT_ONCE, READ
from ...errors import FileAccessError, FileFormatError, InvalidArgumentError
from ...model.geometry.creases import CREASE_ANGLE
from .open_files import OpenFile, unreadable

if TYPE_CHECKING:
    if sys.version_info >= (3, 11):
        from importlib.resources.abc import Traversable
    else:
        from importlib.abc import Traversable

#: What is loaded from: a path, the content, a file, or a resource of a package.
File: TypeAlias = "str | os.PathLike[str] | bytes | BinaryIO | Traversable"

# A compressed file may unpack to this many bytes, and so many times its own size besides. Assign
# other values to change it.
MAX_UNPACKED_BASE = 16 << 20
MAX_UNPACKED_RATIO = 50

# How files are opened: without O_NONBLOCK, a FIFO that nobody writes to would wait for ever.
READING = READ | AT_ONCE

_GZIP = b"\x1f\x8b\x08"
_GZIP_WINDOW = 16 + 15
_CHUNK = 1 << 20
# The bytes behind the end of a member are copied once for each: a file may have very many.
_PACKED_PIECE = 1 << 14
# Files below this many bytes are read at once.
_LARGE = 4 << 20
# The bytes of a piece stay in the processor's cache until they are dealt with.
_PIECE = 1 << 18


def _no_progress(fraction: float) -> None:
    """Nobody watches."""


def _any_image(path: str) -> bool:
    return True


class Source(NamedTuple):
    """A file's content.

    Attributes
    ----------
    path : str
        As the caller gave it; messages name it. In angle brackets for what has no name.
    content : bytes or OpenFile
    progress : callable
        ``progress(fraction)``: told by the reader how much of its work is done, 0..1.
    companion : callable
        ``companion(path) -> bool``: whether an image may become the texture for its name alone.
    crease_angle : float
        Radians, of normals that the file lacks.
    scalars : {"vertices", "faces"} or None
        Of which of these meshes are to carry the numbers that have no meaning of their own.
    root : str or None
        A folder besides the model's own that files named in the model may be in.
    """

    path: str
    content: bytes | OpenFile
    progress: Callable[[float], object] = _no_progress
    companion: Callable[[str], bool] = _any_image
    crease_angle: float = CREASE_ANGLE
    scalars: str | None = None
    root: str | None = None

    def __enter__(self) -> Source:
        return self

    def __exit__(self, *_: object) -> None:
        if isinstance(self.content, OpenFile):
            self.content.close()

    @property
    def data(self) -> bytes:
        """All bytes."""
        return self.content.whole() if isinstance(self.content, OpenFile) else self.content

    @property
    def size(self) -> int:
        """Number of bytes."""
        return self.content.size if isinstance(self.content, OpenFile) else len(self.content)

    def head(self, count: int) -> bytes:
        """Return at most ``count`` of the first bytes."""
        if isinstance(self.content, OpenFile):
            return self.content.head(count)
        return self.content[:count]

    def read_into(self, array: np.ndarray, start: int) -> None:
        """Fill an array with the bytes from ``start`` on, which are all inside."""
        view = array.reshape(-1).view(np.uint8).data
        if isinstance(self.content, OpenFile) and not self.content.is_whole:
            self.content.read_into(view, start)
        else:
            view[:] = memoryview(self.data)[start : start + len(view)]

    def pieces(self, start: int, stride: int, rows: int) -> Iterator[tuple[int, memoryview]]:
        """Walk along rows of ``stride`` bytes from ``start`` on, which are all inside.

        Yields the number of a row, and the bytes of some rows from there on: all of them if the
        file is in memory. A view holds until the next one comes.
        """
        if not isinstance(self.content, OpenFile) or self.content.is_whole:
            yield 0, memoryview(self.data)[start : start + rows * stride]
            return
        step = max(_PIECE // stride, 1)
        buffer = memoryview(bytearray(min(step, rows) * stride))
        for first in range(0, rows, step):
            view = buffer[: min(step, rows - first) * stride]
            self.content.read_into(view, start + first * stride)
            yield first, view

    @property
    def has_name(self) -> bool:
        """Whether there is a path, rather than bytes or a stream without a name."""
        return not self.path.startswith("<")

    @property
    def folder(self) -> str | None:
        """The folder that files named inside this one are looked for in; None without a path."""
        return (os.path.dirname(self.path) or ".") if self.has_name else None

    @property
    def stem(self) -> str:
        """The file's name without folder and extension; empty without a path."""
        return stem_and_extension(self.path)[0] if self.has_name else ""

    @property
    def extension(self) -> str:
        """The extension in lower case, that of ``a.obj.gz`` being ``.obj``."""
        return stem_and_extension(self.path)[1] if self.has_name else ""


def stem_and_extension(path: str) -> tuple[str, str]:
    """Return a file's name without folder and extension, and the extension in lower case.

    A ``.gz`` at the end is taken off before.
    """
    stem, extension = os.path.splitext(os.path.basename(path))
    if extension.lower() == ".gz":
        stem, extension = os.path.splitext(stem)
    return stem, extension.lower()


def read_source(file: File) -> Source:
    """Read a file whole.

    Parameters
    ----------
    file : str, path-like, bytes-like, binary file object or Traversable
        Bytes are the content itself. A file object is read from where it stands.

    Raises
    ------
    FileAccessError
        It does not exist, cannot be read, or is no regular file.
    FileFormatError
        It is compressed and damaged, or far larger than its size lets expect.
    InvalidArgumentError
        It is none of these things.
    """
    if isinstance(file, (bytes, bytearray, memoryview)):
        source = Source("<bytes>", bytes(file))
    elif isinstance(file, (str, os.PathLike)):
        source = _read_path(os.fspath(file))
    elif hasattr(file, "read"):
        source = _read_stream(file)
    elif hasattr(file, "joinpath"):
        source = _read_resource(file)
    else:
        raise InvalidArgumentError(f"not a path, bytes or a file object: {type(file).__name__}")
    return unpacked(source)


def unpacked(source: Source) -> Source:
    """Return a source whose content is not compressed; raises as `read_source`."""
    if source.head(len(_GZIP)) != _GZIP:
        return source
    with source:
        return Source(source.path, _unpacked(source))


def _read_path(path: str) -> Source:
    try:
        handle = os.open(path, READING)
    except (OSError, ValueError) as error:
        raise unreadable(path, error) from error
    try:
        return opened_source(path, handle)
    except MemoryError as error:
        raise FileAccessError(
            "cannot read: it is larger than the memory that there is", path
        ) from error


def opened_source(path: str, handle: int) -> Source:
    """Return the source of an open file, which it owns from now on.

    Raises
    ------
    FileAccessError
        It is no regular file.
    """
    mode = os.fstat(handle).st_mode
    if not stat.S_ISREG(mode):
        os.close(handle)
        is_folder = stat.S_ISDIR(mode)
        raise FileAccessError(
            "cannot read: Is a directory" if is_folder else "not a regular file", path
        )
    file = os.fdopen(handle, "rb", buffering=0)
    content = OpenFile(path, file)
    return Source(path, content if content.size >= _LARGE else content.whole())


def _read_resource(file: Traversable) -> Source:
    """Read a resource of a package that is not in a folder, but in an archive, say."""
    try:
        return Source(str(file), file.read_bytes())
    except (OSError, KeyError, ValueError) as error:
        raise FileAccessError(f"cannot read: {error}", str(file)) from error


def _read_stream(file: Any) -> Source:
    """Read whatever has a method ``read``."""
    name = getattr(file, "name", None)
    path = f"<{type(file).__name__}>"
    if isinstance(name, str) and (name == "<stdin>" or os.path.exists(name)):
        path = name
    try:
        data = file.read()
    except (OSError, ValueError, EOFError) as error:
        raise FileAccessError(f"cannot read: {error}", path) from error
    if not isinstance(data, (bytes, bytearray)):
        raise InvalidArgumentError(f"{path}: a file object must be opened in binary mode")
    return Source(path, bytes(data))


def _unpacked(source: Source) -> bytes:
    """Unpack all members of a gzip file; what stands behind them is left out."""
    import zlib

    packed = memoryview(source.data)
    limit = MAX_UNPACKED_BASE + MAX_UNPACKED_RATIO * len(packed)
    place, parts, total = 0, [], 0
    try:
        while packed[place : place + len(_GZIP)] == _GZIP:
            member = zlib.decompressobj(_GZIP_WINDOW)
            while not member.eof:
                piece = packed[place : place + _PACKED_PIECE]
                part = member.decompress(piece, _CHUNK)
                place += len(piece) - len(member.unconsumed_tail) - len(member.unused_data)
                parts.append(part)
                total += len(part)
                if total > limit:
                    raise FileFormatError(
                        f"unpacks to more than {limit} bytes, the limit for its size", source.path
                    )
                if not part and not piece:
                    raise FileFormatError("the compressed file is cut off", source.path)
    except zlib.error as error:
        raise FileFormatError(f"damaged compressed file: {error}", source.path) from error
    return b"".join(parts)
