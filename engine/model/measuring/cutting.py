"""Cuts meshes at a section plane: outlines of the cut, and their areas.

In: nodes, a plane across an axis. Out: for each node the directed segments in which the plane meets
its faces, and from them the pixels inside. Every edge that crosses the plane gives one point, found
from its lower end to its upper end whatever face asks, so that the outlines of closed meshes close
to the bit; those of open ones are closed by straight lines. Inside is where the winding number is
not zero.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from ...base import linalg
from ..geometry.mesh import Mesh
from ..scene.instances import InstancedMesh, instance_matrices
from ..scene.nodes import Node
from ..scene.shown import placing_pose, shown_object

#: With more instances, they are not cut individually.
MOST_INSTANCES = 4096
#: With more gaps, a node's outline is not closed.
MOST_GAPS = 1024
#: Gaps are closed if their total length is below this fraction of the gap-closed outline.
_LONGEST_GAPS = 0.75


class Plane(NamedTuple):
    """A plane across an axis of the scene, seen from one side.

    Attributes
    ----------
    axis : int
    coordinate : float
    from_above : bool
        Whether it is seen from where coordinates are greater.
    """

    axis: int
    coordinate: float
    from_above: bool


class Outline(NamedTuple):
    """The outline of a node's cut.

    Attributes
    ----------
    node : int
        Its id.
    segments : (N, 2, 3) ndarray of float64
        In the scene; what is inside is at the left of each as seen before the plane.
    """

    node: int
    segments: np.ndarray


def cut_nodes(nodes: Iterable[Node], plane: Plane) -> list[Outline]:
    """Return the outlines of all nodes that a plane cuts."""
    found = []
    for node in nodes:
        parts = [_cut(points, mesh.faces, plane) for points, mesh in _placed(node, plane)]
        parts = [part for part in parts if len(part)]
        if parts:
            found.append(Outline(node.id, np.concatenate(parts)))
    return found


def _placed(node: Node, plane: Plane) -> Iterator[tuple[np.ndarray, Mesh]]:
    """Yield the vertices of a node's drawn object, in the scene, for each instance."""
    box = node.bounds
    if not node.shown or box is None:
        return
    if not box[0][plane.axis] < plane.coordinate <= box[1][plane.axis]:
        return
    thing, pose = shown_object(node), placing_pose(node)
    if isinstance(thing, Mesh):
        yield linalg.transform_points(pose, thing.positions), thing
    elif isinstance(thing, InstancedMesh) and len(thing.poses) <= MOST_INSTANCES:
        for own in instance_matrices(thing.poses):
            product = linalg.multiply(pose, own)
            yield linalg.transform_points(product, thing.mesh.positions), thing.mesh


@np.errstate(all="ignore")
def _cut(points: np.ndarray, faces: np.ndarray, plane: Plane) -> np.ndarray:
    """Return the segments in which a plane intersects triangles, (N, 2, 3)."""
    heights = points[:, plane.axis] - plane.coordinate
    above = heights >= 0.0
    sides = above[faces]
    count = sides.sum(axis=1)
    crossing = np.flatnonzero((count == 1) | (count == 2))
    crossing = crossing[np.isfinite(points).all(axis=1)[faces[crossing]].all(axis=1)]
    if not len(crossing):
        return np.zeros((0, 2, 3))
    sides, corners = sides[crossing], faces[crossing]
    # The corner that is alone on its side comes first; the others follow in face order.
    alone_above = count[crossing] == 1
    first = np.argmax(sides == alone_above[:, np.newaxis], axis=1)
    turned = np.take_along_axis(corners, (first[:, np.newaxis] + np.arange(3)) % 3, axis=1)
    ends = [_crossings(points, heights, turned[:, 0], turned[:, k]) for k in (1, 2)]
    segments = np.stack(ends, axis=1)
    # Counter-clockwise faces with their corner above have the inside at the left of the way from
    # the second edge to the first, as seen from above.
    backward = alone_above == plane.from_above
    segments[backward] = segments[backward][:, ::-1]
    return segments


