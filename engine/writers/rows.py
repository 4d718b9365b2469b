"""Arrays as lines of text.

In: arrays of numbers. Out: bytes, a line a row. Floats are written with the fewest digits that read
back as the same float32; nothing depends on the locale.
"""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

# Rows made at a time, which bounds the memory for their text.
_BLOCK = 1 << 16


def write_floats(file: BinaryIO, prefix: str, rows: np.ndarray) -> None:
    """Write float32 rows (N, K), each behind ``prefix``."""
    pattern = prefix.encode() + b" ".join([b"%s"] * rows.shape[1]) + b"\n"
    for block in _blocks(np.asarray(rows, np.float32)):
        file.write(pattern * len(block) % tuple(float_words(block)))


def write_integers(file: BinaryIO, pattern: str, rows: np.ndarray) -> None:
    """Write integer rows, each by a pattern such as ``"f %d %d %d"``."""
    line = pattern.encode() + b"\n"
    for block in _blocks(rows):
        file.write(line * len(block) % tuple(block.ravel().tolist()))


def float_words(values: np.ndarray) -> list[bytes]:
    """Return the shortest words for float32 numbers, ``1`` rather than ``1.0``."""
    # Models repeat themselves: each number is put into words once. By their bits, 0 is not -0.
    bits = np.ascontiguousarray(values, np.float32).ravel().view(np.int32)
    distinct, number = np.unique(bits, return_inverse=True)
    words = distinct.view(np.float32).astype("S24").tolist()
    words = [word[:-2] if word.endswith(b".0") else word for word in words]
    return np.array(words, object)[number.reshape(-1)].tolist()


def _blocks(rows: np.ndarray):
    for start in range(0, len(rows), _BLOCK):
        yield rows[start : start + _BLOCK]
