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
_MOST_SIZES = 4
_WHITE = np.uint32(0xFFFFFFFF)
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
        shade = None
        if shadows is not None:
            from_light = linalg.multiply(projection, light.view())
            shade = _shade(shadows, frame.world_position, from_light)
        shown = frame.object_id
        colors = _lit(frame.color, frame.world_normal, light, shade)
        np.copyto(colors.view(np.uint32)[..., 0], _WHITE, where=shown < 0)
        depths = _window_depths(frame.ndc_depth, projection)
        return Picture(colors, depths, world.masks(with_links)[shown])

    def _of_size(self, size: tuple[int, int]) -> _Engines:
        engines = self._engines.pop(size, None)
        if engines is None:
            engines = _Engines(*(Renderer(size, color_space="linear") for _ in _Engines._fields))
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
    own: np.ndarray, normals: np.ndarray, light: Light, shade: np.ndarray | None
) -> np.ndarray:
    """Return surfaces' own colours in light, with alpha 255, (H, W, 4) uint8.

    Each is ``own * (ambient + shade * (diffuse * n·l + specular * max(r_z, 0)²) * light)``, cut to
    a whole number; r is the light's direction mirrored by the normal, and z the world's.
    """
    colors = np.empty(own.shape, np.uint8)
    colors[..., 3] = 255
    facing = _reflected(normals, light)
    if shade is not None:
        facing *= shade
    if light.is_plain:
        facing += np.float32(light.ambient)
        lit = facing[..., np.newaxis]
        np.multiply(own[..., :3], lit, out=colors[..., :3], casting="unsafe")
        return colors
    for channel, strength in enumerate(light.color):
        lit = facing * np.float32(strength)
        lit += np.float32(light.ambient)
        lit *= own[..., channel]
        np.clip(lit, 0.0, 255.0, out=lit)
        colors[..., channel] = lit
    return colors


def _reflected(normals: np.ndarray, light: Light) -> np.ndarray:
    """Return the diffuse and the specular share of light, (H, W) float32."""
    x, y, z = (np.float32(part) for part in light.unit)
    upward = normals[..., 2]
    facing, other = normals[..., 0] * x, normals[..., 1] * y
    facing += other
    np.multiply(upward, z, out=other)
    facing += other
    np.multiply(upward, facing, out=other)
    other *= np.float32(2.0)
    other -= z
    np.maximum(other, 0.0, out=other)
    other *= other
    other *= np.float32(light.specular)
    np.maximum(facing, 0.0, out=facing)
    facing *= np.float32(light.diffuse)
    facing += other
    return facing


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
        place = ((height - 1) - _texel(y, w, height)) * width  # the lowest row is the last one
        place += _texel(x, w, width)
    z += w
    z *= np.float32(0.5)
    z -= np.float32(_BIAS)
    is_lit = shadows.ravel()[place] > z
    return np.where(is_lit, np.float32(1.0), np.float32(_SHADE))


def _texel(along: np.ndarray, w: np.ndarray, count: int) -> np.ndarray:
    """Return which of ``count`` texels coordinates in clip space are in, the nearest if in none."""
    place = along / w
    place += np.float32(1.0)
    place *= np.float32(0.5 * count)
    np.fmin(place, count - 1, out=place)  # unlike clip, these pass over NaN
    np.fmax(place, 0.0, out=place)
    return place.astype(np.int32)


def _row(positions: np.ndarray, row: np.ndarray) -> np.ndarray:
    """Return one coordinate in clip space of each pixel."""
    a, b, c, d = (np.float32(part) for part in row)
    total = positions[..., 0] * a
    total += positions[..., 1] * b
    total += positions[..., 2] * c
    total += d
    return total
