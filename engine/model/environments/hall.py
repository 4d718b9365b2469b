"""The hall: a room with a wooden floor, plastered walls, tall windows on the right, and lamps.

Each pixel's ray is traced from the eye, at the origin, to the wall it hits.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._directions import directions, picture, ramp

Floats = NDArray[np.float64]

_HALF_WIDTH, _HALF_LENGTH = 5.0, 9.0  # metres, along x and z
_FLOOR, _CEILING = -1.5, 4.5
_WINDOW_PITCH, _HALF_WINDOW = 3.6, 1.1  # along z
_SILL, _TOP = -0.6, 3.3
_DAYLIGHT = (11.0, 12.0, 13.5)
_LAMP = (26.0, 17.0, 9.0)
_PLASTER, _WOOD, _CEILING_COLOR = (0.78, 0.66, 0.5), (0.44, 0.27, 0.14), (0.72, 0.66, 0.57)


class _Hit(NamedTuple):
    """The points where rays hit the room, and the walls hit."""

    x: Floats
    y: Floats
    z: Floats
    side: NDArray[np.bool_]  # the right or the left wall
    level: NDArray[np.bool_]  # floor or ceiling


def pixels() -> np.ndarray:
    """Return the picture, (H, W, 3) float32."""
    hit = _meet_room()
    window = np.where(hit.side & (hit.x > 0), _window(hit), 0.0)
    lamp = np.where(hit.level & (hit.y > 0), _lamps(hit), 0.0)
    sun = np.where(hit.level & (hit.y < 0), _sunlit(hit), 0.0)
    light = _brightness(hit)
    grain = _boards(hit)
    channels = []
    for k in range(3):
        floor = _WOOD[k] * grain * (light + sun * (7.0, 6.2, 4.8)[k])
        ceiling = _CEILING_COLOR[k] * 0.8 * light
        wall = _PLASTER[k] * light
        surface = np.where(hit.level, np.where(hit.y < 0, floor, ceiling), wall)
        surface = surface + (_DAYLIGHT[k] - surface) * window
        channels.append(surface + (_LAMP[k] - surface) * lamp)
    return picture(channels)


def _meet_room() -> _Hit:
    x, y, z = np.broadcast_arrays(*directions(512))
    tiny = 1e-9
    to_side = _HALF_WIDTH / np.maximum(np.abs(x), tiny)
    to_end = _HALF_LENGTH / np.maximum(np.abs(z), tiny)
    to_level = np.where(y < 0, -_FLOOR, _CEILING) / np.maximum(np.abs(y), tiny)
    away = np.minimum(np.minimum(to_side, to_end), to_level)
    return _Hit(x * away, y * away, z * away, away == to_side, away == to_level)


def _from_middle(z: Floats) -> Floats:
    """Return the distance along the hall from the middle of the nearest window."""
    shifted = z / _WINDOW_PITCH
    return np.abs(shifted - np.rint(shifted)) * _WINDOW_PITCH


def _window(hit: _Hit) -> Floats:
    """Return how much of each point is glass, 0..1: three panes a window, with a bar across."""
    off = _from_middle(hit.z)
    glass = ramp(_HALF_WINDOW, _HALF_WINDOW - 0.05, off)
    glass = glass * ramp(_SILL, _SILL + 0.05, hit.y) * ramp(_TOP, _TOP - 0.05, hit.y)
    upright = ramp(0.05, 0.07, np.abs(off - 0.37))
    across = ramp(0.05, 0.07, np.abs(hit.y - 2.0))
    return glass * (0.015 + 0.985 * upright * across)


def _lamps(hit: _Hit) -> Floats:
    """Return where the round ceiling lamps are, 0..1."""
    off = _WINDOW_PITCH / 2 - _from_middle(hit.z)
    square = np.minimum((hit.x - 1.8) ** 2, (hit.x + 1.8) ** 2) + off * off
    return ramp(0.09, 0.06, square)


def _sunlit(hit: _Hit) -> Floats:
    """Return where the sun falls onto the floor through the windows, 0..1."""
    slope = _HALF_WIDTH - hit.x  # from the wall
    height = _FLOOR + slope * 0.9  # at which the sun's ray passed through the wall
    off = _from_middle(hit.z + 0.45 * slope)
    lit = ramp(_HALF_WINDOW, _HALF_WINDOW - 0.12, off)
    lit = lit * ramp(_SILL, _SILL + 0.12, height) * ramp(_TOP, _TOP - 0.12, height)
    return lit * ramp(0.02, 0.1, np.abs(off - 0.37)) * ramp(0.02, 0.1, np.abs(height - 2.0))


def _brightness(hit: _Hit) -> Floats:
    """Return the light on the walls: brighter near the windows and under the lamps."""
    from_windows = _HALF_WIDTH - hit.x
    day = 1.5 / (1.0 + 0.16 * from_windows * from_windows)
    day = np.where(hit.side & (hit.x > 0), 0.22, day)  # their own wall is against the light
    lamps = 0.3 * ramp(_FLOOR, _CEILING, hit.y) + 0.15
    corner = ramp(0.0, 0.8, _CEILING - hit.y) * ramp(0.0, 0.5, hit.y - _FLOOR)
    corner = corner + (1.0 - corner) * hit.level
    return (day + lamps) * (0.72 + 0.28 * corner)


def _boards(hit: _Hit) -> Floats:
    """Return the shades of the floor boards, with dark joints between them."""
    number = np.floor(hit.x / 0.22)
    shade = number * 0.6180339887498949
    shade = 0.8 + 0.4 * (shade - np.floor(shade))
    joint = np.abs(hit.x / 0.22 - number - 0.5)
    near = ramp(14.0, 4.0, np.abs(hit.x) + np.abs(hit.z))
    return 1.0 + (shade * (1.0 - 0.45 * ramp(0.46, 0.5, joint)) - 1.0) * near
