"""Triangulation of polygons, all polygons of a file at once.

In: the number of corners of each polygon, and the positions of all corners. Out: triangles as
corner numbers, in polygon order and with the polygon's winding; and which of their edges are the
polygon's own. Convex polygons become fans; a concave quad is cut from its reflex corner; other
concave polygons are ear-clipped. The work is limited, so that no file can hang a loader.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..._native import loaders as native


class WorkBudget:
    """The number of corner tests left for all concave polygons of a file.

    A hundred million tests take about a second.
    """

    def __init__(self, tests: int = 50_000_000) -> None:
        self.tests = tests

    @classmethod
    def for_file(cls, size: int) -> WorkBudget:
        """Return the budget for a file of a given size in bytes.

        Files up to a megabyte load within two seconds, larger ones within ten.
        """
        return cls(50_000_000 if size <= 1 << 20 else 300_000_000)


class Triangulation(NamedTuple):
    """Triangles of polygons.

    Attributes
    ----------
    corners : (T, 3) int32
        Corner numbers, counted over all polygons.
    polygons : (T,) int32
        The polygon of each triangle.
    edge_visible : (T, 3) bool or None
        Which edges are the polygon's own; None if all are.
    is_complete : bool
        False if some concave polygons were cut as fans, because the file has too many or one has
        more than 262,144 corners.
    """

    corners: np.ndarray
    polygons: np.ndarray
    edge_visible: np.ndarray | None
    is_complete: bool


def triangulate(
    sizes: np.ndarray,
    positions: np.ndarray,
    budget: WorkBudget | None = None,
    *,
    indices: np.ndarray | None = None,
) -> Triangulation:
    """Cut polygons into triangles.

    Parameters
    ----------
    sizes : (P,) int
        Corners of each polygon; fewer than three give no triangle.
    positions : (V, 3) float64 or float32
        The corners' positions, polygon after polygon, or the table for ``indices``.
    budget : WorkBudget, optional
        The work budget of concave polygons.
    indices : (C,) int32, optional
        The position of each corner; C is the sum of ``sizes``.

    Returns
    -------
    triangulation : Triangulation
        n - 2 triangles for a polygon of n corners, degenerate ones included.
    """
    sizes = np.ascontiguousarray(sizes, np.int32)
    if len(sizes) and sizes.min() == 3 == sizes.max():
        corners = np.arange(3 * len(sizes), dtype=np.int32).reshape(-1, 3)
        return Triangulation(corners, np.arange(len(sizes), dtype=np.int32), None, True)
    budget = budget or WorkBudget()
    if positions.dtype not in (np.float32, np.float64):
        positions = positions.astype(np.float64)
    positions = np.ascontiguousarray(positions)
    indices = None if indices is None else np.ascontiguousarray(indices, np.int32)
    triangles = int(np.maximum(sizes - 2, 0).sum(dtype=np.int64))
    corners, polygons, visible, is_complete, budget.tests = native.cut_polygons(
        sizes, positions, indices, int(sizes.sum(dtype=np.int64)), triangles, budget.tests
    )
    return Triangulation(corners, polygons, visible, is_complete)
