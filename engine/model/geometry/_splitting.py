"""A mesh whose vertices are those of another, some of them several times.

In: a mesh, other faces, the old vertex of each new one, and what the new ones have instead. Out: a
mesh with everything else that the old one had.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .vertex_attributes import attributes_of

if TYPE_CHECKING:
    from .mesh import Mesh


def split_mesh(mesh: Mesh, faces: np.ndarray, rows: np.ndarray, **given: Any) -> Mesh:
    """Return the mesh with the vertices of some rows, the old ones first.

    Parameters
    ----------
    mesh : Mesh
    faces : (F, 3) int
        As many as before, in their order.
    rows : (W,) int
    **given
        What the new vertices have, as parameters of `Mesh`.
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
    made.warnings = list(mesh.warnings)
    return made
