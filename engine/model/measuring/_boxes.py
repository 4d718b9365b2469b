"""A balanced tree of boxes around triangles, as arrays, a level after the other.

In: corners of triangles (N, 3, 3). Out: a `BoxTree`. The boxes of a level are halves of those
before it, so box k has the boxes 2k and 2k + 1; each leaf has the same number of triangles, of
which the last ones may occur more than once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg

#: Triangles of a leaf.
LEAF = 4


class BoxTree(NamedTuple):
    """Boxes around triangles.

    Attributes
    ----------
    corners : (N, 3, 3) ndarray of float64
        Of all triangles, as given.
    order : (L, LEAF) ndarray of int64
        The triangles of the leaves.
    low, high : list of (2**level, 3) ndarray of float64
        The corners of boxes, level by level.
    """

    corners: NDArray[np.float64]
    order: NDArray[np.int64]
    low: list[NDArray[np.float64]]
    high: list[NDArray[np.float64]]

    @property
    def depth(self) -> int:
        """The level of the leaves."""
        return len(self.low) - 1

    def samples(self, level: int, boxes: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return a point of a triangle in each box, (B, 3)."""
        leaf = boxes << (self.depth - level)
        corners: NDArray[np.float64] = self.corners[self.order[leaf, 0], 0]
        return corners


def box_tree(corners: NDArray[np.float64]) -> BoxTree:
    """Return the tree of triangles, of which there is at least one."""
    depth = max(-(-len(corners) // LEAF) - 1, 0).bit_length()
    middles = corners.sum(axis=1)
    order = np.minimum(np.arange(LEAF << depth), len(corners) - 1)[np.newaxis]
    for _ in range(depth):
        places = middles[order]
        axes = np.ptp(places, axis=1).argmax(axis=1)
        keys = np.take_along_axis(places, axes[:, np.newaxis, np.newaxis], axis=2)[..., 0]
        sorted_by = np.argsort(keys, axis=1, kind="stable")
        order = np.take_along_axis(order, sorted_by, axis=1).reshape(2 * len(order), -1)
    low, high = [corners.min(axis=1)[order].min(axis=1)], [corners.max(axis=1)[order].max(axis=1)]
    for _ in range(depth):
        low.insert(0, low[0].reshape(-1, 2, 3).min(axis=1))
        high.insert(0, high[0].reshape(-1, 2, 3).max(axis=1))
    return BoxTree(corners, order, low, high)


def square_gaps(
    low_a: NDArray[np.float64],
    high_a: NDArray[np.float64],
    low_b: NDArray[np.float64],
    high_b: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return the squared distances of boxes, (N,); 0 where they meet."""
    gaps = np.maximum(np.maximum(low_b - high_a, low_a - high_b), 0.0)
    squares: NDArray[np.float64] = linalg.dot(gaps, gaps)
    return squares
