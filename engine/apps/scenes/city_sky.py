"""The sky over the city: by day, or with the sun about to set.

In: the direction to the sun, and colours in linear light. Out: an `Environment` for the background.
Above the horizon the colour goes from the horizon's to the zenith's; round the sun it is as bright
as haze is. Below the horizon the land goes on as far as haze lets one see: the city is no island.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...model.environments.environment import Environment

_ROWS, _COLUMNS = 256, 512


class Sky(NamedTuple):
    """Colours of a sky, linear.

    Attributes
    ----------
    zenith, horizon, land, glow : tuple of 3 float
        ``land`` is below the horizon; ``glow`` is added round the sun.
    spread : float
        How far the glow reaches: its share is left of 1 at half a turn from the sun.
    disc : float
        How much brighter than the glow the sun's disc is; 0 for none.
    """

    zenith: tuple[float, float, float]
    horizon: tuple[float, float, float]
    land: tuple[float, float, float]
    glow: tuple[float, float, float]
    spread: float
    disc: float


DAY = Sky((0.10, 0.24, 0.56), (0.56, 0.70, 0.86), (0.13, 0.20, 0.07), (0.30, 0.26, 0.18), 0.02, 6.0)
DUSK = Sky(
    (0.02, 0.05, 0.14), (0.20, 0.19, 0.30), (0.030, 0.042, 0.026), (1.0, 0.36, 0.09), 0.05, 2.0
)
#: Cosine of the half angle of the sun's disc, as hazy air shows it.
_DISC = 0.9997
#: How fast land appears below the horizon.
_CLEARNESS = 8.0


def sky(colors: Sky, to_sun) -> Environment:
    """Return the environment of a sky with the sun in a direction, (3,)."""
    up, directions = _directions()
    toward = linalg.dot(directions, linalg.normalize(to_sun))
    # most of the change is near the horizon
    height = np.sqrt(np.clip(up, 0.0, 1.0))[..., np.newaxis]
    above = np.array(colors.horizon) * (1.0 - height) + np.array(colors.zenith) * height
    # Henyey and Greenstein, 1941: a peak toward the sun with a wide foot.
    forward = 1.0 - math.sqrt(colors.spread)
    glow = (1.0 - forward) ** 2 / (1.0 + forward * forward - 2.0 * forward * toward)
    low = np.clip(1.0 - up * 1.5, 0.2, 1.0)  # haze is near the ground
    above = above + (glow * low)[..., np.newaxis] * np.array(colors.glow)
    above += ((toward > _DISC) * colors.disc)[..., np.newaxis] * np.array(colors.glow)
    clear = 1.0 + _CLEARNESS * np.maximum(-up, 0.0)[..., np.newaxis]
    haze = 1.0 / (clear * clear)
    return Environment(above * haze + np.array(colors.land) * (1.0 - haze), name="city sky")


def _directions() -> tuple[np.ndarray, np.ndarray]:
    """Return how high each pixel looks, (H, W), and its direction, (H, W, 3)."""
    rows = (0.5 - (np.arange(_ROWS) + 0.5) / _ROWS) * np.pi
    columns = ((np.arange(_COLUMNS) + 0.5) / _COLUMNS - 0.5) * 2.0 * np.pi
    up, level = linalg.sin(rows)[:, np.newaxis], linalg.cos(rows)[:, np.newaxis]
    up = np.broadcast_to(up, (_ROWS, _COLUMNS))
    parts = level * linalg.cos(columns), up, level * linalg.sin(columns)
    return up, np.stack(parts, axis=-1)