def _crossings(points: np.ndarray, heights: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return where edges cross the plane, computed from their lower to their upper end."""
    swapped = heights[a] >= 0.0
    low, high = np.where(swapped, b, a), np.where(swapped, a, b)
    share = heights[low] / (heights[low] - heights[high])
    return points[low] + (points[high] - points[low]) * share[:, np.newaxis]


def area_of(segments: np.ndarray, plane: Plane) -> float:
    """Return the area that closed outlines enclose, in square world units."""
    u, v = ((plane.axis + 1) % 3, (plane.axis + 2) % 3)
    base = segments[0, 0]
    a, b = segments[:, 0] - base, segments[:, 1] - base
    doubled = a[:, u] * b[:, v] - a[:, v] * b[:, u]
    # Exactly rounded: the order of the faces does not matter.
    return abs(math.fsum(doubled.tolist())) * 0.5


def gaps_of(segments: np.ndarray) -> np.ndarray | None:
    """Return the segments that close outlines, from open ends to open beginnings.

    Each end leads to the nearest beginning, of pairs that are nearest to each other first.

    Returns
    -------
    (K, 2, 3) ndarray of float64, or None
        None where there are too many gaps, or they are so long that there is no inside, as of a
        surface that is open all round.
    """
    points = segments.transpose(1, 0, 2).reshape(-1, 3) + 0.0  # the beginnings come first
    order = np.lexsort(points.T)
    steps = np.any(points[order][1:] != points[order][:-1], axis=1)
    numbers = np.empty(len(points), np.int64)
    numbers[order] = np.concatenate([[0], np.cumsum(steps)])
    begins = np.bincount(numbers[: len(segments)], minlength=len(points))
    ends = np.bincount(numbers[len(segments) :], minlength=len(points))
    places = np.zeros((len(points), 3))
    places[numbers] = points
    free_begins = np.repeat(places, np.maximum(begins - ends, 0), axis=0)
    free_ends = np.repeat(places, np.maximum(ends - begins, 0), axis=0)
    if len(free_ends) > MOST_GAPS:
        return None
    gaps = _joined(free_ends, free_begins)
    is_short = _length(gaps) <= _LONGEST_GAPS * _length(segments)
    return gaps if is_short else None


def _joined(ends: np.ndarray, begins: np.ndarray) -> np.ndarray:
    """Pair two equally large sets of points, (K, 2, 3)."""
    pairs = [np.zeros((0, 2, 3))]
    while len(ends):
        away = ends[:, np.newaxis] - begins[np.newaxis]
        squares = away[..., 0] * away[..., 0] + away[..., 1] * away[..., 1]
        squares += away[..., 2] * away[..., 2]
        to, back = squares.argmin(axis=1), squares.argmin(axis=0)
        mutual = np.flatnonzero(back[to] == np.arange(len(ends)))
        pairs.append(np.stack([ends[mutual], begins[to[mutual]]], axis=1))
        ends, begins = np.delete(ends, mutual, axis=0), np.delete(begins, to[mutual], axis=0)
    return np.concatenate(pairs)


def _length(segments: np.ndarray) -> float:
    return math.fsum(linalg.length(segments[:, 1] - segments[:, 0]).tolist())


def inside(ends: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return which pixels are inside closed outlines, (H, W) bool.

    Parameters
    ----------
    ends : (N, 2, 2) float64
        The segments' ends in pixels: x right, y down.
    width, height : int
    """
    turns = np.zeros((height, width + 1), np.int32)
    x, y = np.clip(ends, -1e9, 1e9)[..., 0], np.clip(ends, -1e9, 1e9)[..., 1]
    down = y[:, 1] > y[:, 0]
    top, bottom = np.where(down, y[:, 0], y[:, 1]), np.where(down, y[:, 1], y[:, 0])
    # The rows whose centres are in [top, bottom).
    begin = np.clip(np.ceil(top - 0.5), 0, height).astype(np.int64)
    end = np.clip(np.ceil(bottom - 0.5), 0, height).astype(np.int64)
    counts = end - begin
    number = np.repeat(np.arange(len(ends)), counts)
    rows = np.arange(len(number)) - np.repeat(np.cumsum(counts) - counts - begin, counts)
    run = (x[:, 1] - x[:, 0])[number]
    rise = (y[:, 1] - y[:, 0])[number]
    places = x[number, 0] + run * ((rows + 0.5 - y[number, 0]) / rise)
    columns = np.clip(np.ceil(places - 0.5), 0, width).astype(np.int64)
    np.add.at(turns, (rows, columns), np.where(down[number], 1, -1).astype(np.int32))
    return np.cumsum(turns, axis=1, dtype=np.int32)[:, :width] != 0
