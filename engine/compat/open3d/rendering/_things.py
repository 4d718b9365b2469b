"""What an offscreen scene holds of each geometry: a mesh of the engine, as it was when added.

In: geometries and material records of Open3D. Out: meshes. Colours of vertices are linear light,
as Filament takes them; what has none is mid-grey.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from ....base.numbers import shown
from ....errors import InvalidArgumentError, warn
from ....io.scenes.open3d_materials import material_of_record
from ....io.scenes.open3d_scenes import (
    legacy_of,
    octree_cells,
    require_indices,
    scene_from_open3d,
)
from ....io.scenes.voxel_faces import cube_faces
from ....model.geometry.mesh import Mesh
from ....model.materials.linear_colors import linear
from ....model.materials.material import Material
from .._loading import load

_GREY = 0.5
_PADDING = 0.1  # of the boxes of flat clouds, as in Open3D
#: Shaders drawn from depths or normals instead of a material.
BY_DEPTH = ("depth", "depthValue")
_KNOWN = (
    *("defaultLit", "defaultLitTransparency", "defaultLitSSR", "defaultUnlit"),
    *("defaultUnlitTransparency", "unlitSolidColor", "unlitLine", "normals", *BY_DEPTH),
)
_WITHOUT_COLORS = ("unlitSolidColor", "normals", *BY_DEPTH)


@dataclass
class Thing:
    """A geometry of a scene.

    Attributes
    ----------
    arrays : Arrays
    record : MaterialRecord
    box : open3d.geometry.AxisAlignedBoundingBox
        In object space.
    mesh : Mesh
    pose : (4, 4) float64
    is_visible, casts_shadows, receives_shadows : bool
    planes : (float, float)
        Near and far planes when the material was set: what the shader ``depth`` draws by.
    priority : int
    """

    arrays: Arrays
    record: Any
    box: Any
    mesh: Mesh
    pose: NDArray[np.float64]
    planes: tuple[float, float]
    is_visible: bool = True
    casts_shadows: bool = True
    receives_shadows: bool = True

    @property
    def size(self) -> tuple[float, float]:
        """The size of its points in pixels, and ``line_width`` of wide lines; 0 of thin ones."""
        is_wide = self.record.shader == "unlitLine"
        return float(self.record.point_size), float(self.record.line_width) if is_wide else 0.0

    def dress(self, record: Any, planes: tuple[float, float]) -> None:
        """Take another material."""
        _require_record(record)
        self.record, self.planes = record, planes
        self.mesh = _mesh(self.arrays, record)


@dataclass
class Arrays:
    """The arrays of a geometry; ``colors`` (V, 3) as given, ``kind`` one of the three.

    Attributes
    ----------
    kind : {"faces", "lines", "points"}
    positions : (V, 3)
    elements : (F, 3), (L, 2) or (P,) int
    colors, normals, uvs : (V, …) or None
    """

    kind: str
    positions: NDArray[Any]
    elements: NDArray[Any]
    colors: NDArray[Any] | None = None
    normals: NDArray[Any] | None = None
    uvs: NDArray[Any] | None = None


def thing_of(geometry: Any, record: Any, planes: tuple[float, float]) -> Thing | None:
    """Return a geometry as a thing; None for what Filament does not draw either."""
    geometry = legacy_of(geometry)
    if not hasattr(geometry, "is_empty"):
        raise InvalidArgumentError(f"a geometry of Open3D is needed, not {type(geometry).__name__}")
    _require_record(record)
    if geometry.is_empty():
        return None
    arrays = _arrays(geometry)
    if arrays is None:
        return None
    if record.shader == "defaultLit" and arrays.kind == "faces" and arrays.normals is None:
        warn("a shader with lighting is used, but the geometry has no normals")
    box = geometry.get_axis_aligned_bounding_box()
    if arrays.kind == "points" and box.is_empty():
        box = type(box)(np.asarray(box.min_bound) - _PADDING, np.asarray(box.max_bound) + _PADDING)
    return Thing(arrays, record, box, _mesh(arrays, record), np.eye(4), planes)


def _require_record(record: Any) -> None:
    if not hasattr(record, "shader"):
        raise InvalidArgumentError(f"material must be a MaterialRecord, not {shown(record)}")


def _arrays(geometry: Any) -> Arrays | None:
    kinds = [kind.__name__ for kind in type(geometry).__mro__]
    if "TriangleMesh" in kinds:
        return _of_triangles(geometry)
    if "PointCloud" in kinds:
        points = np.array(geometry.points)
        colors = np.array(geometry.colors) if geometry.has_colors() else None
        normals = np.array(geometry.normals) if geometry.has_normals() else None
        return Arrays("points", points, np.arange(len(points)), colors, normals)
    if "AxisAlignedBoundingBox" in kinds or "OrientedBoundingBox" in kinds:
        lines = load().geometry.LineSet
        color, is_turned = np.array(geometry.color), "OrientedBoundingBox" in kinds
        make = lines.create_from_oriented_bounding_box if is_turned else None
        geometry = (make or lines.create_from_axis_aligned_bounding_box)(geometry)
        geometry.paint_uniform_color(color)
        kinds.append("LineSet")
    if "TetraMesh" in kinds:
        return None
    if "LineSet" in kinds:
        ends = np.asarray(geometry.lines).reshape(-1)
        require_indices(ends, len(geometry.points), "lines")
        colors = np.ones((len(ends), 3))
        if geometry.has_colors():
            colors = np.repeat(np.asarray(geometry.colors), 2, axis=0)
        lines = np.arange(len(ends)).reshape(-1, 2)
        return Arrays("lines", np.asarray(geometry.points)[ends], lines, colors)
    if "Octree" in kinds:
        origins, sizes, colors, is_leaf = octree_cells(geometry)
        corners, faces = cube_faces(origins[is_leaf], sizes[is_leaf])
        return Arrays("faces", corners, faces, np.repeat(colors[is_leaf], 8, axis=0))
    if "VoxelGrid" in kinds:
        scene = scene_from_open3d(geometry)
        mesh = next(iter(scene.nodes)).object
        colors = None if mesh.colors is None else _displayed(mesh)
        return Arrays("faces", mesh.positions, mesh.faces, colors)
    return None


def _displayed(mesh: Mesh) -> NDArray[np.float64]:
    from ....model.materials.colors import srgb_bytes

    return srgb_bytes(mesh.colors)[:, :3] / 255.0


def _of_triangles(geometry: Any) -> Arrays:
    positions, faces = np.array(geometry.vertices), np.array(geometry.triangles)
    require_indices(faces, len(positions), "triangles")
    colors = np.array(geometry.vertex_colors) if geometry.has_vertex_colors() else None
    normals = np.array(geometry.vertex_normals) if geometry.has_vertex_normals() else None
    if not geometry.has_triangle_uvs():
        return Arrays("faces", positions, faces, colors, normals)
    corners = faces.reshape(-1)
    taken = [None if rows is None else rows[corners] for rows in (colors, normals)]
    split = np.arange(len(corners)).reshape(-1, 3)
    return Arrays("faces", positions[corners], split, *taken, np.array(geometry.triangle_uvs))


def _mesh(arrays: Arrays, record: Any) -> Mesh:
    """Return the mesh of arrays in a material."""
    if record.shader not in _KNOWN:
        warn(f"the shader {record.shader} is drawn as defaultUnlit")
    material = material_of_record(record)
    normals = arrays.normals
    if normals is None and arrays.kind == "faces":
        normals = np.broadcast_to((0.0, 0.0, 1.0), arrays.positions.shape)  # as Filament has it
    given: dict[str, Any] = {}
    if record.shader == "normals":
        material = Material(unlit=True, two_sided=True)
    elif record.shader in _WITHOUT_COLORS:
        material.texture = None
    else:
        given["colors"] = _colors(arrays, record)
    if arrays.kind != "faces":
        material.unlit = material.unlit or normals is None
        return Mesh(
            arrays.positions,
            normals=normals,
            materials=[material],
            **{arrays.kind: arrays.elements},
            **given,
        )
    return Mesh(
        arrays.positions,
        arrays.elements,
        normals=normals,
        uvs=arrays.uvs,
        materials=[material],
        **given,
    )


def _colors(arrays: Arrays, record: Any) -> NDArray[Any]:
    if arrays.colors is None:
        return linear(np.full(arrays.positions.shape, _GREY))
    colors = np.clip(np.nan_to_num(arrays.colors), 0.0, 1.0)
    return colors if record.sRGB_color else linear(colors)


def normal_colors(thing: Thing) -> NDArray[Any]:
    """Return the colours of the shader ``normals``: world normals as linear light."""
    normals = thing.arrays.normals
    if normals is None:
        normals = np.broadcast_to((0.0, 0.0, 1.0), thing.arrays.positions.shape)
    turned = _turned(linalg.normal_matrix(thing.pose), normals)
    return linear(np.clip(turned * 0.5 + 0.5, 0.0, 1.0))


def _turned(matrix: NDArray[np.float64], normals: NDArray[Any]) -> NDArray[np.float64]:
    return sum(normals[:, axis, np.newaxis] * matrix[:, axis] for axis in range(3))
