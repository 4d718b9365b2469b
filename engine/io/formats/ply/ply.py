"""Stanford PLY: meshes, point clouds and line segments, as text or binary of either byte order.

In: the bytes of a file. Out: a `Document` of one object. The steps are: header, rows, vertices,
faces, materials, and splitting of vertices whose corners differ in texture coordinate or colour.
Unknown elements and properties are skipped.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....errors import FileFormatError
from ....model.geometry.mesh import Mesh
from ....model.materials.material import Material
from ...reading.documents import Document, DocumentObject
from ...reading.far_coordinates import moved_near
from ...reading.indexed_mesh import IndexedGeometry, build_indexed_mesh
from ...reading.reader_registry import Reader
from ...reading.sources import Source
from ...reading.triangulation import WorkBudget
from ...reading.vertex_values import usable_normals
from ...reading.warning_list import WarningList
from .ply_body import open_body
from .ply_colors import is_splats
from .ply_faces import (
    PlyFaces,
    face_value_names,
    read_edges,
    read_face_values,
    read_faces,
    read_strips,
)
from .ply_header import is_ply, read_header
from .ply_materials import material_ids, read_materials
from .ply_tables import PlyTable, read_tables
from .ply_vertices import PlyVertices, numbers_of, read_vertices, value_names


def read_ply(source: Source, split: bool = False) -> Document:
    """Read a PLY file, as `Reader.read`: one object.

    With ``split``, coordinates far from the origin are moved near it.
    """
    warnings = WarningList(source.path)
    header = read_header(source, warnings)
    tables = read_tables(source, header, open_body(source, header))
    table = tables.get("vertex")
    if table is None or not len(table):
        raise FileFormatError("no vertices in this PLY file", source.path)
    if not table.has("x", "y", "z"):
        packed = ": compressed splats are not read" if table.has("packed_position") else ""
        raise FileFormatError(f"the vertices have no x, y and z{packed}", source.path)
    vertices = read_vertices(table, warnings, header.is_own)
    count = len(table)
    budget = WorkBudget.for_file(source.size)
    faces = read_faces(tables.get("face"), vertices.positions, budget, warnings)
    strips = read_strips(tables.get("tristrips"), count)
    lines = read_edges(tables.get("edge"), count)
    face_values = read_face_values(tables.get("face"), faces) if source.values else {}
    if len(strips) and not len(faces.corners):
        faces, face_values = PlyFaces(strips), {}
    has_uvs = vertices.uvs is not None or faces.uvs is not None
    positions, pose = moved_near(vertices.positions) if split else (vertices.positions, None)
    vertices = vertices._replace(positions=positions)
    names = value_names(table)
    values = numbers_of(table, names) if source.values else {}
    mesh = _mesh(vertices, faces, lines, source, values, face_values)
    mesh.materials = read_materials(source, header.textures, has_uvs, warnings)
    if is_splats(table):
        mesh.materials = [Material(alpha_mode="blend")]
    mesh.material_ids = material_ids(faces.textures, len(faces.corners), len(mesh.materials))
    counts = _counts(tables, vertices, faces, lines)
    entry = DocumentObject(source.stem, mesh, pose)
    arrays = {"vertices": names, "faces": face_value_names(tables.get("face"))}
    return Document("ply", [entry], counts=counts, warnings=warnings.messages(), arrays=arrays)


def _mesh(
    vertices: PlyVertices,
    faces: PlyFaces,
    lines: np.ndarray,
    source: Source,
    values: dict[str, np.ndarray],
    face_values: dict[str, np.ndarray],
) -> Mesh:
    geometry = IndexedGeometry(
        vertices.positions,
        faces.corners,
        normals=usable_normals(vertices.normals, vertices.positions, faces.corners),
        uvs=vertices.uvs,
        colors=vertices.colors,
        corner_uvs=faces.uvs,
        face_colors=faces.colors,
        lines=lines,
        position_ids=vertices.position_ids,
        edge_visible=faces.edge_visible,
        values=values,
        face_values=face_values,
        crease_angle=source.crease_angle,
    )
    return build_indexed_mesh(geometry, source.stem)


def _counts(
    tables: dict[str, PlyTable], vertices: PlyVertices, faces: PlyFaces, lines: np.ndarray
) -> dict[str, Any]:
    given = (("uvs", vertices.uvs), ("normals", vertices.normals), ("colors", vertices.colors))
    return {
        "vertices": len(vertices.positions),
        **{what: 0 if array is None else len(array) for what, array in given},
        "faces": len(tables["face"]) if "face" in tables else 0,
        "triangles": len(faces.corners),
        "lines": len(lines),
        "points": 0,
        "elements": list(tables),
    }


READERS = (Reader("ply", "Stanford PLY", "mesh", (".ply",), read_ply, signature=is_ply),)
