"""The sky: blue above, hazy at the horizon, brighter around the sun; bare ground below."""

from __future__ import annotations

import numpy as np

from ._directions import directions, picture, ramp, toward

_SUN = (0.62, 0.72, 0.5)  # direction towards the sun
_ZENITH, _HORIZON = (0.11, 0.26, 0.66), (0.62, 0.77, 0.95)
_GROUND, _FAR_GROUND = (0.20, 0.175, 0.14), (0.40, 0.42, 0.42)
_GLOW = (1.0, 0.92, 0.78)
_DISC = (9.2e3, 8.6e3, 7.4e3)
# Cosines at the disc's edge and core, 1 degree and slightly less from its centre: wider than the
# true sun so that pixels resolve it, and dimmer in proportion.
_EDGE, _CORE = 0.99982, 0.99988


def pixels() -> np.ndarray:
    """Return the picture, (H, W, 3) float32."""
    rays = directions(512)
    y, sun = rays[1], toward(_SUN, rays)
    up = np.clip(y, 0.0, 1.0)
    low = 1.0 - up
    haze = low * low * low * low
    ahead = np.clip(sun, 0.0, 1.0)
    halo = 0.5 * _power(ahead, 3) + 1.2 * _power(ahead, 7) + 6.0 * _power(ahead, 11)
    disc = ramp(_EDGE, _CORE, sun)
    above = ramp(-0.012, 0.004, y)
    far = _power(1.0 - np.clip(-y, 0.0, 1.0), 4)
    channels = []
    for zenith, horizon, ground, distant, glow, light in zip(
        _ZENITH, _HORIZON, _GROUND, _FAR_GROUND, _GLOW, _DISC, strict=True
    ):
        sky = zenith + (horizon - zenith) * haze + glow * (0.35 * halo)
        earth = ground + (distant - ground) * far
        channels.append(earth + (sky - earth) * above + light * disc)
    return picture(channels)


def _power(value: np.ndarray, doublings: int) -> np.ndarray:
    """Return value to the power of 2**doublings."""
    for _ in range(doublings):
        value = value * value
    return value
