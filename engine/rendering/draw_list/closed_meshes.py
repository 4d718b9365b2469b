"""Finds closed meshes: they enclose a volume, fronts outside, so their backs are hidden.

In: meshes. Out: the holes through which backs can be seen, if there are only these;
csrc/scene/apertures.c finds cameras that look into them. A mesh with alpha shows its inside, and a
deformed mesh may turn inside out: such meshes never count as closed.
"""

from __future__ import annotations

import operator
from typing import Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from ..._native import loaders as native
from ...model.geometry.derived import arrays_of
from ...model.geometry.mesh import Mesh

_READ = ("positions", "faces", "joints", "morph_positions")
_MOST_SIDES = 4096  # of holes: a mesh with more is no volume with a few holes
_known: WeakKeyDictionary[Mesh, tuple[list[Any], Holes | None]] = WeakKeyDictionary()


class Holes(NamedTuple):
    """The holes of a mesh: their rims, one after the other.

    Attributes
    ----------
    ends : (holes,) int32
        The end of each rim's points.
    points : (N, 3) float64
        Around each hole, in the winding order of its triangles; in the mesh's space.
    """

    ends: np.ndarray
    points: np.ndarray


def holes_of(mesh: Mesh) -> Holes | None:
    """Return the holes of a mesh that is closed except for them, with fronts outside.

    A ray from outside enters such a volume before it leaves it: it hits a front face first, unless
    it enters through a hole.

    Returns
    -------
    holes : Holes or None
        None if the mesh encloses no volume. Computed once for the mesh's arrays.
    """
    if any(material.alpha_mode != "opaque" for material in mesh.materials):
        return None
    arrays: dict[str, Any] = arrays_of(mesh)
    read = [arrays[name] for name in _READ]
    made_of, holes = _known.get(mesh, ([None], None))
    if not all(map(operator.is_, read, made_of)):
        holes = None
        if arrays["joints"] is None and arrays["morph_positions"] is None:
            holes = _holes(arrays["positions"], arrays["faces"])
        _known[mesh] = read, holes
    return holes


def _holes(positions: np.ndarray, faces: np.ndarray) -> Holes | None:
    places, first = native.number_rows(positions.view(np.uint32), True)
    sides = native.open_sides(positions, faces, places, len(first), _MOST_SIDES)
    if sides is None or not _are_rings(sides):
        return None
    points, faces = positions[first], places[faces]
    rims = _rims(sides)
    for rim in rims:  # a lid: a fan of triangles around the centre
        middle = points[rim].mean(axis=0, keepdims=True)
        lid = np.stack([np.roll(rim, -1), rim, np.full_like(rim, len(points))], axis=1)
        points, faces = np.concatenate([points, middle]), np.concatenate([faces, lid])
    if not native.encloses(points, faces, None, len(points)):
        return None
    ends = np.cumsum([len(rim) for rim in rims], dtype=np.int32)
    around = np.concatenate([*rims, np.zeros(0, np.int32)])
    return Holes(ends, points[around].astype(np.float64))


def _are_rings(sides: np.ndarray) -> bool:
    """Return whether at each place exactly one open edge ends and one begins."""
    begins, ends = np.sort(sides, axis=0).T
    return bool((begins == ends).all() and (begins[1:] != begins[:-1]).all())


def _rims(sides: np.ndarray) -> list[np.ndarray]:
    """Return the rims that open edges (N, 2) form, as rings of places."""
    after = dict(sides.tolist())
    rims = []
    while after:
        rim = [next(iter(after))]
        while (place := after.pop(rim[-1], None)) not in (None, rim[0]):
            rim.append(place)
        rims.append(np.array(rim, np.int32))
    return rims
