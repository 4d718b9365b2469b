"""The projection of a camera onto paper.

In: a camera, its pose, the paper's frame. Out: places on the paper and depths; planes that clip;
the homogeneous point from which all is seen. All is float64: drawings are the same everywhere.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.linalg import single
from ...errors import InvalidArgumentError
from ...model.scene.cameras import Camera
from ...model.scene.lenses.lens_camera import LensCamera

#: The least w, as a share of the largest: nothing may be drawn behind the viewer.
_LEAST_W = 2.0**-30


class Projection(NamedTuple):
    """A projection from the world to paper.

    Attributes
    ----------
    clip_from_world : (4, 4) float64
    size : (float, float)
        Width and height of the frame on paper, in millimetres; x right, y down.
    is_parallel : bool
    """

    clip_from_world: NDArray[np.float64]
    size: tuple[float, float]
    is_parallel: bool

    def eye(self) -> list[float]:
        """Return the viewer's position and 1, or the direction to him and 0, up to a factor."""
        x, y, depth, w = self.clip_from_world.tolist()
        cofactors = (_determinant(*(row[:k] + row[k + 1 :] for row in (x, y, w))) for k in range(4))
        signed = [-one if k % 2 else one for k, one in enumerate(cofactors)]
        largest = max(map(abs, signed)) or math.nan
        eye = [one / largest for one in signed]
        if self.is_parallel:
            eye[3] = 0.0
            is_toward = single.dot(depth[:3], eye[:3]) < 0.0
        else:
            is_toward = eye[3] > 0.0
        return eye if is_toward else [-one for one in eye]

    def on_paper(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return x, y, 1 / w and depth of places (N, 3) whose w is positive: (N, 4)."""
        x, y, depth, w = (linalg.dot(places, row[:3]) + row[3] for row in self.clip_from_world)
        width, height = self.size
        inverse = 1.0 / w
        across, down = (x * inverse + 1.0) * (0.5 * width), (1.0 - y * inverse) * (0.5 * height)
        return np.stack([across, down, inverse, depth if self.is_parallel else -inverse], axis=1)

    def planes(self, bounds: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the planes (K, 4) before which something is drawn, for a box (2, 3)."""
        _, _, depth, w = self.clip_from_world
        if self.is_parallel:
            return np.array([w + depth, w - depth])
        reach = np.abs(w[:3]) * np.abs(bounds).max(axis=0)
        least = w.copy()
        least[3] -= _LEAST_W * (float(reach.sum()) + abs(float(w[3])))
        return np.array([w + depth, w - depth, least])


def _determinant(a: list[float], b: list[float], c: list[float]) -> float:
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def matrix_of(camera: Camera, pixels: tuple[int, int]) -> NDArray[np.float64]:
    """Return what a camera projects by, (4, 4), at the aspect of a picture of so many pixels.

    Raises
    ------
    InvalidArgumentError
        The camera is a lens, which bends lines.
    """
    if isinstance(camera, LensCamera):
        raise InvalidArgumentError(
            f"lines are drawn straight, so not through a {type(camera).__name__}: use a pinhole "
            "or a parallel camera, or draw a picture"
        )
    return np.asarray(camera.projection(pixels), np.float64)


def projection_onto(
    size: tuple[float, float], matrix: NDArray[np.float64], pose: NDArray[np.float64]
) -> Projection:
    """Return a projection onto a frame.

    Parameters
    ----------
    size : (float, float)
        Of the frame, in millimetres.
    matrix : (4, 4) float64
        As of `matrix_of`.
    pose : (4, 4) float64
        world-from-camera.
    """
    w = matrix[3]
    is_parallel = not w[:3].any()
    matrix = matrix / (float(w[3]) if is_parallel else float(np.abs(w).max()))
    return Projection(linalg.multiply(matrix, linalg.inverse(pose)), size, is_parallel)
