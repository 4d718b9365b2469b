"""Builds a mesh from corners with separate indices of position, texture coordinate and normal.

In: the lists of a file, and triangles of indices into them. Out: a `Mesh` with one vertex for each
distinct combination; triangles keep their order. Unused positions are dropped.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple, TypeAlias

import numpy as np

from ..._native import loaders as native
from ...model.geometry.creases import SMOOTH
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ..formats.obj.mtl import uv_transform

# Faces, and each vertex's indices of position, texture coordinate and normal; None if all positions
# are kept, or no corner has the attribute.
_Welded: TypeAlias = tuple[np.ndarray, np.ndarray | None, np.ndarray | None, np.ndarray | None]


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
    """The triangles of a file.

    Attributes
    ----------
    positions : (T, 3) int32
        Indices of the corners' positions.
    uvs, normals : (T, 3) int32 or None
        Indices of texture coordinates and normals, -1 for none; None if no corner has any.
    materials : (T,) int32
    polygons : (T,) int32
        The polygon that each triangle was cut from.
    edge_visible : (T, 3) bool or None
    """

    positions: np.ndarray
    uvs: np.ndarray | None
    normals: np.ndarray | None
    materials: np.ndarray
    polygons: np.ndarray
    edge_visible: np.ndarray | None

    def part(self, chosen: slice) -> Triangles:
        """Return a range of triangles."""
        arrays = vars(self).items()
        return replace(self, **{name: rows[chosen] for name, rows in arrays if rows is not None})


class Geometry(NamedTuple):
    """The data of one mesh: lists, and elements that refer to them.

    Attributes
    ----------
    vertices : Vertices
    triangles : Triangles
    normals : (N, 3) float or None
        The normals that ``triangles.normals`` indexes; None leaves normals to the mesh.
    lines : (L, 2) int, points : (P,) int
        Position indices.
    crease_angle : float
        Radians, for normals left to the mesh.
    """

    vertices: Vertices
    triangles: Triangles
    normals: np.ndarray | None
    lines: np.ndarray
    points: np.ndarray
    crease_angle: float = SMOOTH

    def with_own_positions(self) -> Geometry:
        """Return the geometry with only its used positions, for one of many parts of a file."""
        corners = self.triangles.positions
        used = np.unique(np.concatenate([corners.ravel(), self.lines.ravel(), self.points]))
        colors = self.vertices.colors
        vertices = self.vertices._replace(
            positions=self.vertices.positions[used], colors=None if colors is None else colors[used]
        )
        return self._replace(
            vertices=vertices,
            triangles=replace(self.triangles, positions=np.searchsorted(used, corners)),
            lines=np.searchsorted(used, self.lines),
            points=np.searchsorted(used, self.points),
        )


def build_mesh(geometry: Geometry, materials: list[Material], name: str) -> Mesh:
    """Weld corners into vertices."""
    vertices, triangles, normals, lines, points, crease_angle = geometry
    count = len(vertices.positions)
    uv_indices, uvs = _transformed_uvs(triangles, vertices.uvs, materials)
    normal_indices = None if normals is None else triangles.normals
    faces, of_position, of_uv, of_normal = _weld(
        triangles.positions, uv_indices, normal_indices, count
    )
    used = np.concatenate([lines.ravel(), points])
    vertex_of, of_position, extra = _vertices_for(used, of_position, count)
    is_split = uv_indices is not None or normal_indices is not None
    return Mesh(
        _rows(vertices.positions, of_position),
        faces,
        normals=(
            None if normals is None or of_normal is None else _gather(normals, of_normal, extra)
        ),
        uvs=None if of_uv is None else _finite(_gather(uvs, of_uv, extra)),
        colors=None if vertices.colors is None else _rows(vertices.colors, of_position),
        materials=materials,
        material_ids=triangles.materials,
        lines=vertex_of[: lines.size].reshape(-1, 2),
        points=vertex_of[lines.size :],
        edge_visible=triangles.edge_visible,
        position_ids=of_position if is_split else None,
        crease_angle=crease_angle if normals is None else SMOOTH,
        name=name,
    )


def _transformed_uvs(
    triangles: Triangles, uvs: np.ndarray, materials: list[Material]
) -> tuple[np.ndarray | None, np.ndarray]:
    """Return texture coordinates after each material's ``-s`` and ``-o``, and their indices.

    A coordinate shared by materials with different transforms is duplicated.
    """
    transforms: dict[tuple[float, ...], int] = {(1.0, 1.0, 0.0, 0.0): 0}
    kinds = [transforms.setdefault(uv_transform(m), len(transforms)) for m in materials]
    indices = triangles.uvs
    if indices is None or len(transforms) == 1:
        return indices, uvs
    kind = np.array(kinds)[triangles.materials].reshape(-1, 1)
    keys = np.where(indices < 0, -1, indices.astype(np.int64) * len(transforms) + kind)
    unique, inverse = np.unique(keys, return_inverse=True)
    source, kind = np.divmod(unique, len(transforms))
    table = np.array(list(transforms), np.float64)[kind]
    moved = uvs[source] * table[:, :2] + table[:, 2:]
    moved[unique < 0] = 0
    return inverse.reshape(indices.shape), moved


def _weld(
    positions: np.ndarray, uvs: np.ndarray | None, normals: np.ndarray | None, position_count: int
) -> _Welded:
    """Number the distinct combinations of indices, in the order of their positions."""
    if uvs is None and normals is None:
        return _without_unused(positions, position_count)
    faces, of_position, of_uv, of_normal = native.weld_corners(
        _flat(positions),
        None if uvs is None else _flat(uvs),
        None if normals is None else _flat(normals),
        position_count,
    )
    return faces.reshape(-1, 3), of_position, of_uv, of_normal


def _flat(indices: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(indices, np.int32).ravel()


def _without_unused(positions: np.ndarray, position_count: int) -> _Welded:
    """Return faces over their used positions, if only positions matter."""
    is_used = native.used_or_all(_flat(positions), position_count)
    if is_used is None:
        return positions, None, None, None
    number = np.cumsum(is_used, dtype=np.int32) - 1
    return number[positions], np.flatnonzero(is_used), None, None


def _vertices_for(
    used: np.ndarray, of_position: np.ndarray | None, position_count: int
) -> tuple[np.ndarray, np.ndarray | None, int]:
    """Return a vertex for each used position: an existing one of the faces, or a new one."""
    if of_position is None:
        return used, None, 0
    vertex = np.full(position_count, -1, np.int32)
    vertex[of_position[::-1]] = np.arange(len(of_position), dtype=np.int32)[::-1]
    is_new = np.zeros(position_count, bool)
    is_new[used[vertex[used] < 0]] = True
    new = np.flatnonzero(is_new)
    vertex[new] = len(of_position) + np.arange(len(new), dtype=np.int32)
    return vertex[used], np.concatenate([of_position, new]), len(new)


def _rows(table: np.ndarray, indices: np.ndarray | None) -> np.ndarray:
    return table if indices is None else table[indices]


def _gather(table: np.ndarray, indices: np.ndarray, extra: int) -> np.ndarray:
    """Return rows of a table; zero for index -1 and for vertices used only by lines and points."""
    rows = np.zeros((len(indices) + extra, table.shape[1]), np.float32)
    present = slice(None) if indices.min(initial=0) >= 0 else indices >= 0
    with np.errstate(over="ignore"):
        rows[: len(indices)][present] = table[indices[present]]
    return rows


def _finite(rows: np.ndarray) -> np.ndarray:
    """Return rows with non-finite values replaced by zero."""
    rows[~np.isfinite(rows)] = 0
    return rows
