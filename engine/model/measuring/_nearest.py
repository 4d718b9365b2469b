"""The distance of two triangles, many pairs at once.

In: corners (N, 3, 3) float64 of both. Out: the nearest points of each pair. Two triangles are
nearest at a corner of one and a point of the other, or at points of two edges, or they cross where
an edge of one goes through the other. Source: Ericson, "Real-Time Collision Detection", 2005, 5.1.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ..spatial.triangles import closest_points

_Floats = NDArray[np.float64]


class Pairs(NamedTuple):
    """Nearest points: their squared distances (N,), and the points of both sides, (N, 3)."""

    squares: _Floats
    on_a: _Floats
    on_b: _Floats

    def closer(self, other: Pairs) -> Pairs:
        """Return the nearer one of each of two pairs; where equal, this one."""
        nearer = other.squares < self.squares
        choose = nearer[:, np.newaxis]
        return Pairs(
            np.where(nearer, other.squares, self.squares),
            np.where(choose, other.on_a, self.on_a),
            np.where(choose, other.on_b, self.on_b),
        )

    @property
    def swapped(self) -> Pairs:
        return Pairs(self.squares, self.on_b, self.on_a)


def pairs_between(on_a: _Floats, on_b: _Floats) -> Pairs:
    """Return points as pairs with their squared distances."""
    way = on_b - on_a
    return Pairs(linalg.dot(way, way), on_a, on_b)


@np.errstate(all="ignore")
def nearest_of_triangles(a: _Floats, b: _Floats) -> Pairs:
    """Return the nearest points of pairs of triangles, which may be flat."""
    best = _from_corners(a, b).closer(_from_corners(b, a).swapped)
    best = best.closer(_through(a, b)).closer(_through(b, a))
    for i in range(3):
        for k in range(3):
            edge_a, edge_b = (a[:, i], a[:, (i + 1) % 3]), (b[:, k], b[:, (k + 1) % 3])
            best = best.closer(_of_segments(*edge_a, *edge_b))
    return best


def _from_corners(a: _Floats, b: _Floats) -> Pairs:
    first, *others = (pairs_between(a[:, k], closest_points(b, a[:, k])) for k in range(3))
    for pairs in others:
        first = first.closer(pairs)
    return first


def _through(a: _Floats, b: _Floats) -> Pairs:
    """Return where edges of triangles go through others; infinitely far where they do not."""
    normal = linalg.cross(b[:, 1] - b[:, 0], b[:, 2] - b[:, 0])
    heights = linalg.dot(a - b[:, :1], normal[:, np.newaxis])
    places, found = a[:, 0].copy(), np.zeros(len(a), bool)
    for k in range(3):
        low, high = heights[:, k], heights[:, (k + 1) % 3]
        share = low / np.where(low == high, 1.0, low - high)
        point = a[:, k] + (a[:, (k + 1) % 3] - a[:, k]) * share[:, np.newaxis]
        crosses = (low < 0.0) != (high < 0.0)
        for side in range(3):
            edge = b[:, (side + 1) % 3] - b[:, side]
            crosses &= linalg.dot(linalg.cross(edge, point - b[:, side]), normal) >= 0.0
        crosses &= linalg.dot(normal, normal) > 0.0
        places = np.where((crosses & ~found)[:, np.newaxis], point, places)
        found |= crosses
    return Pairs(np.where(found, 0.0, np.inf), places, places)


def _of_segments(p: _Floats, q: _Floats, r: _Floats, s: _Floats) -> Pairs:
    """Return the nearest points of segments from p to q and from r to s."""
    along, other, apart = q - p, s - r, p - r
    a, e = linalg.dot(along, along), linalg.dot(other, other)
    b, c, f = linalg.dot(along, other), linalg.dot(along, apart), linalg.dot(other, apart)
    scale = a * e - b * b
    t = np.clip((b * f - c * e) / np.where(scale > 0.0, scale, 1.0), 0.0, 1.0)
    t = np.where(scale > 0.0, t, 0.0)
    u = (b * t + f) / np.where(e > 0.0, e, 1.0)
    beyond = np.clip(u, 0.0, 1.0)
    again = np.clip((b * beyond - c) / np.where(a > 0.0, a, 1.0), 0.0, 1.0)
    t = np.where((u != beyond) | (e == 0.0), again, t)
    return pairs_between(p + along * t[:, np.newaxis], r + other * beyond[:, np.newaxis])
