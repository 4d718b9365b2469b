"""Buffers and buffer views of a glTF file.

In: a `GltfFile`. Out: bytes, each buffer read once, compressed views unpacked once. Announced sizes
are checked against the file before any allocation.
"""

from __future__ import annotations

import binascii
from typing import Any

from ...addresses.linked_urls import linked_files
from ...reading import sources
from ...reading.linked_files import LinkedFileError
from ...reading.percent_encoding import percent_decoded
from ...reading.posed_parts import MAX_REPEATED
from ...reading.sources import Source
from ...reading.text import shown
from . import gltf_meshopt
from .gltf_file import DamagedError, Entry, GltfFile, once

# In honest files, even shared numbers take at least one byte for this many of them.
_NUMBERS_PER_BYTE = 4


class GltfBuffers:
    """The buffers of a file, each read once.

    Parameters
    ----------
    file : GltfFile
    source : Source
        The source of the file.

    Attributes
    ----------
    limit : int
        How many numbers may be made from the file, counted at every request. Grows with the files
        that are read.
    """

    def __init__(self, file: GltfFile, source: Source) -> None:
        self._file = file
        self._files = linked_files(source, file.warnings)
        self._buffers: dict[int, memoryview | DamagedError] = {}
        self._unpacked: dict[int, memoryview | DamagedError] = {}
        self._given = 0
        self._file_bytes = source.size
        self._unpacked_bytes = 0
        self.limit = MAX_REPEATED + _NUMBERS_PER_BYTE * source.size

    def count(self, numbers: int) -> None:
        """Count numbers made from the file.

        Raises
        ------
        FileFormatError
            The total exceeds the limit.
        """
        self._given += numbers
        if self._given > self.limit:
            raise self._file.error(
                f"its meshes announce more than {self.limit} numbers, the limit for its size"
            )

    def allow(self, size: int, where: str) -> None:
        """Count unpacked bytes, before unpacking.

        Raises
        ------
        FileFormatError
            The total exceeds the limit for the file's size.
        """
        self._unpacked_bytes += size
        most = sources.MAX_UNPACKED_BASE + sources.MAX_UNPACKED_RATIO * self._file_bytes
        if self._unpacked_bytes > most:
            raise self._file.error(
                f"{where} unpacks to more than {most} bytes, the limit for its size"
            )
        self.limit += _NUMBERS_PER_BYTE * size

    def view(self, index: Any, where: str) -> memoryview:
        """Return the bytes of a buffer view, decompressed if necessary."""
        index = self._file.number_in("bufferViews", index, where)
        view = self._file.entries("bufferViews")[index]
        name = f"bufferViews[{index}]"
        packed = gltf_meshopt.packing_of(self._file, view, name)
        if packed is None:
            return self._range(view, name)
        return once(self._unpacked, index, lambda: self._unpack(packed, name))

    def _unpack(self, packed: Entry, name: str) -> memoryview:
        """Return the decompressed bytes of a compressed view."""
        self.allow(gltf_meshopt.unpacked_size(self._file, packed, name), name)
        return gltf_meshopt.unpacked(self._file, self._range(packed, name), packed, name)

    def _range(self, entry: Entry, name: str) -> memoryview:
        """Return the range of a buffer that an entry refers to."""
        start = self._file.whole(entry, "byteOffset", name, 0)
        length = self._file.whole(entry, "byteLength", name)
        buffer = self._buffer(entry.get("buffer"), name)
        if start + length > len(buffer):
            raise self._file.damaged(
                f"{name} ends at byte {start + length}, its buffer at {len(buffer)}"
            )
        return buffer[start : start + length]

    def named(self, uri: Any, where: str) -> bytes:
        """Return the content of a URI: embedded data, or a file in the model's folder.

        Raises
        ------
        Engine3DError
        """
        if not isinstance(uri, str):
            raise self._file.damaged(f"{where}: a URI that is no text")
        if uri[:5].lower() == "data:":
            return self._data_uri(uri, where)
        try:
            with self._files.read(self._files.find_uri(uri)) as source:
                return source.data
        except LinkedFileError as error:
            raise DamagedError(f"{where}: {shown(uri)}: {error}", self._file.path) from None

    def _data_uri(self, uri: str, where: str) -> bytes:
        head, comma, body = uri.partition(",")
        if not comma:
            raise self._file.damaged(f"{where}: a data URI without a comma")
        if not head.lower().endswith(";base64"):
            return percent_decoded(body)
        try:
            return binascii.a2b_base64(body)
        except ValueError as error:
            raise self._file.damaged(f"{where}: {error}") from error

    def _buffer(self, index: Any, where: str) -> memoryview:
        index = self._file.number_in("buffers", index, where)
        return once(self._buffers, index, lambda: self._read(index))

    def _read(self, index: int) -> memoryview:
        buffer, name = self._file.entries("buffers")[index], f"buffers[{index}]"
        length = self._file.whole(buffer, "byteLength", name)
        uri = buffer.get("uri")
        if uri is not None:
            data = memoryview(self.named(uri, name))
            if uri[:5].lower() != "data:":
                self._file_bytes += len(data)
                self.limit += _NUMBERS_PER_BYTE * len(data)
        elif index == 0 and self._file.binary is not None:
            data = self._file.binary
        else:
            self.allow(length, name)
            self._file.warnings.add(f"{name} has no data: zeros instead")
            data = memoryview(bytes(length))
        if len(data) < length:
            raise self._file.damaged(
                f"{name} is announced with {length} bytes, there are {len(data)}"
            )
        return data[:length]
