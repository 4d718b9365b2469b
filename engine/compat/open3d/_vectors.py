"""Vectors of the view control, in float64 by single operations, as Eigen has them for Open3D."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base import linalg
from ...errors import InvalidArgumentError

Vector = NDArray[np.float64]


def vector(value: ArrayLike, what: str) -> Vector:
    """Return three finite numbers; raise `InvalidArgumentError` if they are none."""
    try:
        numbers = np.array(value, np.float64).reshape(-1)
    except (TypeError, ValueError):
        numbers = np.zeros(0)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise InvalidArgumentError(f"{what} must be three finite numbers, not {value!r}")
    return numbers


def number(value: float, what: str) -> float:
    """Return a finite number; raise `InvalidArgumentError` if it is none."""
    try:
        given = float(value)
    except (TypeError, ValueError):
        given = math.nan
    if not math.isfinite(given):
        raise InvalidArgumentError(f"{what} must be a finite number, not {value!r}")
    return given


def dot(a: Vector, b: Vector) -> float:
    """Return the dot product."""
    x, y, z = (float(a[axis]) * float(b[axis]) for axis in range(3))
    return (x + y) + z


def unit(given: Vector) -> Vector:
    """Return a vector of length 1; zero stays zero, as Eigen's ``normalized`` leaves it."""
    squared = dot(given, given)
    return given / math.sqrt(squared) if squared > 0 else given


def turned(given: Vector, last: tuple[Vector, float], first: tuple[Vector, float]) -> Vector:
    """Turn a vector about two axes, as Eigen does by quaternions, also where axes have no unit."""
    (v, a), (w, b) = ((axis * sin(0.5 * angle), cos(0.5 * angle)) for axis, angle in (last, first))
    real, imaginary = a * b - dot(v, w), w * a + v * b + linalg.cross(v, w)
    across = 2.0 * linalg.cross(imaginary, given)
    return given + across * real + linalg.cross(imaginary, across)


def cos(angle: float) -> float:
    """Return the cosine, the same bits everywhere."""
    return float(linalg.cos(angle))


def sin(angle: float) -> float:
    """Return the sine, the same bits everywhere."""
    return float(linalg.sin(angle))


def tan_half(degrees: float) -> float:
    """Return the tangent of half an angle."""
    return float(linalg.tan(degrees * 0.5 / 180.0 * math.pi))
