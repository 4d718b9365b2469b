"""Index arithmetic shared by the primitives: grids of vertices, quads, triangles, edge masks.

In: numbers of rows and columns, or quads as vertex indices, counter-clockwise. Out: int32 faces
with their visible edges, entry k of which is the edge from corner k to the next.
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
