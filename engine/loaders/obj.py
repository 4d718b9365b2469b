"""Wavefront OBJ: polygons, lines and points, with the materials of its libraries.

In: the bytes of a file, and the libraries and images that it names. Out: a `Document`. The order of
work: arrays of the file (in C), triangles, materials, normals, welding. Free-form curves and
surfaces are left out with a warning; ``call`` and ``csh`` are never followed.
"""

from __future__ import annotations

import numpy as np

from ..materials import Material
from .corner_mesh import Triangles, Vertices
from .documents import Document
from .ear_clipping import WorkBudget
from .obj_file import Elements, ObjFile, read_obj_file
from .obj_materials import give_companion_texture, read_library, used_materials
from .obj_parts import ObjParts
from .obj_states import ObjStates, last_before
from .registry import Reader
from .smoothing import fill_normals
from .sources import Source
from .triangulation import Triangulation, triangulate
from .warning_list import WarningList


def read_obj(source: Source, split: bool = False) -> Document:
    """Read an OBJ file.

    Parameters
    ----------
    source : Source
    split : bool
        Make one object of each ``o`` statement's faces; otherwise all are one mesh.

    Raises
    ------
    FileFormatError
    """
    warnings = WarningList(source.path)
    file = read_obj_file(source, warnings)
    states = ObjStates(file, warnings)
    cut = _cut(source, file, warnings)
    materials, material_ids = _materials(source, file, states, cut, warnings)
    triangles = _triangles(file.faces, cut, material_ids)
    normals = _fill_normals(
        file.vertices, triangles, states.smoothing_groups(len(file.faces.sizes))
    )
    parts = ObjParts(file, triangles, normals, states, materials)
    objects = parts.objects(source.stem, warnings) if split else [parts.whole(source.stem)]
    return Document("obj", objects, counts=parts.counts(), warnings=warnings.messages())


def _cut(source, file: ObjFile, warnings) -> Triangulation | None:
    """Cut the faces into triangles; None if all are."""
    if file.faces.are_triangles:
        return None
    budget = WorkBudget.for_file(len(source.data))
    positions = file.vertices.positions[file.faces.positions]
    cut = triangulate(file.faces.sizes, positions, budget)
    if not cut.is_complete:
        warnings.add("too many concave polygons: some are cut as if they were convex")
    return cut


def _materials(source, file: ObjFile, states: ObjStates, cut: Triangulation | None, warnings):
    """The materials in use, and the one of each triangle.

    Without any there is one without a name; so there is for triangles before the first ``usemtl``.
    """
    library = read_library(source, states.libraries, warnings)
    materials, material_of_use = used_materials(states.materials, library, warnings)
    use = last_before(states.materials, len(file.faces.sizes))
    use = use if cut is None else use[cut.polygons]
    ids = np.array([*material_of_use, len(materials)], np.int32)[use]
    if not materials or (use < 0).any():
        materials.append(Material())
    if not library and len(file.vertices.uvs):
        give_companion_texture(source, materials, warnings)
    return materials, ids


def _triangles(faces: Elements, cut: Triangulation | None, material_ids: np.ndarray) -> Triangles:
    indices = (faces.positions, faces.uvs, faces.normals)
    if cut is None:
        corners = [None if array is None else array.reshape(-1, 3) for array in indices]
        polygons = np.arange(len(faces.sizes), dtype=np.int32)
        return Triangles(*corners, material_ids, polygons, None)
    corners = [None if array is None else array[cut.corners] for array in indices]
    return Triangles(*corners, material_ids, cut.polygons, cut.edge_visible)


def _fill_normals(vertices: Vertices, triangles: Triangles, groups: np.ndarray):
    """Give the triangles the normals that they lack; returns what their indices refer to."""
    filled = fill_normals(
        vertices.positions,
        triangles.positions,
        triangles.normals,
        vertices.normals,
        groups[triangles.polygons],
        triangles.polygons,
    )
    if filled is None:
        return None
    triangles.normals, normals = filled
    return normals


def _resembles_obj(head: bytes) -> bool:
    return b"\0" not in head and any(
        line.startswith((b"v ", b"vn ", b"vt ", b"f ", b"mtllib ")) for line in head.splitlines()
    )


READERS = (
    Reader("obj", "Wavefront OBJ with MTL", "mesh", (".obj",), read_obj, resembles=_resembles_obj),
)
