"""Meshes with poses, as the objects of a `Document`.

In: parts, several of which may share a mesh. Out: one object each, as it is or with its pose
applied. Any number of nodes may repeat a mesh, so that joined they are limited.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..errors import FileFormatError
from ..geometry.mesh import Mesh
from ..geometry.normals import unit_vectors
from ..geometry.vertex_attributes import attributes_of
from ..linalg import normal_matrix, transform_directions, transform_points
from .documents import DocumentObject
from .sources import Source
from .text import shown

# A file's meshes may hold so many numbers, and its nodes may repeat so many vertices, and besides
# as many as it has bytes. Assign another value to change it.
MAX_REPEATED = 1 << 20


class PosedPart(NamedTuple):
    """One node of a file that shows a mesh.

    Attributes
    ----------
    name : str
    mesh : Mesh
    pose : (4, 4) float64
    """

    name: str
    mesh: Mesh
    pose: np.ndarray


def document_objects(
    source: Source, parts: list[PosedPart], most_vertices: int, split: bool
) -> list[DocumentObject]:
    """Return one object for each part.

    Parameters
    ----------
    source : Source
    parts : list of PosedPart
    most_vertices : int
        How many vertices all parts may have if their poses are applied.
    split : bool
        Keep the poses apart, and meshes shared.

    Raises
    ------
    FileFormatError
        A pose is not affine, there are too many vertices or none.
    """
    for part in parts:
        if not (np.isfinite(part.pose).all() and np.array_equal(part.pose[3], (0, 0, 0, 1))):
            raise FileFormatError(f"node {shown(part.name)} has no affine pose", source.path)
    vertices = sum(len(part.mesh.positions) for part in parts)
    if not vertices:
        raise FileFormatError("no vertices in this file", source.path)
    if not split and vertices > most_vertices:
        raise FileFormatError(
            f"{vertices} vertices where meshes are repeated: one mesh of them is limited to "
            f"{most_vertices}; load_scene keeps the meshes apart",
            source.path,
        )
    if split:
        return [DocumentObject(*part) for part in parts]
    return [DocumentObject(part.name, posed_mesh(part.mesh, part.pose)) for part in parts]


def posed_mesh(mesh: Mesh, pose: np.ndarray) -> Mesh:
    """Return a mesh with a pose applied; a mirroring one turns its faces over."""
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
    return Mesh(
        transform_points(pose, mesh.positions),
        mesh.faces[:, order],
        normals=normals,
        materials=mesh.materials,
        material_ids=mesh.material_ids,
        lines=mesh.lines,
        points=mesh.points,
        edge_visible=visible,
        position_ids=mesh.position_ids,
        name=mesh.name,
        **attributes_of(mesh),
    )


def counts_of(objects: list[DocumentObject]) -> dict:
    """Return the lists that the objects hold, as `Document.counts` shows them."""
    return {
        "vertices": sum(len(entry.mesh.positions) for entry in objects),
        "faces": sum(len(entry.mesh.faces) for entry in objects),
        "triangles": sum(len(entry.mesh.faces) for entry in objects),
        "objects": [entry.name for entry in objects],
    }
