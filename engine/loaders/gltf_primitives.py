"""Triangles, lines and points of a glTF file.

In: a primitive of a mesh. Out: a `Mesh`, or None for what has no positions.
"""

from __future__ import annotations

import numpy as np

from ..geometry.mesh import Mesh
from ..geometry.vertex_attributes import vertex_attributes
from .gltf_buffers import GltfBuffers
from .gltf_file import GltfFile
from .gltf_materials import GltfMaterials
from .indexed_mesh import IndexedGeometry, build_indexed_mesh
from .vertex_values import finite_uvs, usable_normals

_POINTS, _LINES, _LOOP, _LINE_STRIP, _TRIANGLES, _STRIP, _FAN = range(7)
_DRACO = "KHR_draco_mesh_compression"


class GltfPrimitives:
    """Makes the meshes of a file.

    Parameters
    ----------
    file : GltfFile
    buffers : GltfBuffers
    materials : GltfMaterials

    Attributes
    ----------
    left_out : list of str
        Places of the primitives that have no positions.
    """

    def __init__(self, file: GltfFile, buffers: GltfBuffers, materials: GltfMaterials) -> None:
        self._file, self._buffers, self._materials = file, buffers, materials
        self.left_out: list[str] = []

    def read(self, primitive: dict, where: str, name: str) -> Mesh | None:
        """Return the mesh of a primitive, which ``where`` names in errors."""
        attributes = self._file.part(primitive, "attributes", where)
        if "POSITION" not in attributes:
            self.left_out.append(where)
            return None
        self._check_compression(primitive, attributes["POSITION"], where)
        positions = self._buffers.floats(attributes["POSITION"], where, 3)
        corners = self._corners(primitive, len(positions), where)
        mode = self._file.whole(primitive, "mode", where, _TRIANGLES)
        if mode > _FAN:
            raise self._file.error(f"damaged: {where}.mode is {mode}")
        geometry = IndexedGeometry(positions, _triangles(corners, mode))
        if mode in (_LINES, _LOOP, _LINE_STRIP):
            geometry.lines = _segments(corners, mode)
        material = primitive.get("material")
        self._add_attributes(geometry, attributes, material, where)
        if mode == _POINTS and "indices" in primitive:
            _keep(geometry, corners)
        mesh = build_indexed_mesh(geometry, name)
        is_flat = geometry.normals is None and len(geometry.corners) > 0
        mesh.materials = [self._materials.get(material, where, flat=is_flat)]
        return mesh

    def _check_compression(self, primitive: dict, positions, where: str) -> None:
        """Positions that are only in Draco's bytes would be zeros."""
        if _DRACO not in self._file.part(primitive, "extensions", where):
            return
        if "bufferView" not in self._file.entry("accessors", positions, where):
            raise self._file.error(f"{where} is compressed by {_DRACO}, which is not read")

    def _corners(self, primitive: dict, count: int, where: str) -> np.ndarray:
        """The vertices (C,) that the primitive's elements name one after the other."""
        if "indices" not in primitive:
            return np.arange(count)
        corners = self._buffers.indices(primitive["indices"], where)
        if int(corners.max()) >= count:
            raise self._file.error(
                f"damaged: {where} names vertex {corners.max()}, there are {count}"
            )
        return corners

    def _add_attributes(self, geometry: IndexedGeometry, attributes: dict, material, where) -> None:
        count = len(geometry.positions)
        uv_set, transform = self._materials.coordinates(material, where)
        normals = self._attribute(attributes, "NORMAL", count, where, 3)
        geometry.normals = usable_normals(normals, geometry.positions, geometry.corners)
        colors = self._attribute(attributes, "COLOR_0", count, where, 3, 4)
        if colors is not None:
            colors = np.nan_to_num(colors).clip(0, 1)
            opaque = np.ones((count, 4 - colors.shape[1]), np.float32)
            geometry.colors = np.concatenate([colors, opaque], axis=1)
        uvs = self._attribute(attributes, f"TEXCOORD_{uv_set}", count, where, 2)
        if uvs is not None:
            u, v = uvs.astype(np.float64).T
            u, v = (row[0] * u + row[1] * v + row[2] for row in transform)
            geometry.uvs = finite_uvs(np.stack([u, 1.0 - v], axis=1))

    def _attribute(self, attributes: dict, name: str, count: int, where: str, *widths: int):
        if name not in attributes:
            return None
        values = self._buffers.floats(attributes[name], f"{where} ({name})", *widths)
        if len(values) != count:
            raise self._file.error(
                f"damaged: {where} has {len(values)} {name} for {count} positions"
            )
        return values


def _keep(geometry: IndexedGeometry, chosen: np.ndarray) -> None:
    """Leave only some vertices, in this order."""
    for name in ("positions", "normals", *vertex_attributes(Mesh)):
        array = getattr(geometry, name)
        if array is not None:
            setattr(geometry, name, array[chosen])


def _triangles(corners: np.ndarray, mode: int) -> np.ndarray:
    """Triangles (T, 3); corners that are too few for a last one are left out."""
    if mode == _TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if mode not in (_STRIP, _FAN) or len(corners) < 3:
        return np.zeros((0, 3), np.int64)
    first = np.arange(len(corners) - 2)
    if mode == _FAN:
        return corners[np.stack([first + 1, first + 2, np.zeros_like(first)], axis=1)]
    odd = first % 2
    return corners[np.stack([first, first + 1 + odd, first + 2 - odd], axis=1)]


def _segments(corners: np.ndarray, mode: int) -> np.ndarray:
    """Segments (L, 2)."""
    if mode == _LINES:
        return corners[: len(corners) // 2 * 2].reshape(-1, 2)
    ends = np.roll(corners, -1)
    segments = np.stack([corners, ends], axis=1)
    return segments if mode == _LOOP else segments[:-1]
