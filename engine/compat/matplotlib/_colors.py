"""Colours as matplotlib gives them, as codes.

In: RGBA rows of floats. Out: rows of uint8, repeated as collections repeat theirs.
"""

from __future__ import annotations

import numpy as np
from matplotlib import colors as mcolors


def codes_of(colors, alpha=None) -> np.ndarray:
    """Return (N, 4) uint8 of colours as matplotlib takes them; what is not a number is 0."""
    rgba = np.nan_to_num(np.asarray(mcolors.to_rgba_array(colors, alpha), float).reshape(-1, 4))
    return np.rint(np.clip(rgba, 0.0, 1.0) * 255.0).astype(np.uint8)


def cycled(rows: np.ndarray, count: int) -> np.ndarray:
    """Return a row for each of many elements, as collections repeat theirs; none: clear."""
    if len(rows) == 0:
        return np.zeros((count, *rows.shape[1:]), rows.dtype)
    if len(rows) == 1:
        return np.broadcast_to(rows[0], (count, *rows.shape[1:]))
    return rows[np.arange(count) % len(rows)]
