"""Which meshes surely show their fronts only: those that enclose a volume, seen from outside.

In: meshes, planes, boxes of nodes. Out: whether back faces may be left out without a change of the
picture. Holes that one does not look into do not matter, such as those under a bust. A mesh with
alpha shows its inside through itself, and one that is bent may turn its inside out: of these, both
sides count.
"""

from __future__ import annotations

import operator
from weakref import WeakKeyDictionary

import numpy as np

from .. import linalg
from .._native import loaders as native
from ..geometry.mesh import Mesh
from ._view import View

_READ = ("positions", "faces", "joints", "morph_positions")
# Points that are nearer to a plane than this share of their coordinates are not surely before it.
_LEAST = 1e-6
_MOST_SIDES = 4096  # of holes: what has more is no volume with a few holes
_MOST_CORNERS = 96  # of a rim whose sides are compared with each other
_known: WeakKeyDictionary[Mesh, tuple[list, tuple[np.ndarray, ...] | None]] = WeakKeyDictionary()
_spheres: WeakKeyDictionary[Mesh, tuple[np.ndarray, np.ndarray, float]] = WeakKeyDictionary()


def holes_of(mesh: Mesh) -> tuple[np.ndarray, ...] | None:
    """Return the holes of a mesh that encloses a volume but for them, its fronts outside.

    A ray from outside goes into such a volume before it comes out: unless it goes in through a
    hole, it meets a front first.

    Returns
    -------
    rims : tuple of (N, 3) float64, or None
        The points round each hole, in the way in which the triangles run there. None if there is no
        such volume. Found once for the mesh's arrays.
    """
    if any(material.alpha_mode != "opaque" for material in mesh.materials):
        return None
    arrays = dict(mesh._arrays)
    read = [arrays[name] for name in _READ]
    made_of, rims = _known.get(mesh, ([None], None))
    if not all(map(operator.is_, read, made_of)):
        rims = None
        if arrays["joints"] is None and arrays["morph_positions"] is None:
            rims = _holes(arrays["positions"], arrays["faces"])
        _known[mesh] = read, rims
    return rims


def _holes(positions: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, ...] | None:
    places, first = native.number_rows(positions.view(np.uint32), True)
    sides = native.open_sides(positions, faces, places, len(first), _MOST_SIDES)
    if sides is None or not _are_rings(sides):
        return None
    points, faces = positions[first], places[faces]
    rims = _rims(sides)
    for rim in rims:  # a lid: a fan of triangles from the middle
        middle = points[rim].mean(axis=0, keepdims=True)
        lid = np.stack([np.roll(rim, -1), rim, np.full_like(rim, len(points))], axis=1)
        points, faces = np.concatenate([points, middle]), np.concatenate([faces, lid])
    if not native.encloses(points, faces, None, len(points)):
        return None
    return tuple(points[rim].astype(np.float64) for rim in rims)


def _are_rings(sides: np.ndarray) -> bool:
    """Whether at each place one open side ends and one begins."""
    begins, ends = np.sort(sides, axis=0).T
    return bool((begins == ends).all() and (begins[1:] != begins[:-1]).all())


def _rims(sides: np.ndarray) -> list[np.ndarray]:
    """Open sides (N, 2), which form rings, as the rings of their places."""
    after = dict(sides.tolist())
    rims = []
    while after:
        rim = [next(iter(after))]
        while (place := after.pop(rim[-1], None)) not in (None, rim[0]):
            rim.append(place)
        rims.append(np.array(rim, np.int32))
    return rims


def hole_looked_into(rims: tuple[np.ndarray, ...], view: View, world: np.ndarray) -> int | None:
    """The first hole that one may look into, of a mesh that is before the near plane.

    One does not where the rim, as the picture shows it, runs round the hole as round a front, and
    does not cross itself: what closes the hole faces away.

    Parameters
    ----------
    rims : tuple of (N, 3) float64
        Of `holes_of`.
    view : View
    world : (4, 4) float64
        world-from-mesh.
    """
    if not rims:
        return None
    matrix = linalg.multiply(view.clip_from_world, world)
    turns = linalg.multiply(view.view_from_world, world)[:3, :3]
    is_mirrored = float(linalg.dot(turns[0], linalg.cross(turns[1], turns[2]))) < 0.0
    for number, rim in enumerate(rims):
        x, y, w = (linalg.dot(rim, row[:3]) + row[3] for row in matrix[[0, 1, 3]])
        if not (w > 0.0).all():
            return number
        x, y = (-x if is_mirrored else x) / w, y / w
        if not _runs_round(x, y):
            return number
    return None


