"""Builds a mesh from faces whose corners index vertices.

In: vertices with their attributes, triangles of vertex indices, and attributes per corner (texture
coordinates) or per face (colours). Out: a `Mesh` whose vertices are split where their corners
differ; triangles keep their order. Unused vertices are dropped.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..._native import loaders as native
from ...model.geometry.creases import CREASE_ANGLE, SMOOTH
from ...model.geometry.mesh import Mesh
from ...model.geometry.values import OF_FACES, Values, check_values, put_values
from ...model.geometry.vertex_attributes import vertex_attributes
from ...model.materials.linear_colors import floats_are_linear
from .smoothing import join_seams
from .welding import number_rows

_NO_CORNERS = np.zeros(0, np.intp)


@dataclass
class IndexedGeometry:
    """The data of a mesh.

    Attributes
    ----------
    positions : (V, 3) float
    corners : (T, 3) int
        Vertex indices.
    normals : (V, 3) float32 or None
    uvs : (V, 2) float32 or None
    uvs1 : (V, 2) float32 or None
    tangents : (V, 4) float32 or None
    colors : (V, 4) uint8 or float32, or None
    corner_uvs : (T, 3, 2) float32 or None
        Replace ``uvs``.
    corner_colors : (T, 3, 4) uint8 or None
        Replace ``colors`` and ``face_colors``.
    face_colors : (T, 4) uint8 or float32, or None
        Used only without ``colors``.
    lines : (L, 2) int or None
    position_ids : (V,) number or None
        Vertices with the same number are one point of the surface.
    edge_visible : (T, 3) bool or None
    values : dict of str to (V,) or (V, N) number
        Numbers of the vertices, by name.
    face_values : dict of str to (T,) or (T, N) number
        Numbers of the faces, by name; a name that the vertices have too gets `OF_FACES`.
    crease_angle : float
        Radians, for computed normals.
    """

    positions: np.ndarray
    corners: np.ndarray
    normals: np.ndarray | None = None
    uvs: np.ndarray | None = None
    uvs1: np.ndarray | None = None
    tangents: np.ndarray | None = None
    colors: np.ndarray | None = None
    corner_uvs: np.ndarray | None = None
    corner_colors: np.ndarray | None = None
    face_colors: np.ndarray | None = None
    lines: np.ndarray | None = None
    position_ids: np.ndarray | None = None
    edge_visible: np.ndarray | None = None
    values: dict[str, np.ndarray] = field(default_factory=dict)
    face_values: dict[str, np.ndarray] = field(default_factory=dict)
    crease_angle: float = CREASE_ANGLE


def build_indexed_mesh(geometry: IndexedGeometry, name: str) -> Mesh:
    """Return the mesh; vertices without elements become a point cloud."""
    corners, count = geometry.corners, len(geometry.positions)
    lines = np.zeros((0, 2), np.int32) if geometry.lines is None else geometry.lines
    if not len(corners) and not len(lines):
        with floats_are_linear():
            cloud = Mesh(
                geometry.positions,
                points=np.arange(count),
                crease_angle=SMOOTH,
                name=name,
                **_chosen(geometry, None),
            )
        _put_values(cloud, geometry, None)
        return cloud
    of_corner = _corner_attributes(geometry)
    faces, vertices, first_corner = _split(corners, list(of_corner.values()), count)
    vertex_of, vertices, added = _vertices_for(lines.ravel(), vertices, count)
    attributes = _chosen(geometry, vertices)
    for attribute, rows in of_corner.items():
        filler = vertex_attributes(Mesh)[attribute].filler(added, rows)
        attributes[attribute] = np.concatenate([rows[first_corner], filler])
    with floats_are_linear():
        mesh = Mesh(
            _rows(geometry.positions, vertices),
            faces,
            lines=vertex_of.reshape(-1, 2),
            edge_visible=geometry.edge_visible,
            position_ids=_position_ids(geometry, vertices, bool(of_corner)),
            crease_angle=SMOOTH if geometry.normals is not None else geometry.crease_angle,
            name=name,
            **attributes,
        )
    _put_values(mesh, geometry, vertices)
    if not mesh.has_normals and geometry.position_ids is None:
        join_seams(mesh)
    return mesh


def _put_values(mesh: Mesh, geometry: IndexedGeometry, vertices: np.ndarray | None) -> None:
    """Give a mesh the numbers of its vertices and faces."""
    values = {
        name: Values(_rows(array, vertices), "vertices") for name, array in geometry.values.items()
    }
    for name, array in geometry.face_values.items():
        values[name + OF_FACES if name in values else name] = Values(array, "faces")
    put_values(mesh, check_values(mesh, values))


def _chosen(geometry: IndexedGeometry, vertices: np.ndarray | None) -> dict[str, np.ndarray]:
    """Return some vertices' attributes besides positions, as parameters of a mesh."""
    given = {name: getattr(geometry, name) for name in ("normals", *vertex_attributes(Mesh))}
    return {name: _rows(array, vertices) for name, array in given.items() if array is not None}


