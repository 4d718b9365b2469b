"""Pictures of a world, lit as TinyRenderer does.

In: a `World`, a camera, a `Light`. Out: colours, depths and masks. The engine finds what shows at
each pixel, and C shades it (R268 to R270). TinyRenderer samples at the lower left corner of a
pixel, and so does this. Source: TinyRenderer.cpp of Bullet 3.2.7.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..._native import pybullet as _native
from ...base import linalg
from ...rendering.renderer import Renderer
from ._light import Light
from ._world import World

_MOST_SIZES = 4
_OUTPUTS = ("color", "object_id", "ndc_depth", "world_normal")


class Picture(NamedTuple):
    """What `getCameraImage` returns, after width and height.

    Attributes
    ----------
    colors : (H, W, 4) uint8
    depths : (H, W) float32
        0 at the near plane, 1 at the far one and behind.
    masks : (H, W) int32
        ``body + ((link + 1) << 24)``; -1 where nothing is.
    """

    colors: np.ndarray
    depths: np.ndarray
    masks: np.ndarray


class _Engines(NamedTuple):
    """Renderers of a size: of the picture, and of the shadow map, which culls other faces."""

    picture: Renderer
    shadows: Renderer


class Painter:
    """Draws pictures; keeps the memory of the last few sizes."""

    def __init__(self) -> None:
        self._engines: dict[tuple[int, int], _Engines] = {}

    def draw(
        self,
        world: World,
        size: tuple[int, int],
        projection: np.ndarray,
        view: np.ndarray,
        light: Light,
        with_links: bool,
    ) -> Picture:
        """Return a picture of a world that is up to date.

        Parameters
        ----------
        world : World
        size : (int, int)
        projection, view : (4, 4) float64
        light : Light
        with_links : bool
            Whether masks tell links, too.
        """
        engines, shadows = self._of_size(size), None
        if light.shadow:
            shadows = _shadow_map(engines.shadows, world, size, projection, light)
        world.camera.matrix = linalg.multiply(_shifted(projection, size), view)
        outputs = _OUTPUTS if shadows is None else (*_OUTPUTS, "world_position")
        frame = engines.picture.render(
            world.scene, camera=world.viewpoint, outputs=outputs, cull="back", mode="unlit"
        )
        held = {}
        if shadows is not None:
            from_light = linalg.multiply(projection, light.view())
            held = {
                "positions": frame.world_position,
                "shadows": shadows,
                "clip": from_light.astype(np.float32).ravel(),
            }
        height, width = frame.object_id.shape
        picture = Picture(
            np.empty((height, width, 4), np.uint8),
            np.empty((height, width), np.float32),
            np.empty((height, width), np.int32),
        )
        _native.shade(
            *(frame.color, frame.world_normal, frame.ndc_depth, frame.object_id),
            *(world.masks(with_links), light.numbers(), _lens(projection), *picture),
            **held,
        )
        return picture

    def _of_size(self, size: tuple[int, int]) -> _Engines:
        engines = self._engines.pop(size, None)
        if engines is None:
            engines = _Engines(*(Renderer(size, color_space="linear") for _ in range(2)))
        self._engines[size] = engines
        if len(self._engines) > _MOST_SIZES:
            del self._engines[next(iter(self._engines))]
        return engines


def _shifted(projection: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return a projection by which the middles of pixels show what is at their lower left."""
    shifted = projection.copy()
    shifted[0] += projection[3] / size[0]
    shifted[1] += projection[3] / size[1]
    return shifted


def _lens(projection: np.ndarray) -> np.ndarray:
    """Return whether a projection is parallel, and the numbers of its depths, (3,) float32."""
    is_parallel = projection[3, 2] == 0.0
    return np.array([is_parallel, projection[2, 3], projection[2, 2]], np.float32)


def _shadow_map(
    engine: Renderer, world: World, size: tuple[int, int], projection: np.ndarray, light: Light
) -> np.ndarray:
    """Return the least z / w from the light, (H, W) float32; infinite where nothing is.

    The map has the lens and the size of the picture, and shows all sides of what alpha hides, too.
    """
    world.camera.matrix = linalg.multiply(_shifted(projection, size), light.view())
    hidden = world.hidden()
    try:
        for node in hidden:
            node.visible = True
        frame = engine.render(
            world.scene, camera=world.viewpoint, outputs=("ndc_depth",), cull="none"
        )
    finally:
        for node in hidden:
            node.visible = False
    return frame.ndc_depth
