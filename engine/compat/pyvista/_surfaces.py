"""The cells of a ``vtkPolyData``: triangles, segments and points, each with its cell.

In: a ``vtkPolyData``. Out: arrays of indices of its points. Polygons become triangles as the
loaders of files cut them.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

from ...io.reading.triangulation import triangulate


class Triangles(NamedTuple):
    """The faces of a surface.

    Attributes
    ----------
    corners : (F, 3) int32
    cells : (F,) int32
    edges : (F, 3) bool or None
        Which edges are edges of polygons; None: all.
    """

    corners: NDArray[np.int32]
    cells: NDArray[np.int32]
    edges: NDArray[np.bool_] | None


class Segments(NamedTuple):
    """Segments of lines; ``ends`` (S, 2) int32 and ``cells`` (S,) int32."""

    ends: NDArray[np.int32]
    cells: NDArray[np.int32]


def without_strips(data: Any) -> Any:
    """Return a ``vtkPolyData`` whose strips are triangles."""
    if not data.GetNumberOfStrips():
        return data
    cut = vtkTriangleFilter()
    cut.SetInputData(data)
    cut.PassVertsOn()
    cut.PassLinesOn()
    cut.Update()
    return cut.GetOutput()


def triangles_of(data: Any, places: NDArray[np.float64]) -> Triangles:
    """Return the triangles of the polygons of a surface."""
    sizes, corners = _cells(data.GetPolys())
    first = data.GetNumberOfVerts() + data.GetNumberOfLines()
    if not len(sizes):
        return Triangles(np.zeros((0, 3), np.int32), np.zeros(0, np.int32), None)
    if sizes.min() == 4 == sizes.max():
        return _of_quads(corners.reshape(-1, 4), places, first)
    cut = triangulate(sizes, places, indices=corners)
    return Triangles(corners[cut.corners], cut.polygons + np.int32(first), cut.edge_visible)


def _of_quads(quads: NDArray[np.int32], places: NDArray[np.float64], first: int) -> Triangles:
    """Return the triangles of quadrilaterals, cut along their first diagonal."""
    corners = quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    cells = np.repeat(np.arange(first, first + len(quads), dtype=np.int32), 2)
    edges = np.tile(np.array([[True, True, False], [False, True, True]]), (len(quads), 1))
    return Triangles(corners, cells, edges)


def segments_of(data: Any) -> Segments:
    """Return the segments of the lines of a surface."""
    sizes, corners = _cells(data.GetLines())
    return _open(sizes, corners, data.GetNumberOfVerts())


def outlines_of(data: Any) -> Segments:
    """Return the segments round the polygons of a surface."""
    sizes, corners = _cells(data.GetPolys())
    first = data.GetNumberOfVerts() + data.GetNumberOfLines()
    if not len(sizes):
        return Segments(np.zeros((0, 2), np.int32), np.zeros(0, np.int32))
    following = np.arange(1, len(corners) + 1)
    ends = np.cumsum(sizes)
    following[ends - 1] = ends - sizes
    cells = np.repeat(np.arange(first, first + len(sizes), dtype=np.int32), sizes)
    return Segments(np.stack([corners, corners[following]], -1), cells)


def dots_of(data: Any) -> Segments:
    """Return the points that a surface shows as such; ``ends`` is (N,)."""
    sizes, points = _cells(data.GetVerts())
    return Segments(points, np.repeat(np.arange(len(sizes), dtype=np.int32), sizes))


def _open(sizes: NDArray[np.int32], corners: NDArray[np.int32], first: int) -> Segments:
    if not len(corners):
        return Segments(np.zeros((0, 2), np.int32), np.zeros(0, np.int32))
    begins = np.ones(len(corners), bool)
    begins[np.cumsum(sizes) - 1] = False
    starts = np.flatnonzero(begins)
    cells = np.repeat(np.arange(first, first + len(sizes), dtype=np.int32), sizes)[starts]
    return Segments(np.stack([corners[starts], corners[starts + 1]], axis=-1), cells)


def _cells(cells: Any) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the sizes and the corners of cells."""
    if not cells.GetNumberOfCells():
        return np.zeros(0, np.int32), np.zeros(0, np.int32)
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    corners = vtk_to_numpy(cells.GetConnectivityArray())
    return np.diff(offsets).astype(np.int32), corners.astype(np.int32)
