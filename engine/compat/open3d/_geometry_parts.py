"""What a `Visualizer` draws of geometries: copies of their arrays, as Open3D hands them to OpenGL.

In: geometries of Open3D, options. Out: parts: a mesh of the engine, and what its light depends on.
The choices are those of Open3D's GeometryRenderer.cpp and of its shaders.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...io.scenes.open3d_materials import bytes_of_image
from ...io.scenes.open3d_scenes import octree_cells, require_indices, voxel_points
from ...io.scenes.voxel_faces import CORNERS, CUBE_EDGES, cube_faces, outer_faces
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ._color_maps import map_colors
from ._loading import load

_TETRA_EDGES = np.array([(0, 1), (1, 2), (2, 0), (3, 0), (3, 1), (3, 2)])
#: The colour of wires and of points' normals.
WIRE = 0.1


@dataclass
class Surface:
    """What the light of faces depends on.

    Attributes
    ----------
    positions : (V, 3) float64
    faces : (F, 3) int
    normals : (F, 3) or (V, 3) float64, or None
        Of the faces, or of the vertices if `is_smooth`; None is unlit.
    is_smooth : bool
    colors : (V, 3) float64
    shows_normals : bool
        Whether normals show as colours, without light.
    uvs : (F, 3, 2) float64 or None
    textures : list of (H, W, C) uint8
    texture_ids : (F,) int
    """

    positions: NDArray[np.float64]
    faces: NDArray[Any]
    normals: NDArray[np.float64] | None
    is_smooth: bool
    colors: NDArray[np.float64]
    shows_normals: bool = False
    uvs: NDArray[np.float64] | None = None
    textures: list[NDArray[np.uint8]] = field(default_factory=list)
    texture_ids: NDArray[Any] | None = None

    @property
    def is_plain(self) -> bool:
        """Whether vertex colours show as they are."""
        return self.normals is None and self.uvs is None


@dataclass
class Cloud:
    """What the light of points depends on: places, normals and colours, each (N, 3) float64."""

    positions: NDArray[np.float64]
    normals: NDArray[np.float64]
    colors: NDArray[np.float64]
    shows_normals: bool


@dataclass
class Part:
    """Faces, lines or points that are drawn together.

    Attributes
    ----------
    mesh : Mesh
    surface : Surface or None
        Of faces that are not plain.
    cloud : Cloud or None
        Of points with light.
    has_wires : bool
        Whether the edges of its faces show with ``mesh_show_wireframe``.
    """

    mesh: Mesh
    surface: Surface | None = None
    cloud: Cloud | None = None
    has_wires: bool = False


def parts_of(geometry: Any, option: Any, box: Any) -> list[Part]:
    """Return the parts of a geometry, with the colours that options give it now.

    Parameters
    ----------
    geometry : open3d.geometry.Geometry
    option : RenderOption
    box : open3d.geometry.AxisAlignedBoundingBox
        Of all that is shown, to which colours of coordinates refer.
    """
    return [] if geometry.is_empty() else list(_PARTS[kind_of(geometry)](geometry, option, box))


def kind_of(geometry: Any) -> str | None:
    """Return the name of the class that a geometry is drawn as; None for what is not drawn."""
    return next((kind.__name__ for kind in type(geometry).__mro__ if kind.__name__ in _PARTS), None)


def _coordinate_colors(points, choice: str, box):
    """Return colours by a coordinate, or None if the choice names none."""
    axes = {"XCoordinate": 0, "YCoordinate": 1, "ZCoordinate": 2}
    if choice not in axes:
        return None
    axis = axes[choice]
    low, high = np.asarray(box.min_bound)[axis], np.asarray(box.max_bound)[axis]
    with np.errstate(divide="ignore", invalid="ignore"):
        return map_colors((points[:, axis] - low) / (high - low))


def _faces_part(surface: Surface, *, has_wires: bool) -> Part:
    colors = _shown(surface.colors) if surface.is_plain else None
    mesh = Mesh(
        surface.positions,
        surface.faces,
        colors=colors,
        materials=[Material(two_sided=not has_wires)],
    )
    return Part(mesh, None if surface.is_plain else surface, has_wires=has_wires)


def _lines_part(points, lines, colors) -> Part:
    """Return the part of segments: ``colors`` is a row for each, or for all."""
    ends = np.asarray(lines).reshape(-1)
    require_indices(ends, len(points), "lines")
    each = np.broadcast_to(colors, (len(lines), 3))
    mesh = Mesh(
        points[ends],
        lines=np.arange(len(ends)).reshape(-1, 2),
        colors=_shown(np.repeat(each, 2, axis=0)),
    )
    return Part(mesh)


def _of_triangles(mesh, option, box) -> Iterator[Part]:
    faces, positions = np.array(mesh.triangles), np.array(mesh.vertices)
    if not len(faces):
        return
    require_indices(faces, len(positions), "triangles")
    choice = option.mesh_color_option.name
    is_lit = mesh.has_triangle_normals() and mesh.has_vertex_normals()
    is_smooth = option.mesh_shade_option.name == "Color"  # Open3D's name for smooth
    normals = None
    if is_lit:
        normals = np.array(mesh.vertex_normals if is_smooth else mesh.triangle_normals)
    colors = _coordinate_colors(positions, choice, box)
    if colors is None and choice == "Color" and mesh.has_vertex_colors():
        colors = np.array(mesh.vertex_colors)
    if colors is None:
        colors = np.broadcast_to(option.default_mesh_color, positions.shape)
    surface = Surface(positions, faces, normals, is_smooth, colors)
    surface.shows_normals = is_lit and choice == "Normal"
    if choice == "Color" and mesh.has_triangle_uvs() and mesh.has_textures():
        surface.uvs = np.array(mesh.triangle_uvs).reshape(-1, 3, 2)
        surface.textures = [bytes_of_image(image) for image in mesh.textures]
        ids = np.array(mesh.triangle_material_ids)
        surface.texture_ids = ids if len(ids) == len(faces) else np.zeros(len(faces), int)
    yield _faces_part(surface, has_wires=True)


def _of_points(cloud, option, box) -> Iterator[Part]:
    points, choice = np.array(cloud.points), option.point_color_option.name
    colors = _coordinate_colors(points, choice, box)
    if colors is None:
        has_colors = cloud.has_colors()
        colors = np.array(cloud.colors) if has_colors else None
    if colors is None:
        colors = _coordinate_colors(points, "ZCoordinate", box)
    mesh = Mesh(points, points=np.arange(len(points)), colors=_shown(colors))
    if not cloud.has_normals():
        yield Part(mesh)
        return
    normals = np.array(cloud.normals)
    yield Part(mesh, cloud=Cloud(points, normals, colors, choice == "Normal"))
    if option.point_show_normal:
        ends = points + normals * (option.point_size * 0.01 * box.get_max_extent())
        both = np.concatenate([points, ends])
        numbers = np.arange(len(points))
        lines = np.stack([numbers, numbers + len(points)], axis=1)
        yield _lines_part(both, lines, np.full(3, WIRE))


def _of_lines(lineset, option, box) -> Iterator[Part]:
    lines = np.asarray(lineset.lines)
    if len(lines):
        has_colors = lineset.has_colors()
        colors = np.array(lineset.colors) if has_colors else np.zeros(3)
        yield _lines_part(np.asarray(lineset.points), lines, colors)


def _of_aligned_box(box_geometry, option, box) -> Iterator[Part]:
    lines = load().geometry.LineSet.create_from_axis_aligned_bounding_box(box_geometry)
    yield from _of_lines(lines, option, box)


def _of_turned_box(box_geometry, option, box) -> Iterator[Part]:
    lines = load().geometry.LineSet.create_from_oriented_bounding_box(box_geometry)
    yield from _of_lines(lines, option, box)


def _of_tetrahedra(mesh, option, box) -> Iterator[Part]:
    edges = np.asarray(mesh.tetras)[:, _TETRA_EDGES].reshape(-1, 2)
    if len(edges):
        lines = np.unique(np.sort(edges, axis=1), axis=0)
        yield _lines_part(np.asarray(mesh.vertices), lines, np.zeros(3))


def _cell_colors(origins, own, option, box):
    """Return the colours of cubes: by coordinates, their own, or the default."""
    choice = option.mesh_color_option.name
    colors = _coordinate_colors(origins, choice, box)
    if colors is None and choice == "Color":
        colors = own
    return np.broadcast_to(option.default_mesh_color, origins.shape) if colors is None else colors


def _of_voxels(grid, option, box) -> Iterator[Part]:
    voxels = grid.get_voxels()
    cells = np.array([voxel.grid_index for voxel in voxels], np.int64).reshape(-1, 3)
    own = np.array([voxel.color for voxel in voxels]) if grid.has_colors() else None
    colors = _cell_colors(voxel_points(grid, cells), own, option, box)
    if option.mesh_show_wireframe:
        corners = (cells[:, np.newaxis] + CORNERS).reshape(-1, 3)
        lines = 8 * np.arange(len(cells))[:, np.newaxis, np.newaxis] + CUBE_EDGES
        each = np.repeat(colors, len(CUBE_EDGES), axis=0)
        yield _lines_part(voxel_points(grid, corners), lines.reshape(-1, 2), each)
        return
    corners, faces, owners = outer_faces(cells)
    surface = Surface(voxel_points(grid, corners), faces, None, False, colors[owners])
    yield _faces_part(surface, has_wires=False)


def _of_octree(tree, option, box) -> Iterator[Part]:
    origins, sizes, own, is_leaf = octree_cells(tree)
    colors = _cell_colors(origins, own, option, box)
    if not option.mesh_show_wireframe:
        corners, faces = cube_faces(origins[is_leaf], sizes[is_leaf])
        each = np.repeat(colors[is_leaf], 8, axis=0)
        yield _faces_part(Surface(corners, faces, None, False, each), has_wires=False)
    ends, _ = cube_faces(origins, sizes)
    lines = 8 * np.arange(len(origins))[:, np.newaxis, np.newaxis] + CUBE_EDGES
    yield _lines_part(ends, lines.reshape(-1, 2), np.repeat(own, len(CUBE_EDGES), axis=0))


def _shown(colors):
    """Return colours as Open3D's frame buffer holds them: from 0 to 1, as they are."""
    return linear(np.clip(np.nan_to_num(np.asarray(colors, np.float32)), 0.0, 1.0))


_PARTS: dict[str, Callable[..., Iterator[Part]]] = {
    "TriangleMesh": _of_triangles,
    "HalfEdgeTriangleMesh": _of_triangles,
    "PointCloud": _of_points,
    "LineSet": _of_lines,
    "AxisAlignedBoundingBox": _of_aligned_box,
    "OrientedBoundingBox": _of_turned_box,
    "TetraMesh": _of_tetrahedra,
    "VoxelGrid": _of_voxels,
    "Octree": _of_octree,
}
