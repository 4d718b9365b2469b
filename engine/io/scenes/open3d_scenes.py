"""Converts geometries of Open3D for drawing.

In: a triangle mesh, point cloud, line set, box, voxel grid, octree or tetrahedral mesh, of
``open3d.geometry`` or ``open3d.t.geometry``; or a model of several meshes. Out: a `Scene`. The axes
stay. Colours are display values on both sides; meshes without vertex normals get normals of their
own, sharp at edges.
"""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InvalidArgumentError
from ...model.geometry.creases import CREASE_ANGLE
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.scene.scene import Scene
from .meshio_scenes import scene_from_meshio
from .open3d_materials import bytes_of_image, material_of_record, record_of_tensor
from .voxel_faces import CUBE_EDGES, cube_faces, outer_faces

#: The lines of boxes, as rows of their ``get_box_points()``.
_BOX_LINES = np.array(
    [
        *((0, 1), (1, 7), (7, 2), (2, 0), (3, 6), (6, 4)),
        *((4, 5), (5, 3), (0, 3), (1, 6), (7, 4), (2, 5)),
    ],
    np.int32,
)


def scene_from_open3d(thing: Any) -> Scene | None:
    """Return a scene converted from a geometry of Open3D; None for its other objects.

    Raises
    ------
    InvalidArgumentError
        An index is out of range, or numbers of attributes do not fit.
    """
    if hasattr(thing, "meshes") and hasattr(thing, "materials"):
        return _scene_of_model(thing)
    record = record_of_tensor(thing)
    thing = legacy_of(thing)
    kind = next((one.__name__ for one in type(thing).__mro__ if one.__name__ in _MESHES), None)
    if kind is None:
        return None
    made = _MESHES[kind](thing)
    if made is None:
        return None
    if record is not None and kind == "TriangleMesh":
        made.materials = [material_of_record(record)]
    scene = Scene()
    scene.add(made, name=type(thing).__name__)
    return scene


def legacy_of(geometry: Any) -> Any:
    """Return a geometry of ``open3d.t`` as one of ``open3d``, now; others as they are."""
    return geometry.to_legacy() if hasattr(geometry, "to_legacy") else geometry


def _scene_of_model(model: Any) -> Scene:
    scene = Scene()
    for part in model.meshes:
        mesh = mesh_of_triangles(part.mesh)
        mesh.material_ids = np.zeros(len(mesh.faces), np.int32)
        mesh.materials = [material_of_record(model.materials[part.material_idx])]
        scene.add(mesh, name=part.mesh_name)
    return scene


def mesh_of_triangles(geometry: Any) -> Mesh:
    """Return the mesh of an ``open3d.geometry.TriangleMesh``, with its colours and textures."""
    positions, faces = np.asarray(geometry.vertices), np.asarray(geometry.triangles)
    require_indices(faces, len(positions), "triangles")
    given: dict[str, Any] = {}
    if len(normals := np.asarray(geometry.vertex_normals)) == len(positions):
        given["normals"] = normals
    if len(colors := np.asarray(geometry.vertex_colors)) == len(positions) and len(colors):
        given["colors"] = _displayed(colors)
    uvs = np.asarray(geometry.triangle_uvs)
    if len(uvs) == 3 * len(faces) and len(faces):
        corners = faces.reshape(-1)
        given = {name: array[corners] for name, array in given.items()}
        given |= {"uvs": uvs, "position_ids": corners}
        positions, faces = positions[corners], np.arange(len(corners)).reshape(-1, 3)
    mesh = Mesh(positions, faces, crease_angle=CREASE_ANGLE, **given)
    if "uvs" in given and not all(image.is_empty() for image in geometry.textures):
        _dress(mesh, geometry)
    return mesh


def _dress(mesh: Mesh, geometry: Any) -> None:
    """Give the faces of a mesh its textures, which replace its vertex colours as in Open3D.

    Materials of files that have no image are empty ones, which count.
    """
    images = list(geometry.textures)
    ids = np.asarray(geometry.triangle_material_ids)
    if len(ids) != len(mesh.faces):
        first = next(number for number, image in enumerate(images) if not image.is_empty())
        ids = np.full(len(mesh.faces), first, np.int32)
    if ids.min() < 0 or ids.max() >= len(images):
        raise InvalidArgumentError(
            f"triangle_material_ids must be in 0..{len(images) - 1}, as there are {len(images)} "
            f"textures: found {ids.min()}..{ids.max()}"
        )
    mesh.colors = None
    mesh.materials = [
        Material() if image.is_empty() else Material(texture=_texture(image)) for image in images
    ]
    mesh.material_ids = ids


def _texture(image: Any) -> Texture:
    """Return a texture of an image of a mesh, whose first row lies at v = 0."""
    return Texture(bytes_of_image(image)[::-1])


def _mesh_of_points(geometry: Any) -> Mesh:
    points = np.asarray(geometry.points)
    given: dict[str, Any] = {}
    if len(points) and len(colors := np.asarray(geometry.colors)) == len(points):
        given["colors"] = _displayed(colors)
    if len(points) and len(normals := np.asarray(geometry.normals)) == len(points):
        given["normals"] = normals
    return Mesh(points, points=np.arange(len(points)), **given)


