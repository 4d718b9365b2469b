"""The cove: what surfaces reflect in the look `studio`, where a model stands on a light ground.

Dark grey walls, a floor about as light as the ground that the viewer sees, and soft boxes. These
give metals and varnish something bright to reflect, but light matt surfaces little: most light
comes from the look's lights, which cast shadows.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ._directions import directions, ramp, room, toward

# Panels: centre, half width and height, width of the soft edge, radiance.
_KEY = ((3.0, 2.6, 2.4), 1.0, 0.9, 0.15), (9.0, 8.8, 8.4)
_FILL = ((-3.6, 1.2, 1.4), 0.7, 1.6, 0.2), (2.6, 2.8, 3.1)
_RIM = ((-1.6, 2.2, -3.4), 0.3, 1.3, 0.08), (7.0, 7.1, 7.4)
_STRIP = ((0.4, 4.0, -0.8), 2.1, 0.4, 0.1), (4.5, 4.5, 4.5)
_ROWS = 128  # its soft shapes look the same with more
#: The picture's light as coefficients of a `LightProbe`.
PROBE = (
    (2.037, 2.030, 2.014),
    (0.350, 0.355, 0.363),
    (0.282, 0.278, 0.264),
    (0.191, 0.163, 0.115),
    (0.361, 0.338, 0.296),
    (0.205, 0.197, 0.176),
    (-0.134, -0.140, -0.147),
    (0.441, 0.420, 0.387),
    (0.036, 0.047, 0.061),
)
#: What a rough dielectric reflects of it, about the same in all directions.
SHEEN = 0.014


def pixels(axes: Sequence[NDArray[np.float64]]) -> NDArray[np.float32]:
    """Return the picture, (H, W, 3) float32.

    Parameters
    ----------
    axes : (3,) sequence of (3,) ndarray
        What stands to the right, above and behind the viewer: each along one axis of the world.
    """
    world = directions(_ROWS)
    rays = [toward(axis.tolist(), world) for axis in axes]
    x, y, z = rays
    walls = 0.08 + 0.10 * ramp(0.9, -0.15, y)  # darker above
    walls = walls + 0.22 * ramp(-0.4, 0.9, 0.5 * x + 0.86 * z)  # lighter behind the viewer
    floor = 0.66 - 0.26 * ramp(-0.05, -1.0, y)
    grey = walls + (floor - walls) * ramp(0.12, -0.3, y)
    return room(grey, (_KEY, _FILL, _RIM, _STRIP), (rays[0], rays[1], rays[2]))
