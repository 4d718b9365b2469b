"""Cleans normals and texture coordinates of files for a `Mesh`.

In: arrays as read. Out: finite texture coordinates, and normals that all have a direction, or none.
"""

from __future__ import annotations

import numpy as np

from ...model.geometry.normals import vertex_normals

# Normals whose largest component is outside this range have no direction in float32.
_SHORTEST, _LONGEST = 1e-15, 1e15


def finite_uvs(values: np.ndarray) -> np.ndarray:
    """Return texture coordinates as float32, with zeros for non-finite ones."""
    with np.errstate(over="ignore"):
        uvs = values.astype(np.float32)
    uvs[~np.isfinite(uvs)] = 0
    return uvs


def usable_normals(
    normals: np.ndarray | None, positions: np.ndarray, faces: np.ndarray
) -> np.ndarray | None:
    """Return normals, with computed ones for those without a direction; None if all lack one."""
    if normals is None:
        return None
    with np.errstate(invalid="ignore"):
        # Column by column: along such short rows NumPy takes ten times as long.
        x, y, z = (np.abs(normals[:, axis]) for axis in range(3))
        largest = np.maximum(np.maximum(x, y), z)
        usable = (largest >= _SHORTEST) & (largest <= _LONGEST)
    if usable.all():
        return normals
    if not usable.any():
        return None
    filled = normals.copy()
    filled[~usable] = vertex_normals(positions.astype(np.float32), faces)[~usable]
    return filled