def _rows(array: np.ndarray, vertices: np.ndarray | None) -> np.ndarray:
    return array if vertices is None else array[vertices]


def _position_ids(
    geometry: IndexedGeometry, vertices: np.ndarray | None, is_split: bool
) -> np.ndarray | None:
    """Return the points of the surface, numbered from 0 without gaps."""
    given = geometry.position_ids
    if given is None:
        ids = vertices if is_split else None
    else:
        ids = _rows(given, vertices)
    return None if ids is None else np.unique(ids, return_inverse=True)[1].reshape(-1)


def _corner_attributes(geometry: IndexedGeometry) -> dict[str, np.ndarray]:
    """Return the attributes of all corners (3T, ...) that may split vertices."""
    found = {}
    if geometry.corner_uvs is not None:
        found["uvs"] = geometry.corner_uvs.reshape(-1, 2)
    if geometry.corner_colors is not None:
        found["colors"] = geometry.corner_colors.reshape(-1, 4)
    elif geometry.face_colors is not None and geometry.colors is None:
        found["colors"] = np.repeat(geometry.face_colors, 3, axis=0)
    return found


def _split(
    corners: np.ndarray, splitting: list[np.ndarray], count: int
) -> tuple[np.ndarray, np.ndarray | None, np.ndarray]:
    """Return faces, the old vertex of each new one, and a corner of each new one.

    None means all vertices unchanged; without splits there are no corners.
    """
    if not splitting:
        is_used = native.used_or_all(np.ascontiguousarray(corners, np.int32).ravel(), count)
        if is_used is None:
            return corners, None, _NO_CORNERS
        number = np.cumsum(is_used, dtype=np.int32) - 1
        return number[corners], np.flatnonzero(is_used), _NO_CORNERS
    keys = corners.ravel().astype(np.int64)
    for attribute in splitting:
        number, first = number_rows(attribute)
        # Renumbered each time, so that the product cannot overflow.
        _, keys = np.unique(keys * len(first) + number, return_inverse=True)
        keys = keys.reshape(-1)
    _, first, faces = np.unique(keys, return_index=True, return_inverse=True)
    return faces.reshape(-1, 3), corners.ravel()[first], first


def _vertices_for(
    used: np.ndarray, vertices: np.ndarray | None, count: int
) -> tuple[np.ndarray, np.ndarray | None, int]:
    """Return each used old vertex's new one, the extended list, and its length."""
    if vertices is None:
        return used, None, 0
    vertex_of = np.full(count, -1, np.int32)
    vertex_of[vertices[::-1]] = np.arange(len(vertices), dtype=np.int32)[::-1]
    lacking = np.unique(used[vertex_of[used] < 0])
    vertex_of[lacking] = len(vertices) + np.arange(len(lacking), dtype=np.int32)
    return vertex_of[used], np.concatenate([vertices, lacking]), len(lacking)
