"""Applies a pose to the vertices of a mesh.

In: a mesh and an affine matrix. Out: a mesh that at the identity looks like the given one at the
pose. Computed in float64 and rounded once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...base.linalg import normal_matrix, transform_directions, transform_points
from .normals import unit_vectors
from .values import put_values
from .vertex_attributes import attributes_of

if TYPE_CHECKING:
    from .mesh import Mesh


def posed_mesh(mesh: Mesh, pose: np.ndarray) -> Mesh:
    """Return a mesh with a pose applied; a mirroring pose reverses its faces."""
    if np.array_equal(pose, np.eye(4)):
        return mesh
    rows = [pose[k, :3] for k in range(3)]
    mirrored = sum(rows[0][k] * np.cross(rows[1], rows[2])[k] for k in range(3)) < 0
    order = [0, 2, 1] if mirrored else [0, 1, 2]
    visible = mesh.edge_visible
    if visible is not None and mirrored:
        visible = visible[:, [2, 1, 0]]
    normals = None
    if mesh.has_normals:
        matrix = np.eye(4)
        matrix[:3, :3] = normal_matrix(pose)
        normals = unit_vectors(transform_directions(matrix, mesh.normals))
    posed = type(mesh)(
        transform_points(pose, mesh.positions),
        mesh.faces[:, order],
        normals=normals,
        materials=mesh.materials,
        material_ids=mesh.material_ids,
        lines=mesh.lines,
        points=mesh.points,
        edge_visible=visible,
        position_ids=mesh.position_ids,
        crease_angle=mesh.crease_angle,
        name=mesh.name,
        **attributes_of(mesh),
    )
    if mesh.tangents is not None:
        posed.tangents = _posed_tangents(mesh.tangents, pose, mirrored)
    posed.groups = mesh.groups
    put_values(posed, mesh.values)
    return posed


def _posed_tangents(tangents: np.ndarray, pose: np.ndarray, mirrored: bool) -> np.ndarray:
    """Return the tangents transformed; a mirroring pose flips the bitangent's sign."""
    posed = np.empty_like(tangents)
    posed[:, :3] = unit_vectors(transform_directions(pose, tangents[:, :3]))
    posed[:, 3] = -tangents[:, 3] if mirrored else tangents[:, 3]
    return posed
