"""Lights as the core takes them, which of them each node gets, and maps of what they see.

In: a scene and flags. Out: lights in a `NativePicture`, and for each node the numbers of its
lights: at most the four nearest of each kind.
"""

from __future__ import annotations

import math

import numpy as np

from ..._native import pyrender as _native
from ...rendering.renderer import Renderer as Engine
from ._shapes import is_triangles
from ._visibility import Placed, Visibility
from .constants import MAX_N_LIGHTS, SHADOW_TEX_SZ, RenderFlags
from .light import DirectionalLight, PointLight, SpotLight
from .node import Node
from .scene import Scene

_KINDS = {
    DirectionalLight: (_native.DIRECTIONAL, RenderFlags.SHADOWS_DIRECTIONAL),
    SpotLight: (_native.SPOT, RenderFlags.SHADOWS_SPOT),
    PointLight: (_native.POINT, RenderFlags.SHADOWS_POINT),
}
#: OpenGL textures left for shadow maps: 32, minus those of materials.
_MAPS = 32 - 6


def _most_lights(flags: int) -> dict[type, int]:
    """Return the limit of lights of each kind per node: with shadows, the number of textures."""
    most = dict.fromkeys(_KINDS, MAX_N_LIGHTS)
    shadowed = [kind for kind, (_, flag) in _KINDS.items() if flags & flag]
    for kind in shadowed:
        most[kind] = _MAPS // len(shadowed)
    if DirectionalLight in shadowed:
        most[DirectionalLight] += _MAPS % len(shadowed)
    return most


def _kind_of(light) -> type:
    return next(kind for kind in _KINDS if isinstance(light, kind))


class Lighting:
    """The lights of a picture.

    Parameters
    ----------
    picture : NativePicture
    scene : Scene
    flags : int
    shadows : ShadowMaps
    """

    def __init__(
        self,
        picture: _native.NativePicture,
        scene: Scene,
        flags: int,
        shadows: ShadowMaps,
    ) -> None:
        self._picture = picture
        self._most = _most_lights(flags)
        self._kinds: list[type] = []  # of each light
        self._lists: dict[tuple, tuple[int, int]] = {}
        places = []
        for node in scene._in_order(scene.light_nodes):
            kind, pose = _kind_of(node.light), scene.get_pose(node)
            self._kinds.append(kind)
            places.append(pose[:3, 3])
            shadow = shadows.map_of(scene, node) if flags & _KINDS[kind][1] else (None, None)
            self._add(node.light, kind, pose, shadow)
        self._places = np.array(places).reshape(-1, 3)
        self._all_shine = all(self._kinds.count(kind) <= most for kind, most in self._most.items())

    def _add(self, light, kind: type, pose: np.ndarray, shadow: tuple) -> None:
        scale = offset = 0.0
        if kind is SpotLight:
            inner, outer = math.cos(light.innerConeAngle), math.cos(light.outerConeAngle)
            scale = 1.0 / max(0.001, inner - outer)
            offset = -outer * scale
        direction = -pose[:3, 2]
        if kind is DirectionalLight:
            direction = direction / (np.linalg.norm(direction) or 1.0)
        color = light.color * np.float32(light.intensity)
        self._picture.add_light(
            _KINDS[kind][0], color, pose[:3, 3], direction, scale, offset, *shadow
        )

    def of(self, place: np.ndarray) -> tuple[int, int]:
        """Return the start and length of a node's list of lights."""
        if self._all_shine:
            nearest = tuple(range(len(self._kinds)))
        else:
            away = self._places - place
            nearest = tuple(np.argsort((away * away).sum(axis=1), kind="stable").tolist())
        if nearest not in self._lists:
            left, numbers = dict(self._most), []
            for number in nearest:
                kind = self._kinds[number]
                if left[kind]:
                    left[kind] -= 1
                    numbers.append(number)
            self._lists[nearest] = self._picture.add_lights_of_draws(numbers), len(numbers)
        return self._lists[nearest]


class ShadowMaps:
    """Draws the maps of lights."""

    def __init__(self) -> None:
        self._engine: Engine | None = None
        self._casters = Visibility()

    def map_of(self, scene: Scene, light_node: Node) -> tuple[np.ndarray, np.ndarray]:
        """Return what a light sees.

        Parameters
        ----------
        scene : Scene
        light_node : Node
            With a directional light or a spotlight.

        Returns
        -------
        depths : (N, N) float32
            z_ndc, infinite where nothing is.
        clip_from_world : (4, 4) float64
        """
        if self._engine is None:
            self._engine = Engine((SHADOW_TEX_SZ, SHADOW_TEX_SZ))
        pose, scale = scene.get_pose(light_node), scene.scale
        projection = light_node.light._get_shadow_camera(scale).get_projection_matrix()
        if isinstance(light_node.light, DirectionalLight):
            pose[:3, 3] = scene.centroid + pose[:3, 2] * scale
        self._casters.place(_casters(scene, pose))
        depths = self._casters.depths(self._engine, projection, pose)
        return depths, np.ascontiguousarray(projection @ np.linalg.inv(pose))


def _casters(scene: Scene, light_pose: np.ndarray) -> list[Placed]:
    """The triangles of all that shows, their fronts alone."""
    mirrored = np.linalg.det(light_pose[:3, :3]) < 0
    casters = []
    for node in scene._in_order(scene.mesh_nodes):
        if not node.mesh.is_visible:
            continue
        pose = scene.get_pose(node)
        turned = bool(mirrored != (np.linalg.det(pose[:3, :3]) < 0))
        for number, primitive in enumerate(node.mesh.primitives):
            if is_triangles(primitive) and len(primitive.positions):
                casters.append(Placed((node, number), primitive, pose, False, turned, 0))
    return casters
