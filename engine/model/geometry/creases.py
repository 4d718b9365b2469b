"""Vertex normals that are smooth except at creases, with vertices split where needed.

In: the arrays of a mesh without normals, and the crease angle: an edge whose two triangles meet at
a greater angle is a crease. Out: the arrays with normals, and with vertices split where their
triangles have several (csrc/io/loaders/creases.c has the method). Vertices at exactly the same
place are one point of the surface, whatever their attributes. The old vertices keep their numbers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..._native import loaders as native
from ...base import linalg
from ...base.angles import limited_angle
from .normals import vertex_normals
from .splitting import split_mesh

if TYPE_CHECKING:
    from .mesh import Mesh

#: No edge is a crease at this angle.
SMOOTH = math.pi
#: The loaders' angle: 12-sided cylinders look round, 45-degree bevels stay sharp.
CREASE_ANGLE = math.radians(35.0)


class Creased(NamedTuple):
    """Triangles whose vertices have one normal each.

    Attributes
    ----------
    faces : (F, 3) int32
    rows : (W,) int32 or None
        The old vertex of each; None if they are the old ones.
    normals : (W, 3) float32
    """

    faces: np.ndarray
    rows: np.ndarray | None
    normals: np.ndarray


def check_crease_angle(value: float, what: str = "crease_angle") -> float:
    """Return a checked crease angle."""
    return limited_angle(value, what, math.pi, "from 0 to pi radians")


def has_creases(arrays: dict[str, Any], angle: float) -> bool:
    """Return whether a mesh gets creased normals: it has no normals, joints or morph targets."""
    movers = ("_given_normals", "joints", "morph_positions")
    return angle < SMOOTH and len(arrays["faces"]) > 0 and all(arrays[m] is None for m in movers)


def find_creases(arrays: dict[str, Any], angle: float) -> Creased:
    """Return the triangles of a mesh and their normals.

    Parameters
    ----------
    arrays : dict of str to ndarray
        As `Mesh` keeps them.
    angle : float
        Radians.
    """
    positions, faces, visible = (arrays[n] for n in ("positions", "faces", "edge_visible"))
    places, count = None, len(positions)
    bits = positions.view(np.uint32)
    if native.rows_repeat(bits, True):
        places, first = native.number_rows(bits, True)
        count = len(first)
    split, sources, normals, is_smooth = native.find_creases(
        positions,
        faces,
        places,
        None if visible is None else visible.view(np.uint8),
        count,
        float(linalg.cos(angle)),
    )
    if is_smooth:
        # A surface without creases must get the same bits whether creases were searched for or not.
        return Creased(faces, None, vertex_normals(positions, faces, places))
    if not len(sources):
        return Creased(split, None, normals)
    return Creased(
        split, np.concatenate([np.arange(len(positions), dtype=np.int32), sources]), normals
    )


def creased_arrays(
    arrays: dict[str, Any], attributes: Iterable[str], angle: float
) -> dict[str, Any]:
    """Return the arrays of a mesh with normals and split vertices.

    Parameters
    ----------
    arrays, angle
        As for `find_creases`.
    attributes : iterable of str
        Names of the vertex attributes.
    """
    made = find_creases(arrays, angle)
    changed = {"faces": made.faces, "_given_normals": made.normals}
    if made.rows is not None:
        named = ("positions", "position_ids", *attributes)
        rows = {name: arrays[name] for name in named if arrays[name] is not None}
        changed |= {name: array[made.rows] for name, array in rows.items()}
    return {**arrays, **{name: native.frozen(array) for name, array in changed.items()}}


def mesh_with_creases(mesh: Mesh) -> Mesh:
    """Return the mesh with creased normals; see `Mesh.with_creases`."""
    arrays = dict(mesh._arrays)
    if not has_creases(arrays, mesh.crease_angle):
        return mesh
    made = find_creases(arrays, mesh.crease_angle)
    rows = np.arange(len(mesh.positions)) if made.rows is None else made.rows
    return split_mesh(mesh, made.faces, rows, normals=made.normals)
