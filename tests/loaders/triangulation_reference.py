"""Polygons cut into triangles with NumPy and Python: what the loaders' C is compared with.

In: the number of corners of each polygon, and the positions of all corners. Out: triangles as
corner numbers, in the order of the polygons, each polygon wound as it was; and which of their edges
are the polygon's own. Convex polygons become fans; a concave quad is cut from its reflex corner;
other concave polygons have their ears clipped.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from loaders.ear_clipping_reference import WorkBudget, clip_ears

# A corner counts as reflex if it turns back by more than this share of the polygon's area: flat
# corners, and those bent by rounding, are left to the fan.
_FLAT = 1e-9
# Corners worked on at a time, which bounds the memory for intermediate results.
_BLOCK = 1 << 17
# Polygons of more corners are cut as fans, whatever they look like.
_MOST_CORNERS = 1 << 18


class Triangulation(NamedTuple):
    """Triangles of polygons.

    Attributes
    ----------
    corners : (T, 3) int32
        Corner numbers, counted over all polygons.
    polygons : (T,) int32
        The polygon that each triangle is part of.
    edge_visible : (T, 3) bool or None
        Which edges are the polygon's; None if all are.
    is_complete : bool
        False if some concave polygons were cut as fans because the file holds too many.
    """

    corners: np.ndarray
    polygons: np.ndarray
    edge_visible: np.ndarray | None
    is_complete: bool


def triangulate(
    sizes: np.ndarray, positions: np.ndarray, budget: WorkBudget | None = None
) -> Triangulation:
    """Cut polygons into triangles.

    Parameters
    ----------
    sizes : (P,) int
        Corners of each polygon; those of fewer than three give no triangle.
    positions : (C, 3) float64
        The corners' positions, polygon after polygon; C is the sum of ``sizes``.
    budget : WorkBudget, optional
        The work that concave polygons may take.

    Returns
    -------
    triangulation : Triangulation
        n - 2 triangles for a polygon of n corners, degenerate ones included.
    """
    if len(sizes) and sizes.min() == 3 == sizes.max():
        corners = np.arange(3 * len(sizes), dtype=np.int32).reshape(-1, 3)
        return Triangulation(corners, np.arange(len(sizes), dtype=np.int32), None, True)
    counts = np.maximum(sizes - 2, 0)
    first_triangle = np.cumsum(counts) - counts
    first_corner = np.cumsum(sizes) - sizes
    # Corner numbers within the polygon first, then within the file.
    corners = np.empty((int(counts.sum()), 3), np.int32)
    polygons = np.repeat(np.arange(len(sizes), dtype=np.int32), counts)
    budget = budget or WorkBudget()
    # Which sizes occur; np.unique would import numpy.ma for it, a tenth of a small picture's time.
    for size in (np.flatnonzero(np.bincount(sizes)[3:]) + 3).tolist():
        members = np.flatnonzero(sizes == size)
        step = max(_BLOCK // size, 1)
        for start in range(0, len(members), step):
            block = members[start : start + step]
            rows = first_triangle[block, np.newaxis] + np.arange(size - 2)
            corners[rows] = _cut_polygons(size, positions, first_corner[block], budget)
    last = (1 - sizes[polygons]).astype(np.int32)
    edge_visible = np.empty(corners.shape, bool)
    for edge in range(3):
        step = corners[:, (edge + 1) % 3] - corners[:, edge]
        edge_visible[:, edge] = (step == 1) | (step == last)
    corners += first_corner[polygons].astype(np.int32)[:, np.newaxis]
    visible = None if edge_visible.all() else edge_visible
    return Triangulation(corners, polygons, visible, not budget.is_spent)


def _cut_polygons(size, positions, first_corner, budget) -> np.ndarray:
    """Cut polygons of one size: (P, size - 2, 3) corner numbers within each polygon."""
    cut = np.zeros((len(first_corner), size - 2, 3), np.int32)
    cut[:, :, 1] = np.arange(1, size - 1, dtype=np.int32)
    cut[:, :, 2] = cut[:, :, 1] + 1
    if size > _MOST_CORNERS:
        budget.tests = 0
    if size == 3 or size > _MOST_CORNERS:
        return cut
    outlines = positions[first_corner[:, np.newaxis] + np.arange(size)]
    area = _area_vectors(outlines)
    reflex = _reflex_corners(outlines, area)
    concave = np.flatnonzero(reflex.any(axis=1))
    if size == 4:
        start = reflex[concave].argmax(axis=1)
        cut[concave] = (cut[concave] + start[:, np.newaxis, np.newaxis]) % 4
        return cut
    for polygon in concave.tolist():
        if budget.is_spent:
            break
        cut[polygon] = clip_ears(_projected(outlines[polygon], area[polygon]), budget)
    return cut


def _area_vectors(outlines: np.ndarray) -> np.ndarray:
    """Newell's area vector, twice the area long, of polygons (P, n, 3): (P, 3).

    Sums run in the order of the corners, whatever the processor, so that ties between axes are
    the same everywhere.
    """
    area = np.empty((len(outlines), 3), np.float64)
    with np.errstate(all="ignore"):
        for axis in range(3):
            a, b = (
                outlines[:, :, (axis + k) % 3] - outlines[:, :1, (axis + k) % 3] for k in (1, 2)
            )
            terms = a * np.roll(b, -1, axis=1) - b * np.roll(a, -1, axis=1)
            area[:, axis] = np.cumsum(terms, axis=1)[:, -1]
    area[~np.isfinite(area).all(axis=1)] = 0
    return area


def _reflex_corners(outlines: np.ndarray, area: np.ndarray) -> np.ndarray:
    """Which corners (P, n) turn against their polygon; none where a corner is not finite."""
    along = np.zeros(outlines.shape[:2], np.float64)
    with np.errstate(all="ignore"):
        edges = np.roll(outlines, -1, axis=1) - outlines
        before = np.roll(edges, 1, axis=1)
        for axis in range(3):
            y, z = (axis + 1) % 3, (axis + 2) % 3
            turn = before[:, :, y] * edges[:, :, z] - before[:, :, z] * edges[:, :, y]
            along += turn * area[:, axis, np.newaxis]
        size = area[:, 0] ** 2 + area[:, 1] ** 2 + area[:, 2] ** 2
        return (along < -_FLAT * size[:, np.newaxis]) & (size > 0)[:, np.newaxis]


def _projected(outline: np.ndarray, area: np.ndarray) -> list[tuple[float, float]]:
    """The outline along the axis that its area vector follows most."""
    kept = np.delete(np.arange(3), np.abs(area).argmax())
    return list(map(tuple, outline[:, kept].tolist()))
