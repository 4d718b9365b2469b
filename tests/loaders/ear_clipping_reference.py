"""Triangles of one polygon that may be concave: ear clipping, in Python.

In: the corners of a polygon in the plane. Out: n - 2 triangles that cover it, wound like it.
Corners that lie upon each other are allowed (a hole joined to the outline by a bridge). Source: G.
H. Meisters, "Polygons have ears", 1975. Work is counted, and a polygon that would take more than
its share is cut as a fan, so that no file can hang the loader.
"""

from __future__ import annotations

import numpy as np

# Polygons of more corners than this are tested with NumPy, all corners at once.
_MANY_CORNERS = 96


class WorkBudget:
    """Tests of corners that may still be made, for all polygons of a file together.

    A million takes about a second.
    """

    def __init__(self, tests: int = 1_000_000) -> None:
        self.tests = tests

    @property
    def is_spent(self) -> bool:
        return self.tests <= 0


def clip_ears(points: list[tuple[float, float]], budget: WorkBudget) -> list[tuple[int, int, int]]:
    """Cut a polygon into triangles.

    Parameters
    ----------
    points : list of (x, y)
        Corners in order, at least three, either way round; all finite.
    budget : WorkBudget
        Reduced by the work done.

    Returns
    -------
    triangles : list of (int, int, int)
        Corner numbers, wound like the polygon; exactly ``len(points) - 2``.
    """
    if _twice_area(points) < 0:
        points = [(-x, y) for x, y in points]
    count = len(points)
    budget.tests -= 10 + 4 * count
    before = [count - 1, *range(count - 1)]
    after = [*range(1, count), 0]
    reflex = {i for i in range(count) if _turn(points, before[i], i, after[i]) <= 0}
    array = np.array(points) if count > _MANY_CORNERS else None
    triangles = []
    corner, left, failures, strict = 0, count, 0, True
    while left > 3:
        a, b, c = before[corner], corner, after[corner]
        budget.tests -= 1
        if budget.is_spent:
            return triangles + _fan(corner, after, left)
        is_ear = _turns_enough(points, a, b, c, strict) and not (
            _holds_corner(points, (a, b, c), reflex, budget, strict)
            if array is None or len(reflex) <= _MANY_CORNERS
            else _holds_corner_of_many(array, (a, b, c), reflex, budget, strict)
        )
        if not (is_ear or failures > 2 * left):
            failures += 1
            # No proper ear left: flat corners and points on an ear's border are accepted then.
            strict = failures <= left
            corner = c
            continue
        triangles.append((a, b, c))
        after[a], before[c] = c, a
        reflex.discard(b)
        for i in (a, c):
            if i in reflex and _turn(points, before[i], i, after[i]) > 0:
                reflex.discard(i)
        # Going on behind the next corner spreads the ears round instead of making one long fan.
        corner, left, failures, strict = after[c], left - 1, 0, True
    triangles.append((before[corner], corner, after[corner]))
    return triangles


def _turns_enough(points, a: int, b: int, c: int, strict: bool) -> bool:
    turn = _turn(points, a, b, c)
    return turn > 0 if strict else turn >= 0


def _holds_corner(points, triangle, reflex, budget, strict) -> bool:
    """Whether a reflex corner lies in the triangle, or (if strict) on its border."""
    a, b, c = corners = tuple(points[i] for i in triangle)
    budget.tests -= len(reflex)
    for i in reflex:
        point = points[i]
        if point in corners:
            continue
        ab, bc, ca = _side(a, b, point), _side(b, c, point), _side(c, a, point)
        if (ab >= 0 and bc >= 0 and ca >= 0) if strict else (ab > 0 and bc > 0 and ca > 0):
            return True
    return False


def _holds_corner_of_many(array, triangle, reflex, budget, strict) -> bool:
    """The same for many reflex corners at once."""
    budget.tests -= 100 + len(reflex) // 16
    points = array[np.fromiter(reflex, np.int64, len(reflex))].T
    a, b, c = (array[i] for i in triangle)
    sides = np.stack([_side(a, b, points), _side(b, c, points), _side(c, a, points)])
    inside = (sides >= 0).all(axis=0) if strict else (sides > 0).all(axis=0)
    for corner in (a, b, c):
        inside &= (points[0] != corner[0]) | (points[1] != corner[1])
    return bool(inside.any())


def _fan(corner: int, after: list[int], left: int) -> list[tuple[int, int, int]]:
    """The corners that are left, cut as a fan."""
    ring = [corner]
    for _ in range(left - 1):
        ring.append(after[ring[-1]])
    return [(ring[0], ring[k], ring[k + 1]) for k in range(1, left - 1)]


def _turn(points, a: int, b: int, c: int) -> float:
    """Twice the area of a triangle: positive if it turns left."""
    (ax, ay), (bx, by), (cx, cy) = points[a], points[b], points[c]
    return (bx - ax) * (cy - by) - (by - ay) * (cx - bx)


def _side(a, b, point):
    """Positive where a point lies to the left of the line from a to b."""
    return (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])


def _twice_area(points) -> float:
    ring = zip(points, points[1:] + points[:1], strict=True)
    return sum(ax * by - ay * bx for (ax, ay), (bx, by) in ring)
