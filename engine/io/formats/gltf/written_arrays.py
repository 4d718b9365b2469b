"""The binary part of a written glTF file: arrays and images, one after another.

In: arrays and bytes. Out: their accessor and buffer view numbers, and the chunks. Equal arrays are
written once.
"""

from __future__ import annotations

from hashlib import blake2b
from typing import Any

import numpy as np

_TYPES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
_SHAPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
_VERTICES, _INDICES = 34962, 34963
_STEP = 4  # alignment of arrays in bytes


class GltfArrays:
    """The binary data of a file.

    Attributes
    ----------
    accessors, views : list of dict
        The lists in the JSON.
    chunks : list of bytes-like
    size : int
        Bytes of all chunks.
    """

    def __init__(self) -> None:
        self.accessors: list[dict[str, Any]] = []
        self.views: list[dict[str, Any]] = []
        self.chunks: list[Any] = []
        self.size = 0
        self._numbers: dict[tuple[Any, ...], int] = {}

    def vertices(self, array: np.ndarray, what: str) -> int:
        """Return the accessor of an attribute, (V, N); positions get bounds.

        Arrays with equal content share an accessor, so that a file read and written again stays the
        same, even if reading split its arrays.
        """
        content = np.ascontiguousarray(array)
        known = what, content.dtype.str, content.shape, blake2b(content.data).digest()
        if known not in self._numbers:
            self._numbers[known] = self.add(content, bounds=what == "POSITION", target=_VERTICES)
        return self._numbers[known]

    def numbers(self, array: np.ndarray, what: str) -> int:
        """Return the accessor of a custom attribute, (V, N); rows begin at multiples of 4 bytes."""
        width = array.shape[1]
        if array.dtype.itemsize * width % _STEP == 0:
            return self.vertices(array, what)
        lacking = -width % (_STEP // array.dtype.itemsize)
        number = self.vertices(np.pad(array, ((0, 0), (0, lacking))), f"{what} of {width}")
        accessor = self.accessors[number]
        stride = array.dtype.itemsize * (width + lacking)
        self.views[accessor["bufferView"]]["byteStride"] = stride
        accessor["type"] = _SHAPES[width]
        return number

    def indices(self, elements: np.ndarray) -> int:
        """Return the accessor of indices, in the narrowest suitable type."""
        wide = elements.size and int(elements.max()) >= 0xFFFF
        return self.add(elements.ravel().astype("<u4" if wide else "<u2"), target=_INDICES)

    def add(self, array: np.ndarray, *, bounds: bool = False, target: int | None = None) -> int:
        """Return a new accessor of an array, (N,) or (N, columns)."""
        rows = array.reshape(len(array), -1)
        content = np.ascontiguousarray(rows, rows.dtype.newbyteorder("<"))
        view = self.bytes(content.data.cast("B") if content.size else b"", target)
        accessor = {
            "bufferView": view,
            "componentType": _TYPES[rows.dtype.str[1:]],
            "count": len(rows),
            "type": _SHAPES[rows.shape[1]],
        }
        if bounds and len(rows) and np.isfinite(rows).all():
            accessor["min"], accessor["max"] = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def bytes(self, content: Any, target: int | None = None) -> int:
        """Return the view of some bytes."""
        view = {"buffer": 0, "byteOffset": self.size, "byteLength": len(content)}
        if target is not None:
            view["target"] = target
        self.views.append(view)
        padding = -len(content) % _STEP
        self.chunks += [content, bytes(padding)]
        self.size += len(content) + padding
        return len(self.views) - 1
