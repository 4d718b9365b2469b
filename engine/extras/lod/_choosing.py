"""Chooses levels of detail: the coarsest with a small error on the screen, without flicker.

In: a camera, distances, errors in object units. Out: level numbers.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ...base.image_size import check_size
from ...base.numbers import real, shown
from ...base.validation import matrix4
from ...errors import InvalidArgumentError
from ...model.scene.cameras import Camera


def checked_view(
    camera: Camera, pose: ArrayLike, size: tuple[int, int]
) -> tuple[np.ndarray, tuple[int, int]]:
    """Return the viewer's pose and picture size, checked."""
    if not isinstance(camera, Camera):
        raise InvalidArgumentError(f"camera must be a Camera, not {type(camera).__name__}")
    return matrix4(pose, "pose"), check_size(size)


def pixels_a_unit(camera: Camera, size: tuple[int, int], distances: np.ndarray) -> np.ndarray:
    """Return the pixels per unit at some distances from the eye, (N,).

    Without perspective it is the same everywhere.
    """
    projection = camera.projection(size)
    pixels = abs(float(projection[1, 1])) * size[1] * 0.5
    if float(projection[3, 3]) == 0.0:
        return pixels / np.maximum(distances, 1e-9)
    return np.full(len(distances), pixels)


def choose_levels(
    last: np.ndarray, errors: np.ndarray, limit: float, hysteresis: float
) -> np.ndarray:
    """Return the levels to draw: refine too coarse ones, coarsen others only by a margin.

    Parameters
    ----------
    last : (N,) int
        The previous levels.
    errors : (levels, N) float64
        Errors on the screen, in pixels.
    limit : float
        The largest error, in pixels.
    hysteresis : float
        A level turns coarser only where its error is then below ``limit * (1 - hysteresis)``.
    """
    fine_enough = _coarsest(errors, limit)
    safely = _coarsest(errors, limit * (1.0 - hysteresis))
    return np.maximum(np.minimum(last, fine_enough), safely)


def _coarsest(errors: np.ndarray, limit: float) -> np.ndarray:
    """Return the last level of each column up to which no error exceeds the limit."""
    return (np.cumprod(errors[1:] <= limit, axis=0)).sum(axis=0)


def check_limits(hysteresis: float, **limits: float) -> None:
    """Raise `InvalidArgumentError` unless the limit in pixels and the hysteresis are valid."""
    for name, value in limits.items():
        if not 0.0 < real(value) < math.inf:
            raise InvalidArgumentError(f"{name} must be greater than 0, not {shown(value)}")
    if not 0.0 <= real(hysteresis) < 1.0:
        raise InvalidArgumentError(f"hysteresis must be from 0 to below 1, not {shown(hysteresis)}")


def check_errors(errors: Sequence[float]) -> None:
    """Raise `InvalidArgumentError` unless errors start with 0, never decrease and are finite."""
    if (
        not errors
        or errors[0] != 0.0
        or errors != sorted(errors)
        or not all(map(math.isfinite, errors))
    ):
        raise InvalidArgumentError("the errors of levels must begin with 0 and never decrease")
