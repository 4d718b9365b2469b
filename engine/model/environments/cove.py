"""The cove: what surfaces reflect in the look `studio`, where a model stands on a light ground.

Dark grey walls, a floor about as light as the ground that the viewer sees, and soft boxes. These
give metals and varnish something bright to reflect, but light matt surfaces little: most light
comes from the look's lights, which cast shadows.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ._directions import directions, panel, picture, ramp, toward

# Panels: centre, half width and height, width of the soft edge, radiance.
_KEY = ((3.0, 2.6, 2.4), 1.15, 1.0, 0.15), (8.0, 7.8, 7.5)
_FILL = ((-3.6, 1.2, 1.4), 0.7, 1.6, 0.2), (2.6, 2.8, 3.1)
_RIM = ((-1.6, 2.2, -3.4), 0.3, 1.3, 0.08), (7.0, 7.1, 7.4)
_STRIP = ((0.4, 4.0, -0.8), 2.1, 0.4, 0.1), (6.0, 6.0, 6.0)
_ROWS = 128  # its soft shapes look the same with more
#: The picture's light as coefficients of a `LightProbe`.
PROBE = (
    (2.229, 2.219, 2.202),
    (0.546, 0.548, 0.556),
    (0.312, 0.306, 0.293),
    (0.262, 0.231, 0.183),
    (0.447, 0.421, 0.380),
    (0.216, 0.206, 0.186),
    (-0.183, -0.189, -0.196),
    (0.499, 0.475, 0.443),
    (-0.031, -0.021, -0.007),
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
    walls = 0.10 + 0.14 * ramp(0.9, -0.15, y)  # darker above
    walls = walls + 0.24 * ramp(-0.4, 0.9, 0.5 * x + 0.86 * z)  # lighter behind the viewer
    floor = 0.66 - 0.26 * ramp(-0.05, -1.0, y)
    grey = walls + (floor - walls) * ramp(0.12, -0.3, y)
    channels = [grey * tone for tone in (1.0, 0.99, 0.97)]
    for shape, color in (_KEY, _FILL, _RIM, _STRIP):
        inside = panel(*shape, rays)
        channels = [c + (light - c) * inside for c, light in zip(channels, color, strict=True)]
    return picture(channels)
