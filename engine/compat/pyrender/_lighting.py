"""Lights in the core's format, and their assignment to nodes.

In: a scene and flags. Out: lights in a `NativePicture`, and for each node the numbers of its
lights: at most the four nearest of each kind.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ..._native import pyrender as _native
from .constants import MAX_N_LIGHTS, RenderFlags
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
    shadow_map : callable
        Of a node with a light: its map, (N, N) float32, and clip-from-world of it.
    """

    def __init__(
        self,
        picture: _native.NativePicture,
        scene: Scene,
        flags: int,
        shadow_map: Callable[[Node], tuple[np.ndarray, np.ndarray]],
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
            shadow = shadow_map(node) if flags & _KINDS[kind][1] else (None, None)
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
