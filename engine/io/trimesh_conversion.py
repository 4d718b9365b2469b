"""Conversion of meshes from and to the optional package trimesh.

In: trimesh geometry, or a `Mesh`. Out: the other. trimesh is imported only to create its objects;
its geometry is recognised by attributes. Vertex colours are sRGB bytes on both sides.
"""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np

from ..base.numbers import shown
from ..base.optional_packages import needed
from ..errors import InvalidArgumentError
from ..model.geometry.mesh import Mesh
from ..model.geometry.posing import posed_mesh
from ..model.materials.colors import linear_color, srgb_bytes
from ..model.materials.material import Material, textures_of
from .reading.far_coordinates import moved_near
from .reading.indexed_mesh import IndexedGeometry, build_indexed_mesh
from .reading.posed_parts import PosedPart
from .reading.warning_list import WarningList
from .trimesh_materials import TrimeshMaterials


def mesh_from_trimesh(geometry: Any) -> Mesh:
    """Return the mesh of a trimesh geometry; see `Mesh.from_trimesh`."""
    if hasattr(geometry, "graph") and hasattr(geometry, "geometry"):
        parts = scene_parts(geometry)
        return Mesh.concatenate([posed_mesh(part.mesh, part.pose) for part in parts])
    return _mesh(geometry, "", TrimeshMaterials())


def scene_parts(
    scene: Any, warnings: WarningList | None = None, *, near: bool = False
) -> list[PosedPart]:
    """Return the nodes of a trimesh scene; nodes with the same geometry share a mesh.

    With ``warnings``, unreadable images are left out. With ``near``, distant coordinates are moved
    near the origin, and poses move them back.
    """
    meshes: dict[str, tuple[Mesh, np.ndarray | None]] = {}
    materials = TrimeshMaterials(warnings)
    parts = []
    for node in scene.graph.nodes_geometry:
        pose, name = scene.graph[node]
        if name not in meshes:
            meshes[name] = _near_mesh(scene.geometry[name], str(name), materials, near)
        mesh, back = meshes[name]
        pose = np.array(pose, np.float64)
        parts.append(PosedPart(str(node), mesh, pose if back is None else pose @ back))
    return parts


def _near_mesh(
    geometry: Any, name: str, materials: TrimeshMaterials, near: bool
) -> tuple[Mesh, np.ndarray | None]:
    """Return the mesh of a geometry, and the pose that undoes a move of its coordinates."""
    vertices = np.asarray(getattr(geometry, "vertices", ()), np.float64)
    if not near or vertices.ndim != 2 or vertices.shape[1] != 3:
        return _mesh(geometry, name, materials), None
    moved, back = moved_near(vertices)
    return _mesh(geometry, name, materials, moved), back


def _mesh(
    geometry: Any, name: str, materials: TrimeshMaterials, positions: np.ndarray | None = None
) -> Mesh:
    """Return the mesh of a Trimesh, PointCloud, Path or VoxelGrid; vertices may be given apart."""
    if hasattr(geometry, "as_boxes"):  # voxels
        geometry = geometry.as_boxes()
    if positions is None:
        positions = np.asarray(getattr(geometry, "vertices", ()), np.float64)
    if hasattr(geometry, "faces") and hasattr(geometry, "visual"):
        return _triangle_mesh(geometry, name, materials, positions)
    if hasattr(geometry, "entities"):
        return _path_mesh(geometry, name, positions)
    if hasattr(geometry, "vertices"):
        colors = getattr(geometry, "colors", None)
        colors = None if colors is None or len(colors) != len(positions) else _bytes(colors)
        cloud = Mesh(positions, colors=colors, points=np.arange(len(positions)), name=name)
        _show_alpha(cloud, colors)
        return cloud
    raise InvalidArgumentError(f"geometry must be one of trimesh, not {shown(geometry)}")


def _triangle_mesh(
    geometry: Any, name: str, materials: TrimeshMaterials, positions: np.ndarray
) -> Mesh:
    visual = geometry.visual
    kind = getattr(visual, "kind", None)
    indexed = IndexedGeometry(positions, np.asarray(geometry.faces, np.int32))
    # Asking a mesh without normals for them would make trimesh compute them.
    if "vertex_normals" in getattr(geometry, "_cache", ()):
        indexed.normals = np.asarray(geometry.vertex_normals, np.float32)
    colors = None
    if kind == "vertex":
        colors = indexed.colors = _bytes(visual.vertex_colors)
    elif kind == "face":
        colors = indexed.face_colors = _bytes(visual.face_colors)
    elif kind == "texture" and visual.uv is not None and len(visual.uv) == len(indexed.positions):
        indexed.uvs = np.nan_to_num(np.asarray(visual.uv, np.float32)[:, :2])
    mesh = build_indexed_mesh(indexed, name)
    if kind == "texture":
        mesh.materials, ids = materials.of(visual, len(mesh.faces))
        if ids is not None:
            mesh.material_ids = ids
    else:
        mesh.materials = [Material()]
        _show_alpha(mesh, colors)
    return mesh


