"""Equal rows of an array found.

In: rows of numbers, such as the corners of all triangles of a file. Out: the number of each row,
equal ones having the same, in the order of their first appearance. Rows are equal if all their bits
are, but for the two zeros; the result is exact, whatever the rows hold.
"""

from __future__ import annotations

import numpy as np

# Odd numbers that spread the bits of each column over all 64.
_MIXERS = (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0xD6E8FEB86659FD93)


def number_rows(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number rows, equal ones alike.

    Parameters
    ----------
    rows : (N, 1..4) float32 or uint8

    Returns
    -------
    numbers : (N,) int64
    first : (M,) int64
        The first row of each number, in rising order.
    """
    bits = _bits(rows)
    keys = np.zeros(len(bits), np.uint64)
    with np.errstate(over="ignore"):
        for column, mixer in enumerate(_MIXERS[: bits.shape[1]]):
            keys ^= bits[:, column] * np.uint64(mixer)
    numbers, first = _in_order(keys)
    if (bits != bits[first[numbers]]).any():
        # Different rows with the same key: rare, unless somebody made them.
        numbers, first = _number_by_columns(bits)
    return numbers, first


def _bits(rows: np.ndarray) -> np.ndarray:
    if rows.dtype == np.uint8:
        return rows.astype(np.uint64)
    # Adding zero turns -0 into 0.
    return (rows + np.float32(0)).view(np.uint32).astype(np.uint64)


def _in_order(keys: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number keys in the order of their first appearance."""
    _, first, numbers = np.unique(keys, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return rank[numbers.reshape(-1)], first[order]


def _number_by_columns(bits: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    numbers = np.zeros(len(bits), np.int64)
    for column in bits.T:
        values, index = np.unique(column, return_inverse=True)
        _, numbers = np.unique(numbers * len(values) + index.reshape(-1), return_inverse=True)
        numbers = numbers.reshape(-1)
    return _in_order(numbers)
