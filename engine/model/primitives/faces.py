"""Index arithmetic shared by the primitives: grids of vertices, quads, triangles, edge masks.

In: numbers of rows and columns, or quads as vertex indices, counter-clockwise. Out: int32 faces
with their visible edges, entry k of which is the edge from corner k to the next, and numbers that
tell which vertices are one point, split for texture coordinates or normals.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

IntArray = npt.NDArray[np.int32]
BoolArray = npt.NDArray[np.bool_]


def grid_quads(rows: int, columns: int) -> IntArray:
    """Return the quads of a grid of vertices that is stored row by row.

    Parameters
    ----------
    rows, columns : int
        Numbers of quads; the grid has ``(rows + 1) * (columns + 1)`` vertices.

    Returns
    -------
    ndarray of int32, shape (rows * columns, 4)
        Lower left, lower right, upper right, upper left: counter-clockwise where columns run to
        the right and rows upwards.
    """
    index = np.arange((rows + 1) * (columns + 1), dtype=np.int32).reshape(rows + 1, columns + 1)
    corners = (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
    return np.stack(corners, axis=-1).reshape(-1, 4)


def split_quads(quads: IntArray) -> tuple[IntArray, BoolArray]:
    """Cut each quad along its first diagonal, and hide that diagonal.

    Parameters
    ----------
    quads : ndarray of int32, shape (N, 4)

    Returns
    -------
    faces : ndarray of int32, shape (2N, 3)
    edge_visible : ndarray of bool, shape (2N, 3)
    """
    faces = np.ascontiguousarray(quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3))
    edge_visible = np.tile([[True, True, False], [False, True, True]], (len(quads), 1))
    return faces, edge_visible


def grid_points(rows: int, columns: int, *, closed_rows: bool = False) -> IntArray:
    """Number the points of a grid whose last column lies on its first, row by row.

    Parameters
    ----------
    rows, columns : int
        Numbers of quads; the grid has ``(rows + 1) * (columns + 1)`` vertices.
    closed_rows : bool
        Whether the last row lies on the first, too.

    Returns
    -------
    ndarray of int32, shape ((rows + 1) * (columns + 1),)
        The same number for vertices at the same place, from 0 on.
    """
    row = np.arange(rows + 1) % (rows if closed_rows else rows + 1)
    column = np.arange(columns + 1) % columns
    return (row[:, np.newaxis] * columns + column).ravel().astype(np.int32)
