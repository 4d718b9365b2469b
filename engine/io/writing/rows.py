"""Arrays as lines of text.

In: arrays of numbers. Out: bytes, a line per row. Floats get the fewest digits that read back as
the same float32, independent of the locale.
"""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np
from numpy.typing import ArrayLike

from ..._native import writers as native

# Rows formatted at a time, to limit the memory for their text.
_BLOCK = 1 << 16


def write_floats(file: BinaryIO, prefix: str, rows: np.ndarray) -> None:
    """Write float32 rows (N, K), each after ``prefix``."""
    between = [prefix.encode(), *[b" "] * (rows.shape[1] - 1), b"\n"]
    write_float_rows(file, between, rows)


def write_float_rows(file: BinaryIO, between: list[bytes], rows: np.ndarray) -> None:
    """Write float32 rows (N, K) with K + 1 words before, between and after their numbers."""
    for block in _blocks(np.ascontiguousarray(rows, np.float32)):
        file.write(native.float_rows(block, between).data)


def write_integers(file: BinaryIO, pattern: str, rows: np.ndarray) -> None:
    """Write integer rows by a pattern such as ``"f %d %d %d"``."""
    line = pattern.encode() + b"\n"
    for block in _blocks(rows):
        file.write(line * len(block) % tuple(block.ravel().tolist()))


def float_words(values: ArrayLike) -> list[bytes]:
    """Return the shortest words for float32 numbers, ``1`` rather than ``1.0``."""
    column = np.ascontiguousarray(values, np.float32).reshape(-1, 1)
    return native.float_rows(column, [b"", b"\n"]).tobytes().split()


def _blocks(rows: np.ndarray) -> Any:
    for start in range(0, len(rows), _BLOCK):
        yield rows[start : start + _BLOCK]
