"""The studio: grey walls, a light floor that reaches up behind, two soft boxes and a strip."""

from __future__ import annotations

import numpy as np

from ._directions import directions, ramp, room

# Panels: centre, half width and height, width of the soft edge, radiance.
_KEY = ((3.0, 2.4, 2.6), 1.5, 1.3, 0.15), (9.0, 8.8, 8.4)
_FILL = ((-3.6, 1.2, 1.4), 1.0, 1.7, 0.2), (2.6, 2.8, 3.1)
_RIM = ((-1.6, 2.2, -3.4), 0.35, 1.4, 0.08), (7.0, 7.1, 7.4)
_STRIP = ((0.4, 4.0, -0.8), 2.2, 0.45, 0.1), (6.0, 6.0, 6.0)


def pixels() -> np.ndarray:
    """Return the picture, (H, W, 3) float32."""
    rays = directions(256)  # its soft shapes look the same with more
    y = rays[1]
    walls = 0.16 + 0.22 * ramp(0.9, -0.15, y)  # darker above
    floor = 0.62 - 0.22 * ramp(-0.05, -1.0, y)
    grey = walls + (floor - walls) * ramp(0.12, -0.3, y)
    return room(grey, (_KEY, _FILL, _RIM, _STRIP), rays)
