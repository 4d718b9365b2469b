"""The tri-meshes of a 3D Studio ASCII file: as parsed, and as objects of a `Document`."""

from __future__ import annotations

import re

import numpy as np

from ..._native import loaders as native
from ...model.geometry.groups import put_groups
from ...model.geometry.mesh import Mesh
from ...model.geometry.topology import polygon_ids
from ...model.materials.material import Material
from ..reading.corner_mesh import Geometry, Triangles, Vertices, build_mesh
from ..reading.documents import DocumentObject
from ..reading.far_coordinates import moved_near
from ..reading.smoothing import FLAT, fill_normals

# The form of most lines of a file, as native.FormReader reads it; it must match whole lines.
_VERTEX_FORM = b"Vertex #_:_X:%_Y:%_Z:%|_U:%_V:%"
_FACE_FORM = b"Face #_:_A:@_B:@_C:@|_AB:?_BC:?_CA:?"
_MARKS = (b"Material:", b"Smoothing:")
VERTICES, FACES, MATERIAL, SMOOTHING = range(4)
UNNAMED = -1
_COLOR_NAME = re.compile(r"r(\d{1,3})g(\d{1,3})b(\d{1,3})a(\d{1,3})", re.IGNORECASE)


class MeshRecord:
    """A tri-mesh as it is in the file.

    Attributes
    ----------
    name : str
    line : int
    vertex_count, face_count : int
        The announced numbers.
    is_mapped : bool
    rows : native.FormReader
        For vertices X, Y, Z, U and V; for faces A, B and C, and whether AB, BC and CA are visible.
    said : dict of int to ((N,) int64, (N,) int64)
        Face numbers, with material numbers or smoothing groups as bits.
    """

    def __init__(self, text: bytes, name: str, line: int, vertices: int, faces: int) -> None:
        self.name, self.line = name, line
        self.vertex_count, self.face_count = vertices, faces
        self.is_mapped = False
        self.rows = native.FormReader(
            text,
            (
                (_VERTEX_FORM, native.ROW, 5, vertices, 0.0, 0),
                (_FACE_FORM, native.ROW, 6, faces, 1.0, 0),
                *((mark, native.MARKED, 0, 0, 0.0, FACES) for mark in _MARKS),
            ),
        )
        nothing = np.zeros(0, np.int64), np.zeros(0, np.int64)
        self.said = {MATERIAL: nothing, SMOOTHING: nothing}

    def count(self, form: int) -> int:
        """Return the number of vertices or faces read."""
        return self.rows.count(form)[0]


def material_of(name: str) -> Material:
    """Return the material for a name, which may be a colour."""
    match = _COLOR_NAME.fullmatch(name)
    if match is None:
        return Material(name=name)
    color = tuple(min(int(match[k]), 255) / 255 for k in (1, 2, 3))
    return Material(name=name, color=tuple(round(c * 255) for c in color))


def object_of(record: MeshRecord, materials: list[Material], split: bool) -> DocumentObject:
    vertices, faces = record.rows.take_rows(VERTICES), record.rows.take_rows(FACES)
    positions, uvs = vertices[:, :3].copy(), vertices[:, 3:]
    positions, pose = moved_near(positions) if split else (positions, None)
    return DocumentObject(record.name, _mesh(record, materials, positions, uvs, faces), pose)


def _mesh(
    record: MeshRecord,
    materials: list[Material],
    positions: np.ndarray,
    uvs: np.ndarray,
    faces: np.ndarray,
) -> Mesh:
    corners, edge_visible = faces[:, :3].astype(np.int32), faces[:, 3:] != 0
    numbers = np.full(len(faces), UNNAMED, np.int64)
    given, named = record.said[MATERIAL]
    numbers[given] = named
    found, first, of_face = np.unique(numbers, return_index=True, return_inverse=True)
    order = np.argsort(first)
    triangles = Triangles(
        corners,
        corners if record.is_mapped else None,
        None,
        np.argsort(order).astype(np.int32)[of_face.reshape(-1)],
        polygon_ids(corners, edge_visible),
        None if edge_visible.all() else edge_visible,
    )
    masks = np.full(len(faces), FLAT, np.int64)
    np.bitwise_or.at(masks, *record.said[SMOOTHING])
    geometry = Geometry(
        Vertices(positions, None, uvs, np.zeros((0, 3))),
        triangles,
        _smooth(positions, triangles, masks),
        np.zeros((0, 2), np.int32),
        np.zeros(0, np.int32),
    )
    chosen = [materials[k] if k >= 0 else Material() for k in found[order].tolist()]
    mesh = build_mesh(geometry, chosen, record.name)
    put_groups(mesh, {record.name: np.arange(len(corners), dtype=np.int32)})
    return mesh


def _smooth(positions: np.ndarray, triangles: Triangles, masks: np.ndarray) -> np.ndarray | None:
    """Set a mesh's normals by smoothing groups; None leaves them to the mesh."""
    filled = fill_normals(
        positions,
        triangles.positions,
        None,
        np.zeros((0, 3)),
        masks,
        triangles.polygons,
        are_masks=True,
    )
    if filled is None:
        return None
    triangles.normals, normals = filled
    return normals
