"""Which meshes surely show their fronts only: those that enclose a volume, seen from outside.

In: meshes, planes, boxes of nodes. Out: whether back faces may be left out without a change of the
picture. A mesh with alpha shows its inside through itself, and one that is bent may turn its inside
out: of these, both sides count.
"""

from __future__ import annotations

import operator
from weakref import WeakKeyDictionary

import numpy as np

from .. import linalg
from .._native import loaders as native
from ..geometry.mesh import Mesh

_READ = ("positions", "faces", "joints", "morph_positions")
# Points that are nearer to a plane than this share of their coordinates are not surely before it.
_LEAST = 1e-6
_known: WeakKeyDictionary[Mesh, tuple[list, bool]] = WeakKeyDictionary()
_spheres: WeakKeyDictionary[Mesh, tuple[np.ndarray, np.ndarray, float]] = WeakKeyDictionary()


def encloses(mesh: Mesh) -> bool:
    """Whether the faces of a mesh enclose a volume and face outward; found once for its arrays."""
    if any(material.alpha_mode != "opaque" for material in mesh.materials):
        return False
    arrays = dict(mesh._arrays)
    read = [arrays[name] for name in _READ]
    made_of, found = _known.get(mesh, ([None], False))
    if not all(map(operator.is_, read, made_of)):
        found = arrays["joints"] is None and arrays["morph_positions"] is None
        found = found and _faces_outward(arrays["positions"], arrays["faces"])
        _known[mesh] = read, found
    return found


def _faces_outward(positions: np.ndarray, faces: np.ndarray) -> bool:
    places, first = native.number_rows(positions.view(np.uint32), True)
    return native.encloses(positions, faces, places, len(first))


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
