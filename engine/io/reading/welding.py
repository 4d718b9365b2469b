"""Finds equal rows of an array.

In: rows of numbers, such as the corners of all triangles of a file. Out: a number for each row, the
same for equal rows, in order of first appearance. Rows are equal if all their bits are, except that
the two zeros are equal; the result is always exact.
"""

from __future__ import annotations

import numpy as np

from ..._native import loaders as native


def number_rows(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Number rows; equal rows get the same number.

    Parameters
    ----------
    rows : (N, C) float32 or uint32, or (N, 4) uint8

    Returns
    -------
    numbers : (N,) int32
    first : (M,) int32
        The first row of each number, in ascending order.
    """
    rows = np.ascontiguousarray(rows)
    return native.number_rows(rows.view(np.uint32), rows.dtype == np.float32)


def rows_repeat(rows: np.ndarray) -> bool:
    """Return whether any two rows are equal; faster than numbering if none are."""
    rows = np.ascontiguousarray(rows)
    return native.rows_repeat(rows.view(np.uint32), rows.dtype == np.float32)
