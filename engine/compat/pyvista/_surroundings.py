"""The light of an environment texture of VTK.

In: a ``vtkRenderer`` and its view. Out: `Surroundings`, which physical materials reflect. VTK and
engine3d lay out such pictures alike, and add up their light by the same split sums.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from ...base import linalg
from ...model.environments.environment import Environment
from ...model.materials.material import Material
from ...model.scene.scene import Scene
from ._material_maps import make_physical
from ._parts import Part
from ._renderer_view import View, product

#: Of the faces of a cube map, in OpenGL's order: the axis that they look along, right, and down.
_FACES = np.array(
    [
        [(1, 0, 0), (0, 0, -1), (0, -1, 0)],
        [(-1, 0, 0), (0, 0, 1), (0, -1, 0)],
        [(0, 1, 0), (1, 0, 0), (0, 0, 1)],
        [(0, -1, 0), (1, 0, 0), (0, 0, -1)],
        [(0, 0, 1), (1, 0, 0), (0, -1, 0)],
        [(0, 0, -1), (-1, 0, 0), (0, -1, 0)],
    ],
    float,
)
#: Light of 8-bit codes, where VTK is told that they are codes for screens.
_CODES = np.array([(code / 255.0) ** 2.2 for code in range(256)], np.float32)


@dataclass
class Surroundings:
    """Light from every direction.

    Attributes
    ----------
    environment : Environment
    turn : (4, 4) float64
        The environment's directions from those of view space.
    is_upright : bool
        Whether its directions are those of the world.
    """

    environment: Environment
    turn: NDArray[np.float64]
    is_upright: bool

    def scene(self, parts: list[Part]) -> Scene:
        """Return a scene of parts that are lit by nothing else; its camera stands at ``turn``."""
        scene = Scene(background=None, ambient=(0, 0, 0))
        scene.environment = self.environment
        for part in parts:
            node = part.added(scene, _material(part))
            node.pose = self.turn
        return scene


def surroundings_of(renderer: Any, view: View) -> Surroundings | None:
    """Return the light round a renderer's scene; None without any."""
    texture = renderer.GetEnvironmentTexture()
    if texture is None or not renderer.GetUseImageBasedLighting():
        return None
    count = 6 if texture.GetCubeMap() else 1
    texture.Update()
    is_coded = renderer.GetEnvMapPrefiltered().GetConvertToLinear()
    found = [_light(texture.GetInputDataObject(k, 0), is_coded) for k in range(count)]
    images = [image for image in found if image is not None]
    if len(images) < count:
        return None
    right, up = np.zeros(3), np.zeros(3)
    renderer.GetEnvironmentRight(right)
    renderer.GetEnvironmentUp(up)
    turn = np.eye(4)
    turn[:3, :3] = [right, up, linalg.cross(right, up)]
    is_upright = bool((turn == np.eye(4)).all())
    back = np.eye(4)
    back[:3, :3] = view.view[:3, :3].T
    pixels = images[0][::-1] if count == 1 else _unfolded(images)
    return Surroundings(Environment(pixels), product(turn, back), is_upright)


def _light(image: Any, is_coded: bool) -> NDArray[np.float32] | None:
    """Return a picture as linear light, (H, W, 3), the bottom row first."""
    if image is None or image.GetPointData().GetScalars() is None:
        return None
    width, height, _ = image.GetDimensions()
    values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    values = values[..., :3] if values.shape[-1] >= 3 else np.repeat(values[..., :1], 3, -1)
    if values.dtype != np.uint8:
        return values.astype(np.float32)
    return _CODES[values] if is_coded else values.astype(np.float32) / np.float32(255.0)


def _unfolded(faces: list[Any]) -> NDArray[np.float32]:
    """Return the faces of a cube map as one picture of all directions."""
    side = faces[0].shape[0]
    height, width = 2 * side, 4 * side
    yaw = 2.0 * math.pi * ((np.arange(width) + 0.5) / width - 0.5)
    pitch = math.pi * (0.5 - (np.arange(height) + 0.5) / height)
    level = linalg.cos(pitch)[:, None]
    x, z = level * linalg.cos(yaw), -level * linalg.sin(yaw)  # VTK looks up -z, too
    y = np.broadcast_to(linalg.sin(pitch)[:, None], x.shape)
    out = np.empty((height, width, 3), np.float32)
    axis = np.argmax(np.abs([x, y, z]), axis=0)
    number = 2 * axis + (np.choose(axis, [x, y, z]) < 0.0)
    for k, (along, right, down) in enumerate(_FACES):
        rows = number == k
        direction = np.stack([x[rows], y[rows], z[rows]], -1)
        depth, across, below = ((direction * way).sum(1) for way in (along, right, down))
        places = [
            np.clip((0.5 + 0.5 * value / depth) * side, 0, side - 1).astype(np.intp)
            for value in (below, across)
        ]
        out[rows] = faces[k][places[0], places[1]]
    return out


def _material(part: Part) -> Material:
    """Return the material that reflects the surroundings; what VTK lights otherwise is black."""
    look = part.look
    if not look.is_physical or look.is_unlit:
        return Material(color=(0.0, 0.0, 0.0), unlit=True, two_sided=True)
    material = part.material()
    make_physical(material, part)
    return material
