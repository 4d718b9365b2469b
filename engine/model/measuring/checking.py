"""Finds faults of surfaces: faces and edges that printing, cutting and simulating stumble over.

In: anything drawable. Out: `Faults`, which says which faces and where.
"""

from __future__ import annotations

from collections import deque
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.calls import hinted, shows_annotations
from .edges import Edges, edges_of
from .surfaces import Surface, surface_of

#: A face thinner than this fraction of its longest edge has no area to speak of.
_THIN = 1e-9


@shows_annotations
class Faults(NamedTuple):
    """The faults of a surface.

    Attributes
    ----------
    faces : int
        How many faces were checked.
    not_finite : int
        How many have corners with NaN or infinite coordinates; they are in no other list.
    degenerate : (N,) int64
        Faces without area; of several meshes, counted on from one to the next.
    duplicate : (N,) int64
        Faces with the same three corners as an earlier one.
    flipped : (N,) int64
        Faces that show another side than most of those that they hang together with.
    open_edges : (N, 2, 3) float64
        Ends of edges that only one face has, in world space.
    non_manifold_edges : (N, 2, 3) float64
        Ends of edges that more than two faces have.
    """

    faces: int
    not_finite: int
    degenerate: NDArray[np.int64]
    duplicate: NDArray[np.int64]
    flipped: NDArray[np.int64]
    open_edges: NDArray[np.float64]
    non_manifold_edges: NDArray[np.float64]

    @property
    def any(self) -> bool:
        """Whether there is a fault."""
        return self.not_finite > 0 or any(len(found) for found in self[2:])


@hinted
def check(thing: Any) -> Faults:
    """Find the faults of the surface of a mesh, of instances, of a node, or of a scene.

    Parameters
    ----------
    thing : Mesh, InstancedMesh, Node, Scene, or an iterable of these
        Of nodes what they show, at their current poses.

    Raises
    ------
    InvalidArgumentError

    Examples
    --------
    >>> engine3d.measuring.check(engine3d.box()).any
    False
    """
    surface = surface_of(thing)
    numbers = surface.numbers
    proper = proper_faces(surface.faces)
    degenerate = ~proper | _is_thin(surface)
    duplicate = _repeats(surface.faces)
    kept = np.flatnonzero(proper & ~duplicate)
    edges = edges_of(surface.faces[kept])
    return Faults(
        surface.given,
        surface.given - len(numbers),
        numbers[degenerate],
        numbers[duplicate & proper],
        numbers[kept[_flipped(edges, len(kept))]],
        surface.points[edges.ends[edges.counts == 1]],
        surface.points[edges.ends[edges.counts > 2]],
    )


def proper_faces(faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which faces (F, 3) have three different corners."""
    a, b, c = faces.T
    return (a != b) & (b != c) & (c != a)


@np.errstate(all="ignore")
def _is_thin(surface: Surface) -> NDArray[np.bool_]:
    a, b, c = (surface.corners[:, k] for k in range(3))
    longest = np.maximum(np.maximum(_square(b - a), _square(c - b)), _square(a - c))
    thin: NDArray[np.bool_] = linalg.length(linalg.cross(b - a, c - a)) <= _THIN * longest
    return thin


def _square(vectors: NDArray[np.float64]) -> Any:
    return linalg.dot(vectors, vectors)


def _repeats(faces: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which faces have the corners of an earlier one, in any order."""
    corners = np.sort(faces, axis=1)
    order = np.lexsort(corners.T)  # stable: the first one of equals stays first
    repeats = np.zeros(len(faces), bool)
    same = (corners[order][1:] == corners[order][:-1]).all(axis=1)
    repeats[order[1:][same]] = True
    return repeats


def _flipped(edges: Edges, count: int) -> NDArray[np.int64]:
    """Return the faces to turn so that neighbours show the same side, as few as possible."""
    if edges.opposed.all():
        return np.zeros(0, np.int64)
    neighbours: list[list[tuple[int, bool]]] = [[] for _ in range(count)]
    for (one, other), opposed in zip(edges.pairs.tolist(), edges.opposed.tolist(), strict=True):
        neighbours[one].append((other, opposed))
        neighbours[other].append((one, opposed))
    turned: list[bool | None] = [None] * count
    found: list[int] = []
    for start in range(count):
        if turned[start] is None:
            found += _minority(start, neighbours, turned)
    return np.array(sorted(found), np.int64)


def _minority(
    start: int, neighbours: list[list[tuple[int, bool]]], turned: list[bool | None]
) -> list[int]:
    """Go from face to face; return those that show the side that fewer of them show."""
    turned[start] = False
    sides: tuple[list[int], list[int]] = ([start], [])
    waiting = deque([start])
    while waiting:
        face = waiting.popleft()
        for other, opposed in neighbours[face]:
            if turned[other] is None:
                turned[other] = bool(turned[face]) == opposed
                sides[bool(turned[other])].append(other)
                waiting.append(other)
    return min(sides, key=len)
