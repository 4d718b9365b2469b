"""The grid under the model, as lines in the scene.

In: the scene's bounds and up direction. Out: a `Mesh` of lines with a colour a vertex, world space.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.scene.orbiting import home_axes
from ..views.viewpoint import Sphere

MINOR_COLOR = (92, 96, 104, 255)
MAJOR_COLOR = (140, 146, 158, 255)
#: The grid's half side in radii, and its approximate number of squares.
REACH = 1.6
SQUARES = 20
MAJOR_EVERY = 5


def grid_step(radius: float) -> float:
    """Return a round distance (1, 2 or 5 times a power of ten) between the grid's lines."""
    rough = 2 * REACH * radius / SQUARES
    power = 10.0 ** math.floor(math.log10(rough))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= rough * 0.999)


def grid(lowest: float, sphere: Sphere, up: ArrayLike) -> Mesh:
    """Return a square grid under the scene.

    Parameters
    ----------
    lowest : float
        Height of the grid along the up direction.
    sphere : Sphere
        The scene's bounding sphere; determines the grid's size.
    up : (3,) sequence of float
        The world's up direction, perpendicular to the grid.

    Returns
    -------
    Mesh
        Lines only.
    """
    right, upward, back = home_axes(up)
    step = grid_step(sphere.radius)
    count = math.ceil(REACH * sphere.radius / step)
    count += -count % MAJOR_EVERY
    middle = np.array(sphere.center)
    along = [round(float(linalg.dot(axis, middle)) / step) for axis in (right, back)]
    positions, colors = [], []
    for k in range(-count, count + 1):
        color = MAJOR_COLOR if k % MAJOR_EVERY == 0 else MINOR_COLOR
        for a, b in (((k, -count), (k, count)), ((-count, k), (count, k))):
            for u, v in (a, b):
                offset = right * ((along[0] + u) * step) + back * ((along[1] + v) * step)
                positions.append(offset + upward * lowest)
                colors.append(color)
    lines = np.arange(len(positions), dtype=np.int32).reshape(-1, 2)
    return Mesh(
        np.array(positions, dtype=np.float32),
        lines=lines,
        colors=np.array(colors, dtype=np.uint8),
        name="grid",
    )
