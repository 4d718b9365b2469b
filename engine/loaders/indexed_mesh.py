"""A mesh from faces whose corners name one vertex each.

In: vertices with their attributes, triangles of vertex indices, and what differs from corner to
corner (texture coordinates) or from face to face (colours). Out: a `Mesh`, its vertices split where
their corners differ; triangles keep their order. Vertices that nothing uses are left out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._native import loaders as native
from ..geometry.mesh import Mesh
from .smoothing import join_seams
from .welding import number_rows

# All vertices as they are.
_ALL = slice(None)


@dataclass
class IndexedGeometry:
    """What a mesh is made of.

    Attributes
    ----------
    positions : (V, 3) float
    corners : (T, 3) int
        Vertex indices.
    normals : (V, 3) float32 or None
    uvs : (V, 2) float32 or None
    colors : (V, 4) uint8 or float32, or None
    corner_uvs : (T, 3, 2) float32 or None
        Take the place of ``uvs``.
    face_colors : (T, 4) uint8 or float32, or None
        Count only without ``colors``.
    lines : (L, 2) int or None
    position_ids : (V,) number or None
        Vertices with the same number are one point of the surface.
    edge_visible : (T, 3) bool or None
    """

    positions: np.ndarray
    corners: np.ndarray
    normals: np.ndarray | None = None
    uvs: np.ndarray | None = None
    colors: np.ndarray | None = None
    corner_uvs: np.ndarray | None = None
    face_colors: np.ndarray | None = None
    lines: np.ndarray | None = None
    position_ids: np.ndarray | None = None
    edge_visible: np.ndarray | None = None


def build_indexed_mesh(geometry: IndexedGeometry, name: str) -> Mesh:
    """Return the mesh; vertices alone are a point cloud."""
    corners, count = geometry.corners, len(geometry.positions)
    lines = np.zeros((0, 2), np.int32) if geometry.lines is None else geometry.lines
    if not len(corners) and not len(lines):
        return Mesh(
            geometry.positions,
            normals=geometry.normals,
            uvs=geometry.uvs,
            colors=geometry.colors,
            points=np.arange(count),
            name=name,
        )
    of_corner = _corner_attributes(geometry)
    faces, vertices, first_corner = _split(corners, of_corner, count)
    vertex_of, vertices, added = _vertices_for(lines.ravel(), vertices, count)
    positions, normals, uvs, colors = (
        array if array is None or vertices is _ALL else array[vertices]
        for array in (geometry.positions, geometry.normals, geometry.uvs, geometry.colors)
    )
    if "uvs" in of_corner:
        uvs = _padded(of_corner["uvs"][first_corner], added, 0)
    if "colors" in of_corner:
        white = 255 if of_corner["colors"].dtype == np.uint8 else 1
        colors = _padded(of_corner["colors"][first_corner], added, white)
    mesh = Mesh(
        positions,
        faces,
        normals=normals,
        uvs=uvs,
        colors=colors,
        lines=vertex_of.reshape(-1, 2),
        edge_visible=geometry.edge_visible,
        position_ids=_position_ids(geometry, vertices, bool(of_corner)),
        name=name,
    )
    if not mesh.has_normals and geometry.position_ids is None:
        join_seams(mesh)
    return mesh


def _position_ids(geometry: IndexedGeometry, vertices: np.ndarray, is_split: bool):
    """The points of the surface, numbered from 0 without gaps."""
    ids = geometry.position_ids
    if ids is None and not is_split:
        return None
    return np.unique(vertices if ids is None else ids[vertices], return_inverse=True)[1].reshape(-1)


def _corner_attributes(geometry: IndexedGeometry) -> dict[str, np.ndarray]:
    """Attributes of all corners (3T, ...) that may split vertices."""
    found = {}
    if geometry.corner_uvs is not None:
        found["uvs"] = geometry.corner_uvs.reshape(-1, 2)
    if geometry.face_colors is not None and geometry.colors is None:
        found["colors"] = np.repeat(geometry.face_colors, 3, axis=0)
    return found


def _split(corners: np.ndarray, of_corner: dict[str, np.ndarray], count: int):
    """Faces, the old vertex of each new one, and a corner that each new one stands at."""
    if not of_corner:
        is_used = native.used_or_all(np.ascontiguousarray(corners, np.int32).ravel(), count)
        if is_used is None:
            return corners, _ALL, None
        number = np.cumsum(is_used, dtype=np.int32) - 1
        return number[corners], np.flatnonzero(is_used), None
    keys = corners.ravel().astype(np.int64)
    for attribute in of_corner.values():
        number, first = number_rows(attribute)
        # Numbered anew each time, so that the product cannot overflow.
        _, keys = np.unique(keys * len(first) + number, return_inverse=True)
        keys = keys.reshape(-1)
    _, first, faces = np.unique(keys, return_index=True, return_inverse=True)
    return faces.reshape(-1, 3), corners.ravel()[first], first


def _vertices_for(used: np.ndarray, vertices: np.ndarray, count: int):
    """For each old vertex in use a new one, the list of new ones with those it lacked, how many."""
    if vertices is _ALL:
        return used, _ALL, 0
    vertex_of = np.full(count, -1, np.int32)
    vertex_of[vertices[::-1]] = np.arange(len(vertices), dtype=np.int32)[::-1]
    lacking = np.unique(used[vertex_of[used] < 0])
    vertex_of[lacking] = len(vertices) + np.arange(len(lacking), dtype=np.int32)
    return vertex_of[used], np.concatenate([vertices, lacking]), len(lacking)


def _padded(rows: np.ndarray, added: int, value) -> np.ndarray:
    """Rows with some more of one value at the end."""
    return np.concatenate([rows, np.full((added, *rows.shape[1:]), value, rows.dtype)])
