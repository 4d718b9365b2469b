"""Memory for a frame's outputs, used again and again.

In: shapes and dtypes. Out: arrays that are the caller's own for as long as any array on their
memory lives; only then does the memory come back. So a loop that lets go of its frames allocates
nothing (fresh memory would cost a page fault every 4 KiB), and a frame that is kept is never drawn
over.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .frame import OUTPUTS

#: Shape and dtype of arrays, by name.
Shapes: TypeAlias = dict[str, tuple[tuple[int, ...], np.dtype[Any]]]

_LINE = 64
_MAX_FREE = 2  # frames' worth of blocks that are kept: a steady loop needs one or two


def _aligned(size: int) -> NDArray[np.uint8]:
    """Return fresh bytes that begin with a cache line: tiles then share few with neighbours."""
    room = np.empty(size + _LINE, np.uint8)
    start = -room.ctypes.data % _LINE
    return room[start : start + size]


def shapes_of(outputs: Iterable[str], width: int, height: int) -> Shapes:
    """Return shape and dtype of each output of a picture."""
    wanted: Shapes = {}
    for name in outputs:
        dtype, channels = OUTPUTS[name]
        wanted[name] = ((height, width, channels) if channels else (height, width), dtype)
    return wanted


class OutputPool:
    """Blocks of memory by their size in bytes."""

    def __init__(self) -> None:
        self._free: dict[int, list[NDArray[np.uint8]]] = {}
        self._a_frame: dict[int, int] = {}  # of each size, how many the last frame has
        self._lent: dict[int, tuple[weakref.ref[NDArray[np.uint8]], NDArray[np.uint8]]] = {}

    def take(self, outputs: Shapes) -> dict[str, np.ndarray]:
        """Return an array with arbitrary contents for each of a frame's shapes and dtypes."""
        arrays, self._a_frame = {}, {}
        for name, (shape, dtype) in outputs.items():
            arrays[name] = array = self._lend(shape, dtype)
            self._a_frame[array.nbytes] = self._a_frame.get(array.nbytes, 0) + 1
        return arrays

    def prepare(self, outputs: Shapes) -> None:
        """Have memory for a frame's arrays, and all its pages, before there is a frame."""
        for array in self.take(outputs).values():
            array.fill(0)

    def _lend(self, shape: tuple[int, ...], dtype: np.dtype[Any]) -> np.ndarray:
        size = dtype.itemsize * math.prod(shape)
        try:
            block = self._free[size].pop()
        except (KeyError, IndexError):
            block = _aligned(size)
        # The base of an array made from a memoryview is not an array, so NumPy does not look
        # through it: every view of a view holds on to `owner`, whose end is the end of them all.
        owner = np.frombuffer(block.data, np.uint8)
        reference = weakref.ref(owner, self._take_back)
        self._lent[id(reference)] = (reference, block)
        return np.ndarray(shape, dtype, owner)

    def forget(self) -> None:
        """Free what is not in use; sizes that come back later are not kept for long."""
        self._free.clear()

    def _take_back(self, reference: weakref.ref[NDArray[np.uint8]]) -> None:
        # Runs in whatever thread dropped the last array; each step is one atomic operation.
        _, block = self._lent.pop(id(reference))
        blocks = self._free.setdefault(block.nbytes, [])
        if len(blocks) < _MAX_FREE * self._a_frame.get(block.nbytes, 1):
            blocks.append(block)
