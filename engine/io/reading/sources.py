"""The content of a file, with its name for messages.

In: a path, bytes, or a binary file object. Out: a `Source`, unpacked if it was compressed by gzip.
Paths must be regular files: a FIFO or device could block or never end. Large files are loaded into
memory only when all their bytes are requested.
"""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple, TypeAlias

import numpy as np

from ...base.files.confined_reading import confinement, why_not_of_size
from ...choices import ShapesOf
from ...errors import FileAccessError, FileFormatError, InvalidArgumentError
from ...model.geometry.creases import CREASE_ANGLE
from ..addresses.url_names import file_part, folder_of, is_url
from ..addresses.urls import fetched
from .open_files import READING, OpenFile, opened_below, unreadable

if TYPE_CHECKING:
    if sys.version_info >= (3, 11):
        from importlib.resources.abc import Traversable
    else:
        from importlib.abc import Traversable

#: The sources of loading: a path or an address, the content, a file, or a package resource.
File: TypeAlias = "str | os.PathLike[str] | bytes | BinaryIO | Traversable"

# Limits of unpacking: a base in bytes, and a multiple of the compressed size. Assignable.
MAX_UNPACKED_BASE = 16 << 20
MAX_UNPACKED_RATIO = 50

_GZIP = b"\x1f\x8b\x08"
_GZIP_WINDOW = 16 + 15
_CHUNK = 1 << 20
# The bytes after each member are copied once: a file may have very many members.
_PACKED_PIECE = 1 << 14
# Smaller files are read at once.
_LARGE = 4 << 20
# Pieces of this size stay in the processor's cache while they are processed.
_PIECE = 1 << 18


def _no_progress(fraction: float) -> None:
    """Ignore the progress."""


def _any_image(path: str) -> bool:
    return True


class Source(NamedTuple):
    """A file's content.

    Attributes
    ----------
    path : str
        As the caller gave it, for messages. In angle brackets if there is no name.
    content : bytes or OpenFile
    progress : callable
        ``progress(fraction)``, called by the reader with the fraction of work done, 0..1.
    companion : callable
        ``companion(path) -> bool``: whether an image may become the texture by name alone.
    crease_angle : float
        Radians, for normals that the file lacks.
    values : bool
        Whether to read custom numbers into ``Mesh.values``.
    root : str or None
        A second folder, besides the model's own, for files named in the model.
    joints : mapping of str to value
        Where the joints of a robot stand.
    shapes : {"visual", "collision", "both"}
        What shows the links of a robot.
    is_on_disk : bool
        Whether the file at the path holds these very bytes.
    """

    path: str
    content: bytes | OpenFile
    progress: Callable[[float], object] = _no_progress
    companion: Callable[[str], bool] = _any_image
    crease_angle: float = CREASE_ANGLE
    values: bool = True
    root: str | None = None
    joints: Mapping[str, Any] = MappingProxyType({})
    shapes: ShapesOf = "visual"
    is_on_disk: bool = False

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
        """Iterate over rows of ``stride`` bytes from ``start`` on, which must all be inside.

        Yields a row number, and the bytes of some rows from there on: all of them if the file is in
        memory. A view is valid until the next one is yielded.
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
        """Whether there is a path or an address, rather than bytes or an unnamed stream."""
        return not self.path.startswith("<")

    @property
    def has_path(self) -> bool:
        """Whether there is a path on the disk."""
        return self.has_name and not is_url(self.path)

    @property
    def folder(self) -> str | None:
        """The folder of files named in this one; None without a path or an address."""
        if is_url(self.path):
            return folder_of(self.path).removesuffix("/")
        return (os.path.dirname(self.path) or ".") if self.has_name else None

    @property
    def stem(self) -> str:
        """The file's name without folder and extension; empty without a path."""
        return stem_and_extension(self.path)[0] if self.has_name else ""

    @property
    def extension(self) -> str:
        """The extension in lower case, that of ``a.obj.gz`` being ``.obj``."""
        return stem_and_extension(self.path)[1] if self.has_name else ""