def _runs_round(x: np.ndarray, y: np.ndarray) -> bool:
    """Whether a ring of points runs counter-clockwise and does not cross itself."""
    x, y = x - x.mean(), y - y.mean()
    x1, y1 = np.roll(x, -1), np.roll(y, -1)
    areas = x * y1 - x1 * y
    least = _LEAST * float(np.abs(areas).max())
    if (areas > least).all():
        return True  # as seen from its middle
    return areas.sum() > least and len(x) <= _MOST_CORNERS and not _crosses(x, y, x1, y1, least)


def _crosses(x, y, x1, y1, least: float) -> bool:
    """Whether two sides of a ring that are not neighbours may meet."""
    dx, dy = x1 - x, y1 - y
    # On which side of each side both ends of each other one are: (side, other).
    begin = dx[:, np.newaxis] * (y - y[:, np.newaxis]) - dy[:, np.newaxis] * (x - x[:, np.newaxis])
    end = np.roll(begin, -1, axis=1)
    apart = (np.minimum(begin, end) > least) | (np.maximum(begin, end) < -least)
    steps = np.subtract.outer(np.arange(len(x)), np.arange(len(x))) % len(x)
    neighbours = (steps <= 1) | (steps == len(x) - 1)
    return not (apart | apart.T | neighbours).all()


def all_in_front(plane: np.ndarray, boxes: np.ndarray) -> np.ndarray:
    """Which of some boxes lie in front of a plane, (N,) bool.

    Parameters
    ----------
    plane : (4,) float64
        In front is where ``plane[:3] . point + plane[3]`` is positive.
    boxes : (N, 6 or more) float64
        Lowest and highest corners; those of nothing have the lowest above and count as in front.
    """
    low, high = boxes[:, :3], boxes[:, 3:6]
    nearest = np.where(plane[:3] > 0.0, low, high)
    in_front = linalg.dot(nearest, plane[:3]) + plane[3] > _LEAST * _sizes(plane, nearest)
    return in_front | (low > high).any(axis=1)


def plane_in_node(plane: np.ndarray, world: np.ndarray) -> np.ndarray:
    """Return a plane of the world in the space of a node, whose pose there is (4, 4)."""
    normal = linalg.dot(world[:3, :3].T, plane[:3])
    return np.append(normal, linalg.dot(world[:3, 3], plane[:3]) + plane[3])


def is_in_front(plane: np.ndarray, mesh: Mesh) -> bool:
    """Whether all vertices of a mesh lie in front of a plane in its space."""
    positions = mesh.positions
    low, high = mesh.bounds
    if all_in_front(plane, np.concatenate([low, high])[np.newaxis])[0]:
        return True
    center, radius = _sphere(mesh)
    middle = float(linalg.dot(center, plane[:3])) + float(plane[3])
    if middle > radius * float(linalg.length(plane[:3])) * (1.0 + _LEAST):
        return True
    rises = linalg.dot(positions, plane[:3]) + plane[3]
    return bool((rises > _LEAST * _sizes(plane, positions)).all())


def _sizes(plane: np.ndarray, points: np.ndarray) -> np.ndarray:
    """How large the sums are whose rounding must not decide."""
    return linalg.dot(np.abs(points), np.abs(plane[:3])) + abs(plane[3])


def _sphere(mesh: Mesh) -> tuple[np.ndarray, float]:
    """The middle of a mesh, and how far it reaches from there; found once for its positions."""
    positions = mesh.positions
    made_of, center, radius = _spheres.get(mesh, (None, None, 0.0))
    if made_of is not positions:
        center = (mesh.bounds[0] + mesh.bounds[1]) * 0.5
        offsets = positions - center
        radius = float(np.sqrt(linalg.dot(offsets, offsets).max(initial=0.0)))
        _spheres[mesh] = positions, center, radius
    return center, radius
