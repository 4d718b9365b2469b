"""Splits vertices: makes a mesh whose vertices are another's, some of them repeated.

In: a mesh, new faces, the old vertex of each new one, and the attributes that change. Out: a mesh
that keeps everything else.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .values import put_values, taken_rows
from .vertex_attributes import attributes_of

if TYPE_CHECKING:
    from .mesh import Mesh


def split_mesh(mesh: Mesh, faces: np.ndarray, rows: np.ndarray, **given: Any) -> Mesh:
    """Return the mesh with its vertices taken from given rows, the old vertices first.

    Parameters
    ----------
    mesh : Mesh
    faces : (F, 3) int
        As many faces as before, in the same order.
    rows : (W,) int
    **given
        Attributes of the new vertices, as parameters of `Mesh`.
    """
    ids = mesh.position_ids
    if ids is None and len(rows) > len(mesh.positions):
        ids = np.arange(len(mesh.positions), dtype=np.int32)
    attributes = {name: array[rows] for name, array in attributes_of(mesh).items()}
    if mesh.has_normals:
        attributes["normals"] = mesh.normals[rows]
    made = type(mesh)(
        mesh.positions[rows],
        faces,
        materials=mesh.materials,
        material_ids=mesh.material_ids,
        lines=mesh.lines,
        points=mesh.points,
        edge_visible=mesh.edge_visible,
        position_ids=None if ids is None else ids[rows],
        joints=None if mesh.joints is None else mesh.joints[rows],
        weights=None if mesh.weights is None else mesh.weights[rows],
        morph_targets=[target.rows(rows) for target in mesh.morph_targets],
        crease_angle=mesh.crease_angle,
        name=mesh.name,
        **{**attributes, **given},
    )
    made.groups = mesh.groups
    put_values(made, taken_rows(mesh.values, vertices=rows, faces=..., points=...))
    made.warnings = list(mesh.warnings)
    return made
