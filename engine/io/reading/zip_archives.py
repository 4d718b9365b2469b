"""ZIP archives in model formats.

In: the bytes of an archive. Out: the bytes of its parts, in pieces. The total unpacked size is
limited by the archive's size before unpacking; no part yields more than it announces.
"""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Iterator

from ...errors import FileFormatError, printable
from . import sources
from .sources import Source
from .text import shown

#: Signature of archives.
ZIP = b"PK"
_PIECE = 1 << 16
_MOST_SAID = 100
# Compression methods that packages do not allow; messages name them.
_PACKINGS = {9: "Deflate64", 12: "BZIP2", 14: "LZMA", 93: "Zstandard", 95: "XZ"}
# Errors that the library raises for damaged or unusual archives; the last two for encrypted ones.
_FAULTS = (
    zipfile.BadZipFile,
    zlib.error,
    struct.error,
    EOFError,
    OSError,
    ValueError,
    RuntimeError,
)


class ZipArchive:
    """The parts of an archive.

    Parameters
    ----------
    source : Source

    Raises
    ------
    FileFormatError
        The archive is damaged, or unpacks to more than the limit for its size.
    """

    def __init__(self, source: Source) -> None:
        self._path = source.path
        try:
            self._zip = zipfile.ZipFile(io.BytesIO(source.data))
            entries = self._zip.infolist()
        except _FAULTS as error:
            raise FileFormatError(f"damaged archive: {_said(error)}", source.path) from error
        self.unpacked_size = sum(entry.file_size for entry in entries)
        limit = sources.MAX_UNPACKED_BASE + sources.MAX_UNPACKED_RATIO * source.size
        if self.unpacked_size > limit:
            raise FileFormatError(
                f"unpacks to more than {limit} bytes, the limit for its size", source.path
            )
        self._parts = {
            _key(entry.filename): entry for entry in entries if entry.filename[-1:] not in ("", "/")
        }

    @property
    def names(self) -> list[str]:
        """The names of all parts, in archive order."""
        return [entry.filename for entry in self._parts.values()]

    def __contains__(self, name: str) -> bool:
        return _key(name) in self._parts

    def size(self, name: str) -> int:
        """Return a part's unpacked size in bytes; 0 if it does not exist."""
        entry = self._parts.get(_key(name))
        return 0 if entry is None else entry.file_size

    def pieces(self, name: str) -> Iterator[bytes]:
        """Yield the bytes of a part in pieces.

        Names are matched as in packages: ignoring case and a leading slash.

        Raises
        ------
        FileFormatError
            The part is missing, damaged, or compressed by an unknown method.
        """
        entry = self._parts.get(_key(name))
        if entry is None:
            raise FileFormatError(f"{shown(name)} is not in the archive", self._path)
        self._check_packing(entry)
        try:
            with self._zip.open(entry) as file:
                while piece := file.read(_PIECE):
                    yield piece
        except _FAULTS as error:
            raise FileFormatError(
                f"{shown(name)} is damaged: {_said(error)}", self._path
            ) from error

    def check_packings(self) -> None:
        """Raise unless all parts use known compression methods."""
        for entry in self._parts.values():
            self._check_packing(entry)

    def _check_packing(self, entry: zipfile.ZipInfo) -> None:
        if entry.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            name = _PACKINGS.get(entry.compress_type, f"method {entry.compress_type}")
            raise FileFormatError(
                f"{shown(entry.filename)} is packed by {name}; only Deflate is read", self._path
            )

    def read(self, name: str) -> bytes:
        """Return the bytes of a part; raise as `pieces` does."""
        return b"".join(self.pieces(name))


def _said(error: Exception) -> str:
    """Return the library's message on one line; it may quote much of the archive."""
    text = " ".join(str(error).split()) or type(error).__name__
    return printable(text if len(text) <= _MOST_SAID else text[:_MOST_SAID] + "...")


def _key(name: str) -> str:
    return name.replace("\\", "/").lstrip("/").lower()
