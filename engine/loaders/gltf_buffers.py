"""The numbers of a glTF file, from wherever its accessors say that they are.

In: a `GltfFile`. Out: arrays. Nothing is allocated for what the file announces before it was found
to hold it: an accessor without bytes of its own stands for any number of zeros, and any number of
meshes may use the same one.
"""

from __future__ import annotations

import binascii
from urllib.parse import unquote_to_bytes

import numpy as np

from .gltf_file import GltfFile
from .linked_files import LinkedFileError, LinkedFiles
from .posed_parts import MAX_REPEATED
from .sources import Source
from .text import shown

_TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_INDEX_TYPES = (5121, 5123, 5125)
# Several primitives may share what takes a byte a number, honestly.
_NUMBERS_PER_BYTE = 4
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class GltfBuffers:
    """The buffers of a file, each read once.

    Parameters
    ----------
    file : GltfFile
    source : Source
        Where it is from.

    Attributes
    ----------
    limit : int
        How many numbers all accessors may have together, each counted whenever it is asked for.
        Grows with the files that are read.
    """

    def __init__(self, file: GltfFile, source: Source) -> None:
        self._file = file
        self._files = LinkedFiles(source.folder)
        self._buffers: dict[int, memoryview] = {}
        self._given = 0
        self.limit = MAX_REPEATED + _NUMBERS_PER_BYTE * source.size

    def floats(self, index: int, where: str, *widths: int) -> np.ndarray:
        """Return an accessor as (N, width) float32; integers that stand for 0..1 or -1..1 as such.

        Parameters
        ----------
        index : int
        where : str
            The place that names it.
        *widths : int
            How many columns it may have.
        """
        values = self._values(index, where, widths)
        if self._file.entries("accessors")[index].get("normalized") is True:
            if values.dtype.kind not in "iu":
                raise self._file.error(f"damaged: accessors[{index}] has normalized floats")
            return np.maximum(values / np.float32(np.iinfo(values.dtype).max), np.float32(-1))
        return values.astype(np.float32)

    def indices(self, index: int, where: str) -> np.ndarray:
        """Return an accessor of indices as (N,) int64."""
        values = self._values(index, where, (1,))
        if values.dtype.kind != "u":
            raise self._file.error(f"damaged: accessors[{index}], indices, is not unsigned")
        return values[:, 0].astype(np.int64)

    def view(self, index, where: str) -> memoryview:
        """Return the bytes of a buffer view."""
        view = self._file.entry("bufferViews", index, where)
        name = f"bufferViews[{index}]"
        start = self._file.whole(view, "byteOffset", name, 0)
        length = self._file.whole(view, "byteLength", name)
        buffer = self._buffer(view.get("buffer"), name)
        if start + length > len(buffer):
            raise self._file.error(
                f"damaged: {name} ends at byte {start + length}, its buffer at {len(buffer)}"
            )
        return buffer[start : start + length]

    def named(self, uri, where: str) -> bytes:
        """Return what a URI stands for: data in itself, or a file in the model's folder.

        Raises
        ------
        Engine3DError
        """
        if not isinstance(uri, str):
            raise self._file.error(f"damaged: {where}: a URI that is no text")
        if uri[:5].lower() == "data:":
            return self._data_uri(uri, where)
        try:
            with self._files.read(self._files.find_uri(uri)) as source:
                return source.data
        except LinkedFileError as error:
            raise self._file.error(f"{where}: {shown(uri)}: {error}") from None

    def _data_uri(self, uri: str, where: str) -> bytes:
        head, comma, body = uri.partition(",")
        if not comma:
            raise self._file.error(f"damaged: {where}: a data URI without a comma")
        if not head.lower().endswith(";base64"):
            return unquote_to_bytes(body)
        try:
            return binascii.a2b_base64(body)
        except ValueError as error:
            raise self._file.error(f"damaged: {where}: {error}") from error

    def _buffer(self, index, where: str) -> memoryview:
        buffer = self._file.entry("buffers", index, where)
        if index not in self._buffers:
            self._buffers[index] = self._read(buffer, index)
        return self._buffers[index]

    def _read(self, buffer: dict, index: int) -> memoryview:
        name = f"buffers[{index}]"
        length = self._file.whole(buffer, "byteLength", name)
        uri = buffer.get("uri")
        if uri is not None:
            data = memoryview(self.named(uri, name))
            if uri[:5].lower() != "data:":
                self.limit += _NUMBERS_PER_BYTE * len(data)
        elif index == 0 and self._file.binary is not None:
            data = self._file.binary
        else:
            extensions = ", ".join(map(str, self._file.part(buffer, "extensions", name)))
            note = f" but for {shown(extensions)}, which is not read" if extensions else ""
            raise self._file.error(f"{name} has no data{note}")
        if len(data) < length:
            raise self._file.error(
                f"damaged: {name} is announced with {length} bytes, there are {len(data)}"
            )
        return data[:length]

    def _values(self, index, where: str, widths: tuple[int, ...]) -> np.ndarray:
        """An accessor as (N, width), of its own type; may be part of the file's bytes."""
        accessor = self._file.entry("accessors", index, where)
        name = f"accessors[{index}]"
        count = self._file.whole(accessor, "count", name)
        kind = accessor.get("type")
        width = _WIDTHS.get(kind, 0) if isinstance(kind, str) else 0
        if width not in widths:
            raise self._file.error(f"damaged: {name}, {where}, is of the type {shown(str(kind))}")
        if not count:
            raise self._file.error(f"damaged: {name} is empty")
        self._count(count * width)
        values = self._stored(accessor, name, count, width, self._type(accessor, name))
        if "sparse" in accessor:
            values = self._changed(values, self._file.part(accessor, "sparse", name), name)
        return values

    def _count(self, numbers: int) -> None:
        self._given += numbers
        if self._given > self.limit:
            raise self._file.error(
                f"its meshes announce more than {self.limit} numbers, the limit for its size"
            )

    def _type(self, entry: dict, name: str) -> np.dtype:
        kind = entry.get("componentType")
        if type(kind) is not int or kind not in _TYPES:
            raise self._file.error(f"damaged: {name} has no component type that is known")
        return np.dtype(_TYPES[kind])

    def _stored(self, entry: dict, name: str, count: int, width: int, kind) -> np.ndarray:
        """Rows that stand in a buffer view, or zeros."""
        if "bufferView" not in entry:
            return np.zeros((count, width), kind)
        data = self.view(entry["bufferView"], name)
        view = self._file.entry("bufferViews", entry["bufferView"], name)
        row = width * kind.itemsize
        stride = self._file.whole(view, "byteStride", name, row)
        start = self._file.whole(entry, "byteOffset", name, 0)
        if stride < row:
            raise self._file.error(f"damaged: {name} has rows of {row} bytes every {stride}")
        end = start + (count - 1) * stride + row
        if end > len(data):
            raise self._file.error(f"damaged: {name} ends at byte {end}, its view at {len(data)}")
        return np.ndarray((count, width), kind, data, start, (stride, kind.itemsize))

    def _changed(self, values: np.ndarray, sparse: dict, name: str) -> np.ndarray:
        """A copy with some rows replaced."""
        count = self._file.whole(sparse, "count", f"{name}.sparse")
        if not 0 < count <= len(values):
            raise self._file.error(f"damaged: {name}.sparse changes {count} of {len(values)} rows")
        where, what = (self._file.part(sparse, part, name) for part in ("indices", "values"))
        if where.get("componentType") not in _INDEX_TYPES:
            raise self._file.error(f"damaged: {name}.sparse.indices is not unsigned")
        place = f"{name}.sparse"
        if "bufferView" not in where or "bufferView" not in what:
            raise self._file.error(f"damaged: {place} has no buffer view")
        rows = self._stored(where, place, count, 1, self._type(where, place))[:, 0]
        if int(rows.max()) >= len(values):
            raise self._file.error(f"damaged: {place} changes row {rows.max()} of {len(values)}")
        changed = values.copy()
        changed[rows] = self._stored(what, place, count, values.shape[1], values.dtype)
        return changed
