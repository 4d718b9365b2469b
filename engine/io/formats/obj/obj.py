"""Wavefront OBJ: polygons, lines and points, with the materials of its libraries.

In: the bytes of a file, and the libraries and images that it names. Out: a `Document`. The steps
are: parsing (in C), triangulation, materials, normals, welding. Free-form curves and surfaces are
left out with a warning; ``call`` and ``csh`` are never followed.
"""

from __future__ import annotations

import numpy as np

from ...._native.loaders import frozen
from ....model.geometry.creases import SMOOTH
from ....model.materials.material import Material
from ...reading.corner_mesh import Triangles
from ...reading.documents import Document
from ...reading.linked_textures import give_companion_texture
from ...reading.reader_registry import Reader
from ...reading.smoothing import fill_normals
from ...reading.sources import Source
from ...reading.triangulation import Triangulation, WorkBudget, triangulate
from ...reading.undrawn import warn_of_undrawn
from ...reading.warning_list import WarningList
from .mtl import undrawn_kinds
from .obj_file import Elements, ObjFile, ObjStates, read_obj_file, run_lengths
from .obj_materials import only_material, read_library, used_materials
from .obj_parts import ObjParts


def read_obj(source: Source, split: bool = False) -> Document:
    """Read an OBJ file, as `Reader.read`; an ``o`` statement starts an object."""
    warnings = WarningList(source.path)
    file = read_obj_file(source, warnings)
    states = ObjStates(file, warnings)
    cut = _cut(source, file, warnings)
    materials, material_ids = _materials(source, file, states, cut, warnings)
    triangles = _triangles(file.faces, cut, material_ids)
    # The file's smoothing groups apply regardless of the crease angle.
    crease_angle = SMOOTH if states.has_smoothing else source.crease_angle
    normals = _fill_normals(file, triangles, states, crease_angle)
    parts = ObjParts(file, triangles, normals, states, materials, crease_angle, moves=split)
    objects = parts.objects(source.stem, warnings) if split else [parts.whole(source.stem)]
    return Document("obj", objects, counts=parts.counts(), warnings=warnings.messages())


def _cut(source: Source, file: ObjFile, warnings: WarningList) -> Triangulation | None:
    """Triangulate the faces; return None if all are triangles."""
    if file.faces.are_triangles:
        return None
    budget = WorkBudget.for_file(source.size)
    faces = file.faces
    cut = triangulate(faces.sizes, file.vertices.positions, budget, indices=faces.positions)
    if not cut.is_complete:
        warnings.add("too many concave polygons: some are cut as if they were convex")
    return cut


def _materials(
    source: Source,
    file: ObjFile,
    states: ObjStates,
    cut: Triangulation | None,
    warnings: WarningList,
) -> tuple[list[Material], np.ndarray]:
    """Return the materials in use, and that of each triangle.

    Triangles without a ``usemtl`` get one unnamed material.
    """
    library = read_library(source, states.libraries, len(states.materials) > 0, warnings)
    materials, material_of_use = used_materials(states.materials, library, warnings)
    only = None if materials else only_material(library, warnings)
    is_of_library = only is not None or any(m.name in library for m in materials)
    if is_of_library:
        warn_of_undrawn(map(undrawn_kinds, [only] if only else materials), warnings)
    faces = len(file.faces.sizes)
    lengths = run_lengths(states.materials, faces)
    ids = np.repeat(np.array([len(materials), *material_of_use], np.int32), lengths)
    ids = frozen(ids if cut is None else ids[cut.polygons])
    if not materials or (lengths[0] > 0 and (ids == len(materials)).any()):
        materials.append(Material() if only is None else only)
    if not is_of_library and len(file.vertices.uvs):
        give_companion_texture(source, materials, warnings)
    return materials, ids


def _triangles(faces: Elements, cut: Triangulation | None, material_ids: np.ndarray) -> Triangles:
    def corners(indices: np.ndarray) -> np.ndarray:
        return indices.reshape(-1, 3) if cut is None else indices[cut.corners]

    return Triangles(
        corners(faces.positions),
        None if faces.uvs is None else corners(faces.uvs),
        None if faces.normals is None else corners(faces.normals),
        material_ids,
        np.arange(len(faces.sizes), dtype=np.int32) if cut is None else cut.polygons,
        None if cut is None else cut.edge_visible,
    )


def _fill_normals(
    file: ObjFile, triangles: Triangles, states: ObjStates, crease_angle: float
) -> np.ndarray | None:
    """Fill in missing normals of triangles; return the normals they index."""
    vertices = file.vertices
    if triangles.normals is None and not states.has_smoothing:
        # This is the result of `fill_normals`, without visiting each triangle.
        return None
    if triangles.normals is not None and triangles.normals.min(initial=0) >= 0:
        return vertices.normals
    filled = fill_normals(
        vertices.positions,
        triangles.positions,
        triangles.normals,
        vertices.normals,
        states.smoothing_groups(len(file.faces.sizes))[triangles.polygons],
        triangles.polygons,
        crease_angle=crease_angle,
    )
    if filled is None:
        return None
    triangles.normals, normals = filled
    return normals


def _resembles_obj(head: bytes, size: int) -> bool:
    return b"\0" not in head and any(
        line.startswith((b"v ", b"vn ", b"vt ", b"f ", b"mtllib ")) for line in head.splitlines()
    )


READERS = (
    Reader("obj", "Wavefront OBJ with MTL", "mesh", (".obj",), read_obj, resembles=_resembles_obj),
)
