"""Geometries of trimesh as its viewer hands them to OpenGL.

In: a ``Trimesh``, ``Path``, ``PointCloud`` or ``VoxelGrid``. Out: a `Shape`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import warn
from ...model.geometry.creases import mesh_with_creases
from ...model.geometry.mesh import Mesh
from ...model.materials.textures import Texture

_SMOOTHED = 60_000  # faces: so many and more stay flat
_GRAPHS = ("scipy", "networkx")  # one of which trimesh smooths with
_SHARP = math.radians(20.0)  # trimesh's angle


@dataclass
class Shape:
    """Vertices with what they are corners of.

    Attributes
    ----------
    positions : (V, 3) float64
    colors : (V, 4) uint8
    normals : (V, 3) float64 or None
        None for lines and points.
    faces : (F, 3) int, lines : (L, 2) int, points : (P,) int
    uvs : (V, 2) float or None
    texture : Texture or None
    """

    positions: NDArray[np.float64]
    colors: NDArray[np.uint8]
    normals: NDArray[np.float64] | None = None
    faces: NDArray[np.int32] | None = None
    lines: NDArray[np.int32] | None = None
    points: NDArray[np.int32] | None = None
    uvs: NDArray[np.float64] | None = None
    texture: Texture | None = None


def shape_of(geometry: Any, is_smooth: bool) -> Shape | None:
    """Return a geometry's shape; None, with a warning, if trimesh's viewer cannot show it."""
    if hasattr(geometry, "as_boxes"):
        geometry = geometry.as_boxes()
    if hasattr(geometry, "faces"):
        return _of_mesh(geometry, is_smooth)
    if hasattr(geometry, "entities"):
        return _of_path(geometry)
    if hasattr(geometry, "vertices"):
        return _of_points(geometry)
    warn(f"a {type(geometry).__name__} of trimesh is not drawn")
    return None


def _of_mesh(mesh: Any, is_smooth: bool) -> Shape:
    visual = mesh.visual
    if hasattr(visual, "uv"):
        return _of_textured(mesh, visual)
    if is_smooth and len(mesh.faces) < _SMOOTHED:
        return _of_smooth(mesh)
    corners = np.asarray(mesh.faces).reshape(-1)
    return Shape(
        _three(mesh.vertices)[corners],
        np.repeat(_rgba(visual.face_colors, len(mesh.faces)), 3, 0),
        np.repeat(np.asarray(mesh.face_normals, np.float64), 3, 0),
        faces=np.arange(len(corners), dtype=np.int32).reshape(-1, 3),
    )


def _of_textured(mesh: Any, visual: Any) -> Shape:
    positions = _three(mesh.vertices)
    material = visual.material
    image = getattr(material, "image", None)
    image = getattr(material, "baseColorTexture", None) if image is None else image
    uvs = None if visual.uv is None else np.asarray(visual.uv, np.float64)[:, :2]
    shape = Shape(
        positions,
        np.full((len(positions), 4), 255, np.uint8),
        np.asarray(mesh.vertex_normals, np.float64),
        faces=np.asarray(mesh.faces, np.int32),
    )
    if uvs is None or image is None or len(uvs) != len(positions):
        shape.colors = _rgba(getattr(material, "main_color", None), len(positions))
        return shape
    pixels = np.asarray(image.convert("RGBA"))
    shape.uvs = uvs
    shape.texture = Texture(pixels, color_space="linear", filter="bilinear", wrap="repeat")
    return shape


def _of_smooth(mesh: Any) -> Shape:
    """Return a mesh smoothed by trimesh, or, where that lacks a package, by its creases."""
    if not any(find_spec(name) for name in _GRAPHS):
        return _of_creases(mesh)
    smooth = mesh.smooth_shaded
    return Shape(
        _three(smooth.vertices),
        _rgba(smooth.visual.vertex_colors, len(smooth.vertices)),
        np.asarray(smooth.vertex_normals, np.float64),
        faces=np.asarray(smooth.faces, np.int32),
    )


def _of_creases(mesh: Any) -> Shape:
    positions, faces = _three(mesh.vertices), np.asarray(mesh.faces, np.int32)
    if mesh.visual.kind == "face":
        colors = _mean_colors(_rgba(mesh.visual.face_colors, len(faces)), faces, len(positions))
    else:
        colors = _rgba(mesh.visual.vertex_colors, len(positions))
    creased = Mesh(positions, faces, colors=colors)
    creased.crease_angle = _SHARP
    split = mesh_with_creases(creased)
    return Shape(
        split.positions.astype(np.float64),
        split.colors,
        split.normals.astype(np.float64),
        faces=split.faces,
    )


def _mean_colors(
    colors: NDArray[np.uint8], faces: NDArray[np.int32], count: int
) -> NDArray[np.uint8]:
    """Return the means of the colours of the faces round each vertex."""
    corners = faces.reshape(-1)
    many = np.maximum(np.bincount(corners, minlength=count), 1)
    sums = [
        np.bincount(corners, np.repeat(colors[:, k], 3).astype(np.float64), count) for k in range(4)
    ]
    return (np.stack(sums, 1) / many[:, None]).astype(np.uint8)


def _of_path(path: Any) -> Shape | None:
    vertices = _three(path.vertices)
    runs = [np.asarray(entity.discrete(path.vertices), np.float64) for entity in path.entities]
    given = path.colors
    colors = [None] * len(runs) if given is None else list(given)
    kept = [(run, color) for run, color in zip(runs, colors, strict=False) if len(run) > 1]
    if not kept or not len(vertices):
        return None
    positions = np.concatenate([_three(run) for run, _ in kept])
    rgba = np.concatenate([_rgba(color, len(run)) for run, color in kept])
    first = np.arange(len(positions) - 1)
    ends = np.cumsum([len(run) for run, _ in kept])[:-1] - 1
    first = np.delete(first, ends).astype(np.int32)
    return Shape(positions, rgba, lines=np.stack([first, first + 1], 1))


def _of_points(cloud: Any) -> Shape:
    positions = _three(cloud.vertices)
    colors = _rgba(getattr(cloud, "colors", None), len(positions))
    return Shape(positions, colors, points=np.arange(len(positions), dtype=np.int32))


def _three(vertices: Any) -> NDArray[np.float64]:
    """Return vertices with three coordinates."""
    given = np.asarray(vertices, np.float64)
    if given.ndim == 2 and given.shape[1] == 2:
        return np.concatenate([given, np.zeros((len(given), 1))], 1)
    return given.reshape(-1, 3)


def _rgba(colors: Any, count: int) -> NDArray[np.uint8]:
    """Return colours as (count, 4) uint8; black where there are none, as in trimesh's viewer."""
    out = np.zeros((count, 4), np.uint8)
    out[:, 3] = 255
    if colors is None:
        return out
    given = np.asarray(colors)
    if given.dtype.kind == "f":
        given = np.clip(255.0 * given + 0.5, 0, 255)
    if given.ndim == 1 and given.size in (3, 4):
        given = np.broadcast_to(given, (count, given.size))
    if given.ndim == 2 and len(given) == count and given.shape[1] in (3, 4):
        out[:, : given.shape[1]] = given.astype(np.uint8)
    return out
