"""The faces of voxels and of other cubes that stand along the axes.

In: cells of a grid, or origins and sizes. Out: corners and triangles, counter-clockwise from
outside; a face between two voxels of a grid is left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

#: A cube's corners, (8, 3), its faces' corners, (6, 4), with the axis steps that these look along.
CORNERS = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], np.int64)
_FACES = np.array(
    [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)], np.int32
)
_STEPS = np.array([(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)], np.int64)
#: A cube's edges, (12, 2), as rows of its corners.
CUBE_EDGES = np.array(
    [
        *((0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3)),
        *((4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)),
    ],
    np.int32,
)


def outer_faces(
    cells: NDArray[np.int64],
) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.intp]]:
    """Return the faces of voxels that no neighbour covers.

    Parameters
    ----------
    cells : (N, 3) int
        Places in the grid, each once.

    Returns
    -------
    corners : (4 * Q, 3) int
        In units of voxels, four for each of Q faces.
    faces : (2 * Q, 3) int32
        Two triangles for each; the edge from the last to the first corner is the diagonal.
    owners : (4 * Q,) int
        The row of ``cells`` that each corner belongs to.
    """
    if not len(cells):
        return np.zeros((0, 3), np.int64), np.zeros((0, 3), np.int32), np.zeros(0, np.intp)
    low = cells.min(axis=0) - 1
    sides = cells.max(axis=0) - low + 2
    weights = np.array([1, sides[0], sides[0] * sides[1]], np.int64)
    numbers = ((cells - low) * weights).sum(axis=1)
    corners, owners = [], []
    for face, step in zip(_FACES, _STEPS, strict=True):
        bare = np.flatnonzero(~np.isin(numbers + (step * weights).sum(), numbers))
        corners.append((cells[bare, np.newaxis] + CORNERS[face]).reshape(-1, 3))
        owners.append(np.repeat(bare, 4))
    every = np.concatenate(corners)
    first = 4 * np.arange(len(every) // 4, dtype=np.int32)[:, np.newaxis, np.newaxis]
    # Each triangle's last edge is the quad's diagonal.
    faces = (first + np.array([(0, 1, 2), (2, 3, 0)], np.int32)).reshape(-1, 3)
    return every, faces, np.concatenate(owners)


def cube_faces(
    origins: NDArray[np.float64], sizes: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Return the corners, (8 * N, 3), and the triangles, (12 * N, 3), of N cubes."""
    corners = origins[:, np.newaxis] + CORNERS * sizes[:, np.newaxis, np.newaxis]
    quads = 8 * np.arange(len(origins), dtype=np.int32)[:, np.newaxis, np.newaxis] + _FACES
    triangles = quads[..., [0, 1, 2, 2, 3, 0]].reshape(-1, 3)
    return corners.reshape(-1, 3), triangles
