"""The distance between two things: how far apart their surfaces are, where, and whether they meet.

In: two drawable things. Out: a `Gap`. Two trees of boxes are gone through together, nearest pairs
first; triangles are compared exactly.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.calls import hinted, shows_annotations
from ...errors import InvalidArgumentError
from ._boxes import BoxTree, box_tree, square_gaps
from ._nearest import Pairs, nearest_of_triangles, pairs_between
from .checking import proper_faces
from .edges import edges_of
from .surfaces import Surface, surface_of

#: Surfaces touch that are nearer than this fraction of their reach: positions are float32.
_TOUCHING = 1e-7
#: Pairs of boxes that are compared at once.
_MANY = 8192


@shows_annotations
class Gap(NamedTuple):
    """The distance between two surfaces.

    Attributes
    ----------
    distance : float
        Between their nearest points, in world units; 0 where they cross.
    point_a, point_b : (3,) float64
        These points, in world space.
    touching : bool
        Whether they touch or cross, within the precision of positions.
    inside : bool
        Whether one lies within the other, which is watertight, without touching it.
    """

    distance: float
    point_a: NDArray[np.float64]
    point_b: NDArray[np.float64]
    touching: bool
    inside: bool


@hinted
def distance(a: Any, b: Any) -> Gap:
    """Find the nearest points of two surfaces.

    Parameters
    ----------
    a, b : Mesh, InstancedMesh, Node, Scene, or an iterable of these
        Of nodes what they show, at their current poses. Lines and points are left out.

    Raises
    ------
    InvalidArgumentError
        One of them has no face.

    Examples
    --------
    >>> scene = engine3d.Scene()
    >>> left = scene.add(engine3d.box())
    >>> right = scene.add(engine3d.box(), translation=(3, 0, 0))
    >>> engine3d.measuring.distance(left, right).distance
    2.0
    """
    first, second = surface_with_faces(a, "a"), surface_with_faces(b, "b")
    gap, on_a, on_b = _nearest(box_tree(first.corners), box_tree(second.corners))
    reach = max(float(np.abs(surface.box).max()) for surface in (first, second))
    touching = gap <= _TOUCHING * reach
    inside = not touching and (_contains(first, on_b) or _contains(second, on_a))
    return Gap(gap, on_a, on_b, touching, inside)


def surface_with_faces(thing: Any, what: str) -> Surface:
    """Return the surface of a thing, or raise an error if it has no faces."""
    surface = surface_of(thing, what)
    if not len(surface.faces):
        raise InvalidArgumentError(f"{what} has no faces, so it has no distance")
    return surface


@np.errstate(all="ignore")
def _nearest(a: BoxTree, b: BoxTree) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
    """Return the distance of two surfaces and their nearest points."""
    top = np.zeros(1, np.int64)
    best = pairs_between(a.samples(0, top), b.samples(0, top))
    waiting = [(0, 0, top, top)]
    while waiting:  # the nearest pairs are last
        level_a, level_b, of_a, of_b = waiting.pop()
        near = _gaps(a, b, level_a, level_b, of_a, of_b) < best.squares[0]
        of_a, of_b = of_a[near], of_b[near]
        if not len(of_a):
            continue
        if level_a == a.depth and level_b == b.depth:
            best = _nearer(best, _of_leaves(a, b, of_a, of_b, float(best.squares[0])))
            continue
        for which, (tree, level) in enumerate(((a, level_a), (b, level_b))):
            if level < tree.depth:
                pair = [np.repeat(of_a, 2), np.repeat(of_b, 2)]
                pair[which] = pair[which] * 2 + np.tile((0, 1), len(of_a))
                of_a, of_b = pair
        level_a, level_b = min(level_a + 1, a.depth), min(level_b + 1, b.depth)
        samples = pairs_between(a.samples(level_a, of_a), b.samples(level_b, of_b))
        best = _nearer(best, samples)
        order = np.argsort(-_gaps(a, b, level_a, level_b, of_a, of_b), kind="stable")
        for start in range(0, len(order), _MANY):
            some = order[start : start + _MANY]
            waiting.append((level_a, level_b, of_a[some], of_b[some]))
    return math.sqrt(best.squares[0]), best.on_a[0], best.on_b[0]


def _gaps(a: BoxTree, b: BoxTree, level_a: int, level_b: int, of_a: Any, of_b: Any) -> Any:
    boxes_a = a.low[level_a][of_a], a.high[level_a][of_a]
    return square_gaps(*boxes_a, b.low[level_b][of_b], b.high[level_b][of_b])


def _of_leaves(a: BoxTree, b: BoxTree, of_a: Any, of_b: Any, most: float) -> Pairs:
    """Return the nearest points of the triangles in pairs of leaves that may be near enough."""
    leaf = a.order.shape[1]
    faces_a = np.repeat(a.order[of_a], leaf, axis=1).ravel()
    faces_b = np.tile(b.order[of_b], (1, leaf)).ravel()
    first, second = a.corners[faces_a], b.corners[faces_b]
    gaps = square_gaps(first.min(axis=1), first.max(axis=1), second.min(axis=1), second.max(axis=1))
    near = gaps < most
    return nearest_of_triangles(first[near], second[near])


def _nearer(best: Pairs, others: Pairs) -> Pairs:
    if not len(others.squares):
        return best
    row = slice(least := int(others.squares.argmin()), least + 1)
    return best.closer(Pairs(*(values[row] for values in others)))


@np.errstate(all="ignore")
def _contains(surface: Surface, point: NDArray[np.float64]) -> bool:
    """Return whether a point that is not on a surface lies within it.

    The solid angles of all faces add up to a full one then. Source: van Oosterom and Strackee, "The
    solid angle of a plane triangle", 1983.
    """
    faces = surface.faces[proper_faces(surface.faces)]
    if not edges_of(faces).are_closed:
        return False
    a, b, c = (surface.points[faces[:, k]] - point for k in range(3))
    lengths = [linalg.length(side) for side in (a, b, c)]
    below = lengths[0] * lengths[1] * lengths[2]
    for (one, two), length in zip(((a, b), (a, c), (b, c)), reversed(lengths), strict=True):
        below = below + linalg.dot(one, two) * length
    angles = 2.0 * np.arctan2(linalg.dot(a, linalg.cross(b, c)), below)
    return abs(math.fsum(angles.tolist())) > 2.0 * math.pi