def endings(path: str) -> list[str]:
    """Return what a file's name may end with as an extension, the longest first, in lower case.

    Those of ``a.vox.xml.gz`` are ``vox.xml.gz``, ``vox.xml``, ``xml.gz``, ``xml`` and ``gz``.
    """
    words = os.path.basename(file_part(path)).lower().split(".")[1:]
    ends = [".".join(words[first:]) for first in range(len(words))]
    unpacked = [end.removesuffix(".gz") for end in ends]
    return list(dict.fromkeys(end for pair in zip(ends, unpacked, strict=True) for end in pair))


def stem_and_extension(path: str) -> tuple[str, str]:
    """Return a file's name without folder and extension, and the extension in lower case.

    A trailing ``.gz`` is removed first.
    """
    stem, extension = os.path.splitext(os.path.basename(file_part(path)))
    if extension.lower() == ".gz":
        stem, extension = os.path.splitext(stem)
    return stem, extension.lower()


def read_source(file: File) -> Source:
    """Read a whole file.

    Parameters
    ----------
    file : str, path-like, bytes-like, binary file object or Traversable
        Bytes are the content itself. A file object is read from its current position. A str may be
        an address, which fsspec reads.

    Raises
    ------
    FileAccessError
        The file does not exist, cannot be read, is not a regular file, or is none of those that
        reading is confined to (`confined_reading`).
    FileFormatError
        The compressed file is damaged, or unpacks to an implausible size.
    InvalidArgumentError
        The argument has a wrong type.
    """
    if isinstance(file, (bytes, bytearray, memoryview)):
        source = Source("<bytes>", bytes(file))
    elif isinstance(file, str) and is_url(file):
        source = Source(file, fetched(file))
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
    """Return a source with uncompressed content; raise as `read_source` does."""
    if source.head(len(_GZIP)) != _GZIP:
        return source
    with source:
        return Source(source.path, _unpacked(source))


def _read_path(path: str) -> Source:
    try:
        handle = _opened(path)
    except (OSError, ValueError) as error:
        raise unreadable(path, error) from error
    try:
        return opened_source(path, handle)
    except MemoryError as error:
        raise FileAccessError(
            "cannot read: it is larger than the memory that there is", path
        ) from error


def _opened(path: str) -> int:
    confined = confinement()
    if confined is None:
        return os.open(path, READING)
    real = os.path.realpath(path)
    if reason := confined.why_not_at(real):
        raise FileAccessError(reason, path)
    return opened_below(confined.folder, real)


def opened_source(path: str, handle: int) -> Source:
    """Return the source of an open file, and take over the file.

    Raises
    ------
    FileAccessError
        It is not a regular file, or larger than reading is confined to.
    """
    if reason := _why_not(os.fstat(handle)):
        os.close(handle)
        raise FileAccessError(reason, path)
    file = os.fdopen(handle, "rb", buffering=0)
    content = OpenFile(path, file)
    return Source(path, content if content.size >= _LARGE else content.whole(), is_on_disk=True)


def _why_not(state: os.stat_result) -> str:
    """Return why an open file is not read; empty if it is."""
    if stat.S_ISDIR(state.st_mode):
        return "cannot read: Is a directory"
    if not stat.S_ISREG(state.st_mode):
        return "not a regular file"
    return why_not_of_size(state.st_size)


def _read_resource(file: Traversable) -> Source:
    """Read a package resource that is not in a folder but, for example, in an archive."""
    try:
        return Source(str(file), file.read_bytes())
    except (OSError, KeyError, ValueError) as error:
        raise FileAccessError(f"cannot read: {error}", str(file)) from error


def _read_stream(file: Any) -> Source:
    """Read any object with a method ``read``."""
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
    """Unpack all members of a gzip file; trailing bytes are ignored."""
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
