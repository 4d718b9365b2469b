"""Bars and voxels as one collection of polygons each, made by array operations.

In: the arguments of `Axes3D.bar3d` and `Axes3D.voxels`. Out: what mplot3d makes, with the same
faces and colours, without its loops over voxels.
"""

from __future__ import annotations

import numpy as np
from matplotlib import colors as mcolors

#: The corners of a box's six faces, seen from outside against the clock: -z, +z, -y, +y, -x, +x.
_CUBOID = np.array(
    [
        [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)],
        [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
        [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)],
        [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)],
        [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)],
        [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)],
    ]
)
_SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])


def bar_polygons(low: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Return the faces of boxes, (6 N, 4, 3), of their corners and sizes, (N, 3)."""
    return (low[:, None, None] + size[:, None, None] * _CUBOID).reshape(-1, 4, 3)


def colors_at(colors, voxel: np.ndarray, shape: tuple[int, ...]) -> np.ndarray:
    """Return colours, (F, 4) float, of faces by their voxels.

    Parameters
    ----------
    colors : color or array
        One colour, or one for each voxel: names (3-D), or numbers (4-D).
    voxel : (F, 3) int
    """
    if np.ndim(colors) in (0, 1):
        return np.broadcast_to(mcolors.to_rgba_array(colors), (len(voxel), 4))
    if np.shape(colors)[:3] != shape:
        raise ValueError("When multidimensional, colors must match the shape of filled")
    chosen = np.asarray(colors)[tuple(voxel.T)]
    if chosen.ndim == 1:
        names, which = np.unique(chosen.astype(str), return_inverse=True)
        return mcolors.to_rgba_array(list(names))[which] if len(names) else np.empty((0, 4))
    return mcolors.to_rgba_array(chosen)


def voxel_faces(filled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the faces between voxels and empty space.

    Returns
    -------
    voxel : (F, 3) int
        The voxel that a face belongs to: voxel by voxel, in `voxels`' order.
    corners : (F, 4, 3) int
        Corners as indices of the grid.
    """
    voxels, corners, ranks = [], [], []
    turn = np.eye(3, dtype=np.intp)
    for direction in range(3):
        square = _SQUARE @ turn.T
        axis = int(np.argmax(turn[:, 2]))
        step = turn[:, 2]
        padded = np.pad(filled, [(1, 1) if k == axis else (0, 0) for k in range(3)])
        lower, upper = (
            padded.take(range(padded.shape[axis] - 1), axis),
            padded.take(range(1, padded.shape[axis]), axis),
        )
        for sign, edge in ((1, lower & ~upper), (-1, upper & ~lower)):
            at = np.argwhere(edge)
            voxels.append(at - step if sign > 0 else at)
            corners.append(at[:, None] + square[::sign])
            # Of a voxel, faces follow each other by direction, then from low to high.
            ranks.append(np.full(len(at), 2 * direction + (sign > 0)))
        turn = np.roll(turn, 1, 0)
    voxel, rank = np.concatenate(voxels), np.concatenate(ranks)
    order = np.lexsort((rank, voxel[:, 2], voxel[:, 1], voxel[:, 0]))
    return voxel[order], np.concatenate(corners)[order]


class Voxels(dict):
    """What `voxels` returns: for each voxel that shows, by its index, its polygons.

    All voxels are one collection of the axes until a program takes one out of here: then each is a
    collection of its own, as with mplot3d, to be coloured or removed by itself.
    """

    def __init__(self, axes, collection, voxel: np.ndarray, spread) -> None:
        differs = (np.diff(voxel, axis=0) != 0).any(1)
        starts = np.flatnonzero(np.append(len(voxel) > 0, differs))
        ends = np.append(starts[1:], len(voxel))[: len(starts)]
        super().__init__(
            {tuple(map(int, voxel[a])): (int(a), int(b)) for a, b in zip(starts, ends, strict=True)}
        )
        self._axes, self._collection, self._spread = axes, collection, spread

    def _split(self) -> None:
        if self._collection is None:
            return
        axes, whole = self._axes, self._collection
        self._collection = None
        for key, (first, last) in list(super().items()):
            one = self._spread(first, last)
            axes.add_collection3d(one, autolim=False)
            super().__setitem__(key, one)
        whole.remove()

    def __getitem__(self, key):
        self._split()
        return super().__getitem__(key)

    def get(self, key, default=None):
        self._split()
        return super().get(key, default)

    def values(self):
        self._split()
        return super().values()

    def items(self):
        self._split()
        return super().items()

    def pop(self, *args):
        self._split()
        return super().pop(*args)

    def copy(self):
        self._split()
        return dict(self)

    def popitem(self):
        self._split()
        return super().popitem()

    def __reduce__(self):
        self._split()
        return dict, (dict(super().items()),)
