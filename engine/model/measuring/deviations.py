"""The Hausdorff distance: how far two surfaces deviate from each other at most.

In: two drawable things. Out: a `Deviation` with a lower and an upper bound. The distance from a
surface is convex above each of its triangles, so within a triangle of the other surface it is no
larger than at the corners, measured from any one triangle; where that leaves too much open, the
triangle is cut into four. Source of the bound: Guthe, Borodin and Klein, "Fast and accurate
Hausdorff distance calculation between meshes", 2005.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.calls import hinted, shows_annotations
from ...base.validation import positive
from ..spatial.triangles import closest_points
from ._boxes import BoxTree, box_tree, square_gaps
from .distances import surface_with_faces
from .surfaces import Surface

#: Points for which the nearest triangle is sought at once.
_AT_ONCE = 4096
#: When more triangles than this have been cut, the bounds stay as far apart as they are.
_MOST_CUTS = 200_000
#: Points that are tried first: what is found there ends the search in most other places.
_FIRST = 1024

_Floats = NDArray[np.float64]


@shows_annotations
class Deviation(NamedTuple):
    """How far two surfaces deviate from each other.

    Attributes
    ----------
    distance : float
        The largest distance that was found, in world units.
    at_most : float
        The largest that is possible; no more above than the tolerance, unless surfaces are huge.
    from_a, from_b : float
        Those found from points of one surface to the other surface.
    point, nearest : (3,) float64
        Where the largest was found, and the nearest point of the other surface; in world space.
    """

    distance: float
    at_most: float
    from_a: float
    from_b: float
    point: _Floats
    nearest: _Floats


class _Found(NamedTuple):
    """The nearest triangles of points: numbers, distances, and the points of theirs."""

    faces: NDArray[np.int64]
    distances: _Floats
    places: _Floats


@hinted
def hausdorff(a: Any, b: Any, *, tolerance: float = 1e-3) -> Deviation:
    """Find how far two surfaces deviate from each other: the Hausdorff distance.

    Every point of each surface is at least this near to the other one. It is measured from the
    whole faces, not only from vertices.

    Parameters
    ----------
    a, b : Mesh, InstancedMesh, Node, Scene, or an iterable of these
        Of nodes what they show, at their current poses. Lines and points are left out.
    tolerance : float
        How far the bounds may be apart, in diagonals of the box around both.

    Raises
    ------
    InvalidArgumentError
        One of them has no face.

    Examples
    --------
    >>> deviation = engine3d.measuring.hausdorff(engine3d.box(), engine3d.box((1, 1, 2)))
    >>> deviation.distance
    0.5
    """
    first, second = surface_with_faces(a, "a"), surface_with_faces(b, "b")
    boxes = np.concatenate([first.box, second.box])
    diagonal = float(linalg.length(boxes.max(axis=0) - boxes.min(axis=0)))
    slack = positive(tolerance, "tolerance") * diagonal
    trees = box_tree(first.corners), box_tree(second.corners)
    one, most_one = _one_sided(first, trees[1], slack, 0.0)
    other, most_other = _one_sided(second, trees[0], slack, float(one[0]))
    farther = max((one, other), key=lambda found: found[0])
    most = max(most_one, most_other, farther[0])
    return Deviation(farther[0], most, one[0], other[0], farther[1], farther[2])


@np.errstate(all="ignore")
def _one_sided(
    surface: Surface, tree: BoxTree, slack: float, known: float
) -> tuple[tuple[float, _Floats, _Floats], float]:
    """Return the largest distance from a surface with its points, and an upper bound.

    ``known`` is a distance that is found already: what cannot exceed it need not be exact.
    """
    corners, most, cuts = surface.corners, 0.0, 0
    some = surface.points[:: max(len(surface.points) // _FIRST, 1)]
    best = _farther((-1.0, some[0], some[0]), some, _nearest_faces(some, tree))
    while len(corners):
        enough = max(best[0], known) + slack
        middles = corners.sum(axis=1) / 3.0
        # Triangles near the middle are cheap to find, and mostly good enough.
        bounds = _bounds(corners, _descended(middles, tree), tree)
        for points in (middles[:, np.newaxis], corners):
            rows = np.flatnonzero(bounds > enough)
            tried = points[rows].reshape(-1, 3)
            found = _nearest_faces(tried, tree)
            best = _farther(best, tried, found)
            faces = found.faces.reshape(-1, points.shape[1])
            bounds[rows] = np.minimum(bounds[rows], _bounds(corners[rows], faces, tree))
            enough = max(best[0], known) + slack
        if cuts > _MOST_CUTS:
            return best, max(most, float(bounds.max()))
        most = max(most, float(bounds[bounds <= enough].max(initial=0.0)))
        corners = _quartered(corners[bounds > enough])
        cuts += len(corners)
    return best, most


def _quartered(corners: _Floats) -> _Floats:
    """Return triangles cut at the middles of their edges."""
    halves = (corners + np.roll(corners, -1, axis=1)) * 0.5
    quarters = [np.stack([corners[:, k], halves[:, k], halves[:, k - 1]], 1) for k in range(3)]
    return np.concatenate([*quarters, halves])


def _bounds(corners: _Floats, faces: NDArray[np.int64], tree: BoxTree) -> _Floats:
    """Return upper bounds of the distances of triangles' points, (N,), by faces (N, K) of another.

    The distance from a triangle is convex, so it is largest at corners.
    """
    bounds = np.full(len(corners), math.inf)
    for column in faces.T:
        target = tree.corners[column]
        away = [
            linalg.length(closest_points(target, corners[:, k]) - corners[:, k]) for k in range(3)
        ]
        bounds = np.minimum(bounds, np.stack(away).max(axis=0))
    return bounds


def _farther(best: tuple[float, _Floats, _Floats], points: _Floats, found: _Found) -> Any:
    if not len(points):
        return best
    row = int(found.distances.argmax())
    if not found.distances[row] > best[0]:
        return best
    return float(found.distances[row]), points[row], found.places[row]


def _nearest_faces(points: _Floats, tree: BoxTree) -> _Found:
    """Return the nearest triangles of points (N, 3)."""
    parts = [
        _some_nearest(points[start : start + _AT_ONCE], tree)
        for start in range(0, len(points), _AT_ONCE)
    ]
    empty = _Found(np.zeros(0, np.int64), np.zeros(0), np.zeros((0, 3)))
    return _Found(*map(np.concatenate, zip(empty, *parts, strict=True)))


def _some_nearest(points: _Floats, tree: BoxTree) -> _Found:
    guess = _nearest_in(points, np.arange(len(points)), _descended(points, tree), tree)
    most = guess.distances * guess.distances * (1.0 + 1e-12)
    which = np.arange(len(points))
    boxes = np.zeros(len(points), np.int64)
    for level in range(tree.depth + 1):
        if level:
            which, boxes = np.repeat(which, 2), np.repeat(boxes * 2, 2)
            boxes[1::2] += 1
        away = tree.samples(level, boxes) - points[which]
        np.minimum.at(most, which, linalg.dot(away, away) * (1.0 + 1e-12))
        near = _gaps(points[which], tree, level, boxes) <= most[which]
        which, boxes = which[near], boxes[near]
    faces = tree.order[boxes].ravel()
    which = np.repeat(which, tree.order.shape[1])
    targets, of_which = tree.corners[faces], points[which]
    gaps = square_gaps(of_which, of_which, targets.min(axis=1), targets.max(axis=1))
    near = gaps <= most[which]
    return _nearest_in(points, which[near], faces[near, np.newaxis], tree)


def _descended(points: _Floats, tree: BoxTree) -> NDArray[np.int64]:
    """Return the triangles of a leaf near each point, found by taking the nearer box each time."""
    boxes = np.zeros(len(points), np.int64)
    for level in range(1, tree.depth + 1):
        gaps, steps = zip(*(_ways(points, tree, level, 2 * boxes + k) for k in (0, 1)), strict=True)
        second = (gaps[1] < gaps[0]) | ((gaps[1] == gaps[0]) & (steps[1] < steps[0]))
        boxes = 2 * boxes + second
    return tree.order[boxes]


def _ways(
    points: _Floats, tree: BoxTree, level: int, boxes: NDArray[np.int64]
) -> tuple[_Floats, _Floats]:
    """Return the squared distances of points from boxes, and from the middles of boxes."""
    low, high = tree.low[level][boxes], tree.high[level][boxes]
    away = points - (low + high) * 0.5
    return square_gaps(points, points, low, high), linalg.dot(away, away)


def _gaps(points: _Floats, tree: BoxTree, level: int, boxes: NDArray[np.int64]) -> _Floats:
    return square_gaps(points, points, tree.low[level][boxes], tree.high[level][boxes])


def _nearest_in(points: _Floats, which: Any, faces: Any, tree: BoxTree) -> _Found:
    """Return the nearest of the triangles (M, K) that are given for some points, M numbers."""
    which, faces = np.repeat(which, faces.shape[1]), faces.ravel()
    places = closest_points(tree.corners[faces], points[which])
    away = places - points[which]
    squares = linalg.dot(away, away)
    order = np.lexsort((faces, squares, which))
    first = order[np.flatnonzero(np.diff(which[order], prepend=-1))]
    return _Found(faces[first], np.sqrt(squares[first]), places[first])
