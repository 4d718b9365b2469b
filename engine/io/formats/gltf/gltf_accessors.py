"""Accessors: the numeric arrays of a glTF file.

In: a `GltfFile` and its buffers. Out: arrays. An accessor without data means any number of zeros,
and any number of meshes may use its rows: `GltfBuffers.count` limits the total.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...._native.loaders import large_array
from ...reading.text import shown
from .gltf_buffers import GltfBuffers
from .gltf_file import DamagedError, Entry, GltfFile, once, whole_of

_TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_INDEX_TYPES = (5121, 5123, 5125)
_LARGE = 1 << 12  # from this many numbers on, allocate large memory pages
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class GltfAccessors:
    """The accessors of a file, each resolved once.

    Parameters
    ----------
    file : GltfFile
    buffers : GltfBuffers

    Attributes
    ----------
    file : GltfFile
    """

    def __init__(self, file: GltfFile, buffers: GltfBuffers) -> None:
        self.file, self._buffers = file, buffers
        self._kept: dict[int, np.ndarray | DamagedError] = {}

    def count(self, numbers: int) -> None:
        """Count numbers that are created in addition; see `GltfBuffers.count`."""
        self._buffers.count(numbers)

    def raw(self, index: Any, where: str, *widths: int) -> np.ndarray:
        """Return an accessor as (N, width), in its own dtype; it may be a view of the file's bytes.

        Parameters
        ----------
        index : int
        where : str
            The place that refers to it.
        *widths : int
            Allowed numbers of columns: 16 for a matrix.
        """
        index = self.check(index, where, *widths)
        return once(self._kept, index, lambda: self._values(index))

    def check(self, index: Any, where: str, *widths: int) -> int:
        """Return the number of an accessor, checked for its number of columns."""
        index = self.file.number_in("accessors", index, where)
        kind = self.file.entries("accessors")[index].get("type")
        if not isinstance(kind, str) or _WIDTHS.get(kind, 0) not in widths:
            raise self.file.damaged(
                f"accessors[{index}], {where}, is of the type {shown(str(kind))}"
            )
        return index

    def typed(self, values: np.ndarray, index: int) -> np.ndarray:
        """Return unpacked values in the dtype that the accessor announces."""
        kind = self._type(self._entry(index), f"accessors[{index}]")
        if kind.kind == "f" or values.dtype == kind:
            return values.astype(kind, copy=False)
        range_of = np.iinfo(kind)
        return np.nan_to_num(values).clip(range_of.min, range_of.max).astype(kind)

    def floats(self, index: Any, where: str, *widths: int) -> np.ndarray:
        """Return an accessor as (N, width) float32; normalised integers become 0..1 or -1..1.

        Parameters as in `raw`.
        """
        return self.as_floats(self.raw(index, where, *widths), index)

    def as_floats(
        self, values: np.ndarray, index: int, rows: slice | np.ndarray = slice(None)
    ) -> np.ndarray:
        """Convert some rows of an accessor as `floats` does.

        Parameters
        ----------
        values : (N, width) array
        index : int
            The accessor, which says whether integers are normalised.
        rows : slice or (M,) int
        """
        is_all = isinstance(rows, slice)
        values = values[rows]
        self._buffers.count(values.size)
        # Some exporters also set it for floats, where it has no meaning.
        if not self._is_normalized(index) or values.dtype.kind == "f":
            return _copied(values) if is_all else values.astype(np.float32, copy=False)
        return np.maximum(values / np.float32(np.iinfo(values.dtype).max), np.float32(-1))

    def as_numbers(
        self, values: np.ndarray, index: int, rows: slice | np.ndarray = slice(None)
    ) -> np.ndarray:
        """Convert as `as_floats`, but keep integers that are not normalised."""
        if self._is_normalized(index):
            return self.as_floats(values, index, rows)
        values = values[rows]
        self._buffers.count(values.size)
        return values.copy()

    def width(self, index: Any, where: str) -> int:
        """Return an accessor's number of columns; 0 for unsupported types."""
        kind = self.file.entry("accessors", index, where).get("type")
        return _WIDTHS.get(kind, 0) if isinstance(kind, str) else 0

    def _is_normalized(self, index: int) -> bool:
        """Return whether an accessor's integers mean 0..1 or -1..1."""
        return self._entry(index).get("normalized") is True

    def _entry(self, index: int) -> Entry:
        return self.file.entry("accessors", index, "accessors")

    def indices(self, index: Any, where: str) -> np.ndarray:
        """Return an accessor of indices as (N,), with an unsigned dtype."""
        values = self.raw(index, where, 1)
        if values.dtype.kind != "u":
            raise self.file.damaged(f"accessors[{index}], indices, is not unsigned")
        self._buffers.count(len(values))
        return values[:, 0]

    def _values(self, index: int) -> np.ndarray:
        accessor, name = self._entry(index), f"accessors[{index}]"
        count = self.file.whole(accessor, "count", name)
        width = _WIDTHS[accessor["type"]]
        if "bufferView" not in accessor or "sparse" in accessor:
            self._buffers.count(count * width)
        values = self._stored(accessor, name, count, width, self._type(accessor, name))
        if "sparse" in accessor:
            values = self._changed(values, self.file.part(accessor, "sparse", name), name)
        return values

    def _type(self, entry: Entry, name: str) -> np.dtype:
        kind = whole_of(entry.get("componentType"))
        if type(kind) is not int or kind not in _TYPES:
            raise self.file.damaged(f"{name} has no component type that is known")
        return np.dtype(_TYPES[kind])

    def _stored(
        self, entry: Entry, name: str, count: int, width: int, kind: np.dtype
    ) -> np.ndarray:
        """Return rows stored in a buffer view, or zeros."""
        if "bufferView" not in entry:
            return np.zeros((count, width), kind)
        data = self._buffers.view(entry["bufferView"], name)
        view = self.file.entry("bufferViews", entry["bufferView"], name)
        row = width * kind.itemsize
        stride = self.file.whole(view, "byteStride", name, row)
        start = self.file.whole(entry, "byteOffset", name, 0)
        if stride < row:
            raise self.file.damaged(f"{name} has rows of {row} bytes every {stride}")
        end = start + (count - 1) * stride + row if count else start
        if end > len(data):
            raise self.file.damaged(f"{name} ends at byte {end}, its view at {len(data)}")
        return np.ndarray((count, width), kind, data, start, (stride, kind.itemsize))

    def _changed(self, values: np.ndarray, sparse: Entry, name: str) -> np.ndarray:
        """Return a copy with the sparse rows replaced."""
        count = self.file.whole(sparse, "count", f"{name}.sparse")
        if not 0 < count <= len(values):
            raise self.file.damaged(f"{name}.sparse changes {count} of {len(values)} rows")
        where, what = (self.file.part(sparse, part, name) for part in ("indices", "values"))
        if whole_of(where.get("componentType")) not in _INDEX_TYPES:
            raise self.file.damaged(f"{name}.sparse.indices is not unsigned")
        place = f"{name}.sparse"
        if "bufferView" not in where or "bufferView" not in what:
            raise self.file.damaged(f"{place} has no buffer view")
        rows = self._stored(where, place, count, 1, self._type(where, place))[:, 0]
        if int(rows.max()) >= len(values):
            raise self.file.damaged(f"{place} changes row {rows.max()} of {len(values)}")
        changed = values.copy()
        changed[rows] = self._stored(what, place, count, values.shape[1], values.dtype)
        return changed


def _copied(values: np.ndarray) -> np.ndarray:
    """Return a float32 copy of the values."""
    if values.size < _LARGE:
        return values.astype(np.float32, order="C")
    made = large_array(values.shape, np.float32)
    made[:] = values
    return made
