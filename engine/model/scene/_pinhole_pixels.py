"""Pixels of cameras that have a projection matrix: where points are, and where pixels look.

In: clip_from_view and the picture's size. Out: float64, in single operations: the same bits on
every machine.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...base.linalg.vectors import as_vectors

Floats = NDArray[np.float64]


def pixels_of(matrix: Floats, size: tuple[int, int], points: ArrayLike) -> Floats:
    """Return the pixels (..., 2) of points (..., 3) in camera space; NaN behind the camera."""
    given = as_vectors("points", points)
    x, y, _, w = (linalg.dot(given, row[:3]) + row[3] for row in matrix)
    with np.errstate(all="ignore"):
        w = np.where(w > 0.0, w, np.nan)
        return np.stack([(x / w + 1.0) * (0.5 * size[0]), (1.0 - y / w) * (0.5 * size[1])], axis=-1)


def directions_of(matrix: Floats, size: tuple[int, int], pixels: ArrayLike) -> Floats:
    """Return the unit directions (..., 3) in which pixels (..., 2) look, in camera space."""
    given = as_vectors("pixels", pixels, 2)
    # The plane of the points (x, y, -1) that a pixel shows: two equations in x and y.
    across = 2.0 * given[..., 0] / size[0] - 1.0
    upward = 1.0 - 2.0 * given[..., 1] / size[1]
    a, b, c = (matrix[0, k] - across * matrix[3, k] for k in range(3))
    d, e, f = (matrix[1, k] - upward * matrix[3, k] for k in range(3))
    direction = np.stack([b * f - c * e, c * d - a * f, a * e - b * d], axis=-1)
    ahead = matrix[3, :3] if matrix[3, :3].any() else matrix[2, :3]
    flip = linalg.dot(direction, ahead) < 0.0
    direction[flip] = -direction[flip]
    return linalg.normalize(direction)
