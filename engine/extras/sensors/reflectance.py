"""How much of a beam's light surfaces reflect, as a LiDAR needs it.

In: hits of rays in a scene. Out: for each the reflectance, from 0 to 1: the mean of red, green and
blue of the base colour in linear light, with its texture (the nearest texel), the colours of
vertices and of the instance. Real sensors see infrared, in which colours differ: a simple model.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...choices import Wrap
from ...model.geometry.mesh import Mesh
from ...model.materials.colors import srgb_to_linear_table
from ...model.materials.display_colors import shading_color
from ...model.materials.material import Material, placed_textures_of
from ...model.materials.textures import PlacedTexture, Texture
from ...model.scene.instances import InstancedMesh
from ...model.scene.scene import Scene
from ...model.scene.shown import shown_object
from ...model.spatial.rays import RayHits


def reflectances_of(scene: Scene, hits: RayHits) -> NDArray[np.float64]:
    """Return the reflectance of what rays have met, (N,), all of which hit."""
    found = np.zeros(len(hits.face_id))
    for identity in np.unique(hits.object_id).tolist():
        node = scene.data.node_of(identity)
        rows = np.flatnonzero(hits.object_id == identity)
        obj = None if node is None else shown_object(node)
        colors = np.ones((len(rows), 3))
        if isinstance(obj, InstancedMesh):
            if obj.colors is not None:
                colors *= _linear(obj.colors[hits.instance_id[rows]])
            obj = obj.mesh
        if isinstance(obj, Mesh):
            colors *= _colors_of(obj, hits.face_id[rows], hits.barycentric[rows])
        means = (colors[:, 0] + colors[:, 1] + colors[:, 2]) / 3.0
        found[rows] = np.clip(means, 0.0, 1.0)
    return found


def _colors_of(
    mesh: Mesh, faces: NDArray[np.int32], weights: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the base colours of points of faces, (N, 3), linear."""
    colors = np.empty((len(faces), 3))
    corners = mesh.faces[faces]
    for material, rows in _by_material(mesh, faces):
        colors[rows] = shading_color(material.rgb, "srgb")
        placed = placed_textures_of(material).get("texture")
        if placed is not None:
            uvs = mesh.uvs if placed.uv_set == 0 else mesh.uvs1
            places = np.zeros((len(rows), 2))
            if uvs is not None:
                places = _mixed(uvs[corners[rows]].astype(np.float64), weights[rows])
            colors[rows] *= _texels(placed, places)
    if mesh.colors is not None:
        colors *= _mixed(_linear(mesh.colors[corners]), weights)
    return colors


def _by_material(
    mesh: Mesh, faces: NDArray[np.int32]
) -> Iterator[tuple[Material, NDArray[np.intp]]]:
    """Yield the materials of faces, each with the rows that have it."""
    ids = mesh.material_ids[faces]
    for number in np.unique(ids).tolist():
        yield mesh.materials[number], np.flatnonzero(ids == number)


def _mixed(corners: NDArray[np.float64], weights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return values between three corners, (N, 3, C) by (N, 3)."""
    parts = corners * weights[:, :, np.newaxis]
    return parts[:, 0] + parts[:, 1] + parts[:, 2]


def _linear(colors: NDArray[np.uint8] | NDArray[np.float32]) -> NDArray[np.float64]:
    """Return red, green and blue of stored colours, in linear light."""
    rgb = colors[..., :3]
    if rgb.dtype == np.uint8:
        return srgb_to_linear_table()[rgb].astype(np.float64)
    return rgb.astype(np.float64)


def _texels(placed: PlacedTexture, uvs: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the nearest texels at texture coordinates, (N, 3) linear."""
    texture = placed.texture
    u, v = ((row[0] * uvs[:, 0] + row[1] * uvs[:, 1]) + row[2] for row in placed.matrix)
    across, down = texture.side_wraps
    columns = _texel_numbers(u, texture.width, across)
    rows = _texel_numbers(1.0 - v, texture.height, down)
    return _decoded(texture, texture.pixels[rows, columns])


def _decoded(texture: Texture, texels: NDArray[np.uint8]) -> NDArray[np.float64]:
    if texture.color_space == "srgb":
        return _linear(texels)
    return texels[:, :3] / 255.0


def _texel_numbers(places: NDArray[np.float64], count: int, wrap: Wrap) -> NDArray[np.intp]:
    """Return the texels that places from 0 to 1 are in; beyond, as the texture is wrapped."""
    if wrap == "clamp":
        inside = np.clip(places, 0.0, 1.0)
    elif wrap == "mirror":
        turn = places - 2.0 * np.floor(0.5 * places)
        inside = np.where(turn > 1.0, 2.0 - turn, turn)
    else:
        inside = places - np.floor(places)
    with np.errstate(invalid="ignore"):
        return np.clip(np.nan_to_num(inside) * count, 0, count - 1).astype(np.intp)