def _show_alpha(mesh: Mesh, colors: np.ndarray | None) -> None:
    """Let the alpha of a mesh's colours count, if they have any."""
    if colors is not None and colors.shape[1] == 4 and (colors[:, 3] != 255).any():
        mesh.materials = [Material(alpha_mode="blend")]


def _path_mesh(geometry: Any, name: str, vertices: np.ndarray) -> Mesh:
    # Without the scale, a circle would get a point every twentieth of a unit, regardless of its
    # size.
    scale = float(np.ptp(vertices, axis=0).max(initial=0.0)) if len(vertices) else 1.0
    runs = [
        np.asarray(entity.discrete(vertices, scale=scale or 1.0), np.float64)
        for entity in geometry.entities
    ]
    lengths = np.array([len(run) if len(run) > 1 else 0 for run in runs], np.int64)
    runs = [run for run in runs if len(run) > 1]
    if not runs:
        return Mesh(np.zeros((0, 3)), name=name)
    positions = np.zeros((sum(map(len, runs)), 3))
    positions[:, : vertices.shape[1]] = np.concatenate(runs)
    first = np.arange(len(positions) - 1)
    ends = np.cumsum([len(run) for run in runs])[:-1] - 1
    first = np.delete(first, ends)
    colors = getattr(geometry, "colors", None)  # of entities
    if colors is not None:
        colors = np.repeat(_bytes(colors), lengths, axis=0)
    mesh = Mesh(positions, colors=colors, lines=np.stack([first, first + 1], axis=1), name=name)
    _show_alpha(mesh, colors)
    return mesh


def _bytes(colors: Any) -> np.ndarray:
    return np.array(colors, np.uint8).reshape(len(colors), -1)


def mesh_to_trimesh(mesh: Mesh) -> Any:
    """Return a trimesh geometry; see `Mesh.to_trimesh`."""
    try:
        import trimesh
    except ImportError as error:
        message = needed("to_trimesh needs", "trimesh", "formats")
        raise ImportError(message, name=error.name) from error
    if not len(mesh.faces):
        colors = None if mesh.colors is None else srgb_bytes(mesh.colors)[mesh.points]
        return trimesh.PointCloud(mesh.positions[mesh.points].astype(np.float64), colors=colors)
    used = np.unique(mesh.material_ids)
    parts = [_trimesh_part(trimesh, mesh, number, len(used) > 1) for number in used.tolist()]
    if len(parts) == 1:
        return parts[0]
    scene = trimesh.Scene()
    for number, part in zip(used.tolist(), parts, strict=True):
        scene.add_geometry(part, geom_name=mesh.materials[number].name or f"material_{number}")
    return scene


def _trimesh_part(trimesh: ModuleType, mesh: Mesh, number: int, is_part: bool) -> Any:
    """Return the faces of one material; all vertices stay if there is no other."""
    faces: np.ndarray = mesh.faces
    vertices: np.ndarray | slice = slice(None)
    if is_part:
        vertices, faces = np.unique(faces[mesh.material_ids == number], return_inverse=True)
        faces = faces.reshape(-1, 3)
    geometry = trimesh.Trimesh(
        mesh.positions[vertices].astype(np.float64),
        faces,
        vertex_normals=mesh.normals[vertices] if mesh.has_normals else None,
        process=False,
    )
    material = mesh.materials[number]
    if mesh.colors is not None:
        geometry.visual.vertex_colors = srgb_bytes(mesh.colors)[vertices]
    elif mesh.uvs is not None:
        geometry.visual = trimesh.visual.TextureVisuals(
            uv=mesh.uvs[vertices].astype(np.float64), material=_trimesh_material(trimesh, material)
        )
    elif not np.array_equal(linear_color(material.rgb), (1, 1, 1)):
        linear = np.append(linear_color(material.rgb), np.float32(1))[np.newaxis]
        geometry.visual.face_colors = np.repeat(srgb_bytes(linear), len(faces), axis=0)
    return geometry


def _trimesh_material(trimesh: ModuleType, material: Material) -> Any:
    image = None
    texture = textures_of(material).get("texture")
    if texture is not None:
        from PIL import Image

        image = Image.fromarray(texture.pixels)
    return trimesh.visual.material.PBRMaterial(
        name=material.name or None,
        baseColorFactor=[*map(float, linear_color(material.rgb).clip(0, 1)), 1.0],
        baseColorTexture=image,
        metallicFactor=material.extras.get("Pm", material.metallic),
        roughnessFactor=material.extras.get("Pr", material.roughness),
        doubleSided=material.two_sided,
    )
