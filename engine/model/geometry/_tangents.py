"""Tangents of meshes for normal maps, computed the way normal maps are baked.

In: a mesh with texture coordinates. Out: a mesh with tangents; its vertices are split where the
texture is mirrored or sheared. The method is Mikkelsen's (csrc/io/loaders/tangents.c), which
Blender and most bakers use.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..._native import loaders as native
from ...errors import InvalidArgumentError
from .creases import mesh_with_creases
from .splitting import split_mesh
from .vertex_attributes import attributes_of

if TYPE_CHECKING:
    from .mesh import Mesh


def mesh_with_tangents(mesh: Mesh, uv_set: int) -> Mesh:
    """Return a mesh with tangents; see `Mesh.with_tangents`."""
    if uv_set not in (0, 1):
        raise InvalidArgumentError(f"uv_set must be 0 or 1, not {uv_set!r}")
    uvs = mesh.uvs1 if uv_set else mesh.uvs
    if uvs is None:
        name = "uvs1" if uv_set else "uvs"
        raise InvalidArgumentError(f"tangents need texture coordinates, but there are no {name}")
    mesh = mesh_with_creases(mesh)
    uvs = attributes_of(mesh)["uvs1" if uv_set else "uvs"]
    rows = np.concatenate([mesh.positions, mesh.normals, uvs], axis=1)
    points, _ = native.number_rows(rows.view(np.uint32), True)
    groups, of_group = native.find_tangents(mesh.positions, mesh.normals, uvs, mesh.faces, points)
    count = len(mesh.positions)
    faces, added = _split(mesh.faces.reshape(-1), groups.reshape(-1), count, len(of_group))
    tangents = np.zeros((count + len(added), 4), np.float32)
    tangents[faces] = of_group[groups.reshape(-1)]
    rows = np.concatenate([np.arange(count), added])
    return split_mesh(mesh, faces.reshape(-1, 3), rows, tangents=tangents)


def _split(
    vertices: np.ndarray, groups: np.ndarray, count: int, group_count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return a one-group vertex for each corner, and the old vertices of the new ones.

    The group of a vertex's first corner keeps the vertex.
    """
    keys, first, of_corner = np.unique(
        vertices.astype(np.int64) * max(group_count, 1) + groups,
        return_index=True,
        return_inverse=True,
    )
    vertex = keys // max(group_count, 1)
    order = np.argsort(first, kind="stable")
    keeps = np.zeros(len(keys), bool)
    keeps[order[np.unique(vertex[order], return_index=True)[1]]] = True
    rest = order[~keeps[order]]
    number = vertex.copy()
    number[rest] = count + np.arange(len(rest))
    return number[of_corner.reshape(-1)].astype(np.int32), vertex[rest]