def _mesh_of_lines(geometry: Any) -> Mesh:
    points, lines = np.asarray(geometry.points), np.asarray(geometry.lines)
    require_indices(lines, len(points), "lines")
    colors = np.asarray(geometry.colors)
    if not len(lines) or len(colors) != len(lines):
        return Mesh(points, lines=lines)
    ends = np.arange(2 * len(lines)).reshape(-1, 2)
    return Mesh(points[lines.reshape(-1)], lines=ends, colors=_displayed(np.repeat(colors, 2, 0)))


def _mesh_of_box(geometry: Any) -> Mesh:
    corners = np.asarray(geometry.get_box_points())
    return Mesh(corners, lines=_BOX_LINES, colors=[_displayed(np.asarray(geometry.color))] * 8)


def _mesh_of_voxels(grid: Any) -> Mesh:
    voxels = grid.get_voxels()
    cells = np.array([voxel.grid_index for voxel in voxels], np.int64).reshape(-1, 3)
    positions, faces, owners = outer_faces(cells)
    mesh = Mesh(voxel_points(grid, positions), faces)
    mesh.edge_visible = np.tile([True, True, False], (len(faces), 1))
    if grid.has_colors() and len(positions):
        mesh.colors = _displayed(np.array([voxel.color for voxel in voxels])[owners])
    return mesh


def voxel_points(grid: Any, cells: NDArray[Any]) -> NDArray[np.float64]:
    """Return where points given in voxels, (N, 3), lie in the world."""
    turned = np.asarray(getattr(grid, "rotation", np.eye(3)), np.float64) * grid.voxel_size
    placed = sum(cells[:, axis, np.newaxis] * turned[:, axis] for axis in range(3))
    return np.asarray(grid.origin, np.float64) + placed


def _mesh_of_octree(tree: Any) -> Mesh:
    """Return the cubes of the coloured leaves, and the edges of all cubes as lines."""
    origins, sizes, colors, is_leaf = octree_cells(tree)
    corners, faces = cube_faces(origins[is_leaf], sizes[is_leaf])
    ends, edges = cube_faces(origins, sizes)[0], CUBE_EDGES
    lines = len(corners) + (8 * np.arange(len(origins))[:, np.newaxis, np.newaxis] + edges)
    every = np.concatenate([np.repeat(colors[is_leaf], 8, 0), np.repeat(colors, 8, 0)])
    mesh = Mesh(np.concatenate([corners, ends]), faces, lines=lines.reshape(-1, 2))
    if len(every):
        mesh.colors = _displayed(every)
    return mesh


def octree_cells(
    tree: Any,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Return origins (N, 3), sizes (N,) and colours (N, 3) of cells, and which are leaves (N,).

    Cells that are no coloured leaves are black.
    """
    rows: list[tuple[Any, float, Any, bool]] = []

    def take(node: Any, info: Any) -> bool:
        is_leaf = hasattr(node, "color")
        color = node.color if is_leaf else np.zeros(3)
        rows.append((np.array(info.origin), float(info.size), np.array(color), is_leaf))
        return False

    tree.traverse(take)
    return (
        np.array([row[0] for row in rows], np.float64).reshape(-1, 3),
        np.array([row[1] for row in rows], np.float64),
        np.array([row[2] for row in rows], np.float64).reshape(-1, 3),
        np.array([row[3] for row in rows], bool),
    )


def _mesh_of_tetrahedra(geometry: Any) -> Any:
    """Return the outer faces of a tetrahedral mesh."""
    tetra = np.asarray(geometry.tetras)
    as_meshio = SimpleNamespace(
        points=np.asarray(geometry.vertices),
        cells=[SimpleNamespace(type="tetra", data=tetra)],
        point_data={},
        cell_data={},
    )
    scene = scene_from_meshio(as_meshio)
    return None if scene is None else next(iter(scene.nodes)).object


def require_indices(rows: NDArray[Any], count: int, what: str) -> None:
    """Raise `InvalidArgumentError` unless rows of points are among ``count`` of them."""
    if rows.size and (rows.min() < 0 or rows.max() >= count):
        wrong = int(rows.min()) if rows.min() < 0 else int(rows.max())
        raise InvalidArgumentError(f"{what} hold the index {wrong}, but there are {count} points")


def _displayed(colors: NDArray[Any]) -> NDArray[Any]:
    """Return colours within 0 to 1, as Open3D shows those outside; NaN is black."""
    return np.clip(np.nan_to_num(colors), 0.0, 1.0)


_MESHES: dict[str, Callable[[Any], Any]] = {
    "TriangleMesh": mesh_of_triangles,
    "PointCloud": _mesh_of_points,
    "LineSet": _mesh_of_lines,
    "AxisAlignedBoundingBox": _mesh_of_box,
    "OrientedBoundingBox": _mesh_of_box,
    "OrientedBoundingEllipsoid": _mesh_of_box,
    "VoxelGrid": _mesh_of_voxels,
    "Octree": _mesh_of_octree,
    "TetraMesh": _mesh_of_tetrahedra,
}
