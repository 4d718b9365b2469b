"""Reuses the memory of frame outputs.

In: shapes and dtypes. Out: arrays that belong to the caller; their memory returns to the pool when
no array on it lives any more. So a loop that drops its frames allocates nothing (fresh memory would
cost a page fault every 4 KiB), and a kept frame is never overwritten.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .frame import OUTPUTS

#: Shape and dtype of each array, by name.
Shapes: TypeAlias = dict[str, tuple[tuple[int, ...], np.dtype[Any]]]

_LINE = 64
_MAX_FREE = 2  # frames' worth of free blocks kept: a steady loop needs one or two


def _aligned(size: int) -> NDArray[np.uint8]:
    """Return fresh bytes aligned to a cache line, so that tiles share few lines with neighbours."""
    room = np.empty(size + _LINE, np.uint8)
    start = -room.ctypes.data % _LINE
    return room[start : start + size]


def shapes_of(outputs: Iterable[str], width: int, height: int) -> Shapes:
    """Return the shape and dtype of each output of a picture."""
    wanted: Shapes = {}
    for name in outputs:
        dtype, channels = OUTPUTS[name]
        wanted[name] = ((height, width, channels) if channels else (height, width), dtype)
    return wanted


class OutputPool:
    """Blocks of memory by their size in bytes."""

    def __init__(self) -> None:
        self._free: dict[int, list[NDArray[np.uint8]]] = {}
        self._a_frame: dict[int, int] = {}  # by size, how many blocks the last frame used
        self._lent: dict[int, tuple[weakref.ref[NDArray[np.uint8]], NDArray[np.uint8]]] = {}

    def take(self, outputs: Shapes) -> dict[str, np.ndarray]:
        """Return an array with arbitrary contents for each of a frame's shapes and dtypes."""
        arrays, self._a_frame = {}, {}
        for name, (shape, dtype) in outputs.items():
            arrays[name] = array = self._lend(shape, dtype)
            self._a_frame[array.nbytes] = self._a_frame.get(array.nbytes, 0) + 1
        return arrays

    def prepare(self, outputs: Shapes) -> None:
        """Allocate a frame's memory and touch all its pages before the first frame."""
        for array in self.take(outputs).values():
            array.fill(0)

    def _lend(self, shape: tuple[int, ...], dtype: np.dtype[Any]) -> np.ndarray:
        size = dtype.itemsize * math.prod(shape)
        try:
            block = self._free[size].pop()
        except (KeyError, IndexError):
            block = _aligned(size)
        # NumPy does not look through the base of an array made from a memoryview, because it is not
        # an array: so every view of a view keeps `owner` alive, and `owner` dies after all of them.
        owner = np.frombuffer(block.data, np.uint8)
        reference = weakref.ref(owner, self._take_back)
        self._lent[id(reference)] = (reference, block)
        return np.ndarray(shape, dtype, owner)

    def forget(self) -> None:
        """Free unused memory; sizes that come back later are not kept for long."""
        self._free.clear()

    def _take_back(self, reference: weakref.ref[NDArray[np.uint8]]) -> None:
        # This runs in the thread that dropped the last array; each step is one atomic operation.
        _, block = self._lent.pop(id(reference))
        blocks = self._free.setdefault(block.nbytes, [])
        if len(blocks) < _MAX_FREE * self._a_frame.get(block.nbytes, 1):
            blocks.append(block)
