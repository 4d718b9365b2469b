"""Pictures of a world, lit as TinyRenderer does.

In: a `World`, a camera, a `Light`. Out: colours, depths and masks. The engine finds what shows at
each pixel; NumPy shades it in float32, so that bytes are the same on every machine. TinyRenderer
samples at the lower left corner of a pixel, and so does this. Source: TinyRenderer.cpp of Bullet
3.2.7.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...rendering.renderer import Renderer
from ._light import Light
from ._world import World

# A shadow leaves this much of the light; a surface this much nearer than the map is lit.
_SHADE, _BIAS = 0.8, 0.05
_MOST_RENDERERS = 4
_OUTPUTS = ("object_id", "ndc_depth", "world_normal", "albedo")


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


class Painter:
    """Draws pictures; keeps the memory of the last few sizes."""

    def __init__(self) -> None:
        self._renderers: dict[tuple[int, int], Renderer] = {}

    def draw(
        self,
        world: World,
        size: tuple[int, int],
        projection: np.ndarray,
        view: np.ndarray,
        light: Light,
    ) -> Picture:
        """Return a picture of a world that is up to date.

        Parameters
        ----------
        world : World
        size : (int, int)
        projection, view : (4, 4) float64
        light : Light
        """
        engine, shade, shadows = self._engine(size), None, None
        if light.shadow:
            shadows = _shadow_map(engine, world, size, projection, light)
        world.camera.matrix = linalg.multiply(_shifted(projection, size), view)
        outputs = _OUTPUTS if shadows is None else (*_OUTPUTS, "world_position")
        frame = engine.render(world.scene, camera=world.viewpoint, outputs=outputs, cull="back")
        if shadows is not None:
            from_light = linalg.multiply(projection, light.view())
            shade = _shade(shadows, frame.world_position, from_light)
        shown = frame.object_id
        colors = _lit(frame.albedo, frame.world_normal, light, shade)
        colors[shown < 0] = 255
        depths = _window_depths(frame.ndc_depth, projection)
        return Picture(colors, depths, world.masks[shown])

    def _engine(self, size: tuple[int, int]) -> Renderer:
        engine = self._renderers.pop(size, None) or Renderer(size, color_space="linear")
        self._renderers[size] = engine
        if len(self._renderers) > _MOST_RENDERERS:
            del self._renderers[next(iter(self._renderers))]
        return engine


def _shifted(projection: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return a projection by which the middles of pixels show what is at their lower left."""
    shifted = projection.copy()
    shifted[0] += projection[3] / size[0]
    shifted[1] += projection[3] / size[1]
    return shifted


def _clip_depths(depths: np.ndarray, projection: np.ndarray) -> np.ndarray:
    """Return z in clip space for z / w; infinite where nothing is."""
    if projection[3, 2] == 0.0:
        return depths
    scale = np.float32(projection[2, 3])
    with np.errstate(all="ignore"):
        return np.where(
            depths < np.inf, depths * scale / (depths + np.float32(projection[2, 2])), depths
        )


def _window_depths(depths: np.ndarray, projection: np.ndarray) -> np.ndarray:
    """Return what PyBullet computes of depths: those of OpenGL, for any perspective."""
    if projection[3, 2] != 0.0:
        return np.minimum(depths, np.float32(1.0)) * np.float32(0.5) + np.float32(0.5)
    near = projection[2, 3] / (projection[2, 2] - 1.0)
    far = projection[2, 3] / (projection[2, 2] + 1.0)
    held = np.where(depths < np.inf, depths.astype(np.float64), far)
    whole = far * (near + held) / (2.0 * far * near + far * held - near * held)
    return whole.astype(np.float32)


def _lit(
    albedo: np.ndarray, normals: np.ndarray, light: Light, shade: np.ndarray | None
) -> np.ndarray:
    """Return colours with alpha, (H, W, 4) uint8.

    Each is ``color * (ambient + shade * (diffuse * n·l + specular * max(r_z, 0)²) * light)``, cut
    to a whole number; r is the light's direction mirrored by the normal, and z the world's.
    """
    x, y, z = (np.float32(part) for part in light.unit)
    facing = normals[..., 0] * x
    facing += normals[..., 1] * y
    facing += normals[..., 2] * z
    mirrored = normals[..., 2] * facing
    mirrored *= np.float32(2.0)
    mirrored -= z
    np.maximum(mirrored, 0.0, out=mirrored)
    mirrored *= mirrored
    mirrored *= np.float32(light.specular)
    np.maximum(facing, 0.0, out=facing)
    facing *= np.float32(light.diffuse)
    facing += mirrored
    if shade is not None:
        facing *= shade
    colors = np.empty((*facing.shape, 4), np.uint8)
    colors[..., 3] = 255
    for channel, strength in enumerate(light.color):
        # TinyRenderer cuts the surface's own colour to whole numbers, too.
        own = np.floor(albedo[..., channel] * np.float32(255.0) + np.float32(0.002))
        lit = facing * np.float32(strength)
        lit += np.float32(light.ambient)
        lit *= own
        np.clip(lit, 0.0, 255.0, out=lit)
        colors[..., channel] = lit
    return colors


def _shadow_map(
    engine: Renderer, world: World, size: tuple[int, int], projection: np.ndarray, light: Light
) -> np.ndarray:
    """Return the least z in clip space from the light, (H, W) float32; infinite where nothing is.

    The map has the lens and the size of the picture, and shows all sides of what alpha hides, too.
    """
    world.camera.matrix = linalg.multiply(_shifted(projection, size), light.view())
    hidden = world.hidden()
    for node in hidden:
        node.visible = True
    frame = engine.render(world.scene, camera=world.viewpoint, outputs=("ndc_depth",), cull="none")
    for node in hidden:
        node.visible = False
    return _clip_depths(frame.ndc_depth, projection)


def _shade(shadows: np.ndarray, positions: np.ndarray, light_clip: np.ndarray) -> np.ndarray:
    """Return the share of light that reaches each pixel, (H, W) float32."""
    height, width = shadows.shape
    x, y, z, w = (_row(positions, row) for row in light_clip)
    with np.errstate(all="ignore"):
        across = (x / w + 1.0) * (0.5 * width)
        up = (y / w + 1.0) * (0.5 * height)
    columns = np.clip(np.nan_to_num(across), 0, width - 1).astype(np.int32)
    rows = (height - 1) - np.clip(np.nan_to_num(up), 0, height - 1).astype(np.int32)
    nearest = shadows[rows, columns]
    is_lit = nearest > (z + w) * np.float32(0.5) - np.float32(_BIAS)
    return np.where(is_lit, np.float32(1.0), np.float32(_SHADE))


def _row(positions: np.ndarray, row: np.ndarray) -> np.ndarray:
    """Return one coordinate in clip space of each pixel."""
    a, b, c, d = (np.float32(part) for part in row)
    total = positions[..., 0] * a
    total += positions[..., 1] * b
    total += positions[..., 2] * c
    total += d
    return total
