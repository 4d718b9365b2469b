"""Wavefront OBJ: polygons, lines and points, with the materials of its libraries.

In: the bytes of a file, and the libraries and images that it names. Out: a `Document`. The order of
work: statements, vertex lists, elements, materials, triangles, normals, welding. Free-form curves
and surfaces are left out with a warning; ``call`` and ``csh`` are never followed.
"""

from __future__ import annotations

import numpy as np

from ..errors import FileFormatError
from ..materials import Material
from .corner_mesh import Triangles, Vertices
from .documents import Document
from .ear_clipping import WorkBudget
from .obj_elements import Elements, read_elements, read_vertices
from .obj_materials import give_companion_texture, read_library, used_materials
from .obj_parts import ObjParts
from .obj_statements import Statements
from .obj_states import ObjStates, last_before
from .registry import Reader
from .smoothing import fill_normals
from .sources import Source
from .text import text_lines
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
    statements = Statements(text_lines(source))
    vertices = read_vertices(statements, warnings)
    if len(vertices.positions) == 0:
        raise FileFormatError("no vertices in this OBJ file", source.path)
    faces = read_elements(statements, ("f", "fo"), vertices, warnings)
    lines = read_elements(statements, ("l",), vertices, warnings)
    points = read_elements(statements, ("p",), vertices, warnings)
    states = ObjStates(statements, warnings)
    cut = _cut(source, statements, vertices, faces, warnings)
    has_uvs = len(vertices.uvs) > 0
    of_triangles = faces.statements[cut.polygons]
    materials, material_ids = _materials(source, states, of_triangles, has_uvs, warnings)
    triangles = _triangles(faces, cut, material_ids)
    normals = _fill_normals(vertices, triangles, states.smoothing_groups(faces.statements))
    parts = ObjParts(vertices, triangles, normals, faces, lines, points, states, materials)
    objects = parts.objects(source.stem, warnings) if split else [parts.whole(source.stem)]
    return Document("obj", objects, counts=parts.counts(), warnings=warnings.messages())


def _cut(source, statements, vertices: Vertices, faces: Elements, warnings) -> Triangulation:
    """Cut the faces into triangles."""
    short = np.flatnonzero(faces.sizes < 3)
    if len(short):
        warnings.add(
            f"{len(short)} faces of fewer than three corners are left out",
            statements.line(faces.statements[short[0]]),
        )
    budget = WorkBudget.for_file(len(source.data))
    cut = triangulate(faces.sizes, vertices.positions[faces.positions], budget)
    if not cut.is_complete:
        warnings.add("too many concave polygons: some are cut as if they were convex")
    return cut


def _materials(source, states: ObjStates, of_triangles: np.ndarray, has_uvs: bool, warnings):
    """The materials in use, and the one of each triangle.

    Without any there is one without a name; so there is for triangles before the first ``usemtl``.
    """
    library = read_library(source, states.libraries, warnings)
    materials, material_of_use = used_materials(states.material_uses, library, warnings)
    use = last_before(states.use_statements, of_triangles)
    ids = np.array([*material_of_use, len(materials)], np.int32)[use]
    if not materials or (use < 0).any():
        materials.append(Material())
    if not library and has_uvs:
        give_companion_texture(source, materials, warnings)
    return materials, ids


def _triangles(faces: Elements, cut: Triangulation, material_ids: np.ndarray) -> Triangles:
    indices = (faces.positions, faces.uvs, faces.normals)
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
