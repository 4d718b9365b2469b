"""The parts of built-in environments: directions of pixels, soft shapes, boxes.

Only IEEE additions, multiplications, divisions and square roots are used, and the project's own
sine and cosine, so that the pictures have the same bytes on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from ...base import linalg

Floats = NDArray[np.float64]
#: The arguments of `panel` but its rays, and linear light.
Shape = tuple[tuple[float, float, float], float, float, float]
Color = tuple[float, float, float]


def directions(height: int) -> tuple[Floats, Floats, Floats]:
    """Return x, y and z of the pixels' directions, which broadcast to (height, 2 * height)."""
    width = 2 * height
    azimuth = ((np.arange(width) + 0.5) / width - 0.5) * (2 * math.pi)
    elevation = (0.5 - (np.arange(height) + 0.5) / height) * math.pi
    level = linalg.cos(elevation)[:, np.newaxis]
    return (
        level * linalg.cos(azimuth),
        linalg.sin(elevation)[:, np.newaxis],
        level * linalg.sin(azimuth),
    )


def ramp(low: float, high: float, value: Floats) -> Floats:
    """Rise smoothly from 0 at ``low`` to 1 at ``high``; low may be the greater one."""
    t = np.clip((value - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def toward(direction: Sequence[float], rays: Sequence[Floats]) -> Floats:
    """Return the cosines between rays and a direction of any length."""
    length = math.sqrt(sum(component * component for component in direction))
    x, y, z = (component / length for component in direction)
    return (rays[0] * x + rays[1] * y) + rays[2] * z


def panel(
    center: Sequence[float],
    half_width: float,
    half_height: float,
    soft: float,
    rays: Sequence[Floats],
) -> Floats:
    """Return how much of an upright panel each ray hits, 0..1.

    Parameters
    ----------
    center : 3 floats
        It faces the origin.
    half_width, half_height : float
    soft : float
        Width of its edge.
    rays : x, y, z
    """
    distance = math.sqrt(sum(component * component for component in center))
    normal = [component / distance for component in center]
    level = math.sqrt(normal[0] ** 2 + normal[2] ** 2)
    across = (-normal[2] / level, 0.0, normal[0] / level) if level > 1e-9 else (1.0, 0.0, 0.0)
    up = (
        normal[1] * across[2] - normal[2] * across[1],
        normal[2] * across[0] - normal[0] * across[2],
        normal[0] * across[1] - normal[1] * across[0],
    )
    facing = toward(normal, rays)
    scale = distance / np.where(facing > 1e-3, facing, 1.0)
    along = np.abs(toward(across, rays) * scale)
    above = np.abs(toward(up, rays) * scale)
    inside = ramp(half_width, half_width - soft, along) * ramp(
        half_height, half_height - soft, above
    )
    return np.where(facing > 1e-3, inside, 0.0)


def picture(channels: Sequence[Floats]) -> NDArray[np.float32]:
    """Return channels, which broadcast to the picture's size, as (H, W, 3) float32."""
    shape = np.broadcast_shapes(*(channel.shape for channel in channels))
    out = np.empty((*shape, 3), np.float32)
    for number, channel in enumerate(channels):
        out[:, :, number] = channel
    return out


def room(
    grey: Floats, panels: Iterable[tuple[Shape, Color]], rays: tuple[Floats, Floats, Floats]
) -> NDArray[np.float32]:
    """Return the picture, (H, W, 3) float32, of a warm grey room with panels.

    Parameters
    ----------
    grey : ndarray
        The room's light without panels, of each pixel.
    panels : iterable of (Shape, (3,) tuple)
        For each the arguments of `panel`, and its light.
    rays : (3,) sequence of ndarray
        Those of `directions`.
    """
    channels = [grey * tone for tone in (1.0, 0.99, 0.97)]
    for shape, color in panels:
        inside = panel(*shape, rays)
        channels = [c + (light - c) * inside for c, light in zip(channels, color, strict=True)]
    return picture(channels)
