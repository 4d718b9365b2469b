"""A mesh from corners that name a position, a texture coordinate and a normal each.

In: the lists of a file, and triangles of indices into them. Out: a `Mesh` with one vertex for each
combination that occurs; triangles keep their order. Positions that nothing uses are left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..materials import Material
from ..mesh import Mesh
from .mtl import uv_transform


class Vertices(NamedTuple):
    """The vertex lists of a file.

    Attributes
    ----------
    positions : (V, 3) float64
    colors : (V, 4) uint8 or None
        sRGB; white for vertices without a colour.
    uvs : (T, 2) float64
    normals : (N, 3) float64
    """

    positions: np.ndarray
    colors: np.ndarray | None
    uvs: np.ndarray
    normals: np.ndarray


@dataclass
class Triangles:
    """Triangles of a file.

    Attributes
    ----------
    positions, uvs, normals : (T, 3) int64
        Indices of the corners; -1 for none.
    materials : (T,) int32
    polygons : (T,) int64
        The polygon that each triangle was cut from.
    edge_visible : (T, 3) bool or None
    """

    positions: np.ndarray
    uvs: np.ndarray
    normals: np.ndarray
    materials: np.ndarray
    polygons: np.ndarray
    edge_visible: np.ndarray | None

    def select(self, chosen: np.ndarray) -> Triangles:
        """Return some of the triangles; ``chosen`` is a mask (T,)."""
        visible = None if self.edge_visible is None else self.edge_visible[chosen]
        return Triangles(
            self.positions[chosen],
            self.uvs[chosen],
            self.normals[chosen],
            self.materials[chosen],
            self.polygons[chosen],
            visible,
        )


def build_mesh(
    vertices: Vertices,
    triangles: Triangles,
    normals: np.ndarray | None,
    lines: np.ndarray,
    points: np.ndarray,
    materials: list[Material],
    name: str,
) -> Mesh:
    """Weld corners into vertices.

    Parameters
    ----------
    vertices : Vertices
    triangles : Triangles
    normals : (N, 3) float or None
        What ``triangles.normals`` refers to; None leaves normals to the mesh.
    lines : (L, 2) int64, points : (P,) int64
        Position indices.
    materials : list of Material
    name : str
    """
    uv_indices, uvs = _with_uv_transforms(triangles, vertices.uvs, materials)
    normal_indices = triangles.normals if normals is not None else None
    welded = _weld(triangles.positions, uv_indices, normal_indices, len(vertices.positions))
    faces, (of_position, of_uv, of_normal) = welded
    used = np.concatenate([lines.ravel(), points])
    vertex_of, of_position, extra = _vertices_for(used, of_position, len(vertices.positions))
    has_uvs = uv_indices is not None and bool((uv_indices >= 0).any())
    is_split = uv_indices is not None or normal_indices is not None
    mesh = Mesh(
        vertices.positions[of_position],
        faces.astype(np.int32),
        normals=None if normals is None else _gather(normals, of_normal, extra),
        uvs=_gather(uvs, of_uv, extra) if has_uvs else None,
        colors=None if vertices.colors is None else vertices.colors[of_position],
        materials=materials,
        material_ids=triangles.materials,
        lines=vertex_of[: lines.size].reshape(-1, 2),
        points=vertex_of[lines.size :],
        edge_visible=triangles.edge_visible,
        position_ids=of_position if is_split and len(of_position) else None,
        name=name,
    )
    return mesh


def _with_uv_transforms(triangles, uvs, materials):
    """Texture coordinates as each material's ``-s`` and ``-o`` want them; None if there are none.

    The transformed lists are put behind the file's own, so that a coordinate which two materials
    share becomes two.
    """
    if len(uvs) == 0:
        return None, uvs
    indices, tables = triangles.uvs, [uvs]
    for number, material in enumerate(materials):
        transform = uv_transform(material)
        if transform is None:
            continue
        indices = indices.copy() if indices is triangles.uvs else indices
        own = (triangles.materials == number)[:, np.newaxis] & (indices >= 0)
        indices[own] += len(tables) * len(uvs)
        tables.append(uvs * np.array(transform[:2]) + np.array(transform[2:]))
    return indices, np.concatenate(tables)


def _weld(positions, uvs, normals, position_count):
    """Number the combinations of indices that occur.

    Returns the faces (T, 3), and for each vertex its index of position, of texture coordinate and
    of normal. Vertices stand in the order of their positions.
    """
    if uvs is None and normals is None:
        return _without_unused(positions, position_count)
    keys, spans = positions, []
    for other in (uvs, normals):
        span = 1 if other is None else int(other.max(initial=-1)) + 2
        keys = keys * span + (0 if other is None else other + 1)
        spans.append(span)
    unique, faces = np.unique(keys, return_inverse=True)
    unique, of_normal = np.divmod(unique, spans[1])
    of_position, of_uv = np.divmod(unique, spans[0])
    return faces.reshape(-1, 3), (of_position, of_uv - 1, of_normal - 1)


def _without_unused(positions, position_count):
    """Faces over the positions that they use, if only positions matter."""
    is_used = np.zeros(position_count, bool)
    is_used[positions.ravel()] = True
    if is_used.all():
        everything = np.arange(position_count)
        return positions, (everything, None, None)
    of_position = np.flatnonzero(is_used)
    number = np.cumsum(is_used) - 1
    return number[positions], (of_position, None, None)


def _vertices_for(used, of_position, position_count):
    """A vertex for each used position: one that the faces have, or a new one at the end."""
    vertex = np.full(position_count, -1, np.int64)
    vertex[of_position[::-1]] = np.arange(len(of_position))[::-1]
    new = np.unique(used[vertex[used] < 0])
    vertex[new] = len(of_position) + np.arange(len(new))
    return vertex[used], np.concatenate([of_position, new]), len(new)


def _gather(table, indices, extra):
    """Rows of a table; zero for index -1 and for the vertices that only lines and points use."""
    rows = np.zeros((len(indices) + extra, table.shape[1]), np.float32)
    present = indices >= 0
    with np.errstate(over="ignore"):
        rows[: len(indices)][present] = table[indices[present]]
    return rows
