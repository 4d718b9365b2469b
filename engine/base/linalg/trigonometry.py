"""Sine, cosine, tangent and arc tangent with the same bits on every processor.

In: scalars or arrays, angles in radians. Out: float64, within 2 ulps of the exact value.
``libm`` and NumPy choose among variants at run time (with or without FMA or SIMD) that differ in
the last bit, so geometry built on them differs between machines. This module uses only IEEE
additions and multiplications in a fixed order. Method: Cody and Waite's argument reduction to
[-pi/4, pi/4], then Taylor's series; the arc tangent by its addition theorem from nine tabulated
values, then its series.
"""

from __future__ import annotations

import functools
import math
from typing import overload

import numpy as np
import numpy.typing as npt

from ...errors import InvalidArgumentError
from ..numbers import floats, shown
from ..validation import whole_number

FloatArray = npt.NDArray[np.float64]

# pi/2 as a sum of three doubles. The first two have at most 33 significant bits, so that their
# products with a quadrant number below 2**20 are exact.
_HALF_PI_HIGH = float.fromhex("0x1.921fb544p+0")
_HALF_PI_MIDDLE = float.fromhex("0x1.0b4611a6p-34")
_HALF_PI_LOW = float.fromhex("0x1.3198a2e037073p-69")
_REDUCTION_LIMIT = 2.0**20
_MOST_POINTS = 2**24  # of a circle
_MOST_KEPT = 2**10  # points of a polygon that is computed once

# Coefficients of x**3, x**5, ... and of x**4, x**6, ...; the first omitted term is below 2**-60.
_SINE_TERMS = tuple((-1.0) ** k / math.factorial(2 * k + 1) for k in range(1, 9))
_COSINE_TERMS = tuple((-1.0) ** k / math.factorial(2 * k) for k in range(2, 9))

# Arc tangents of 0/8 ... 8/8, and the coefficients of t**3, t**5, ... for |t| <= 1/16.
_ARC_TANGENTS = np.array(
    (
        0.0,
        0.12435499454676144,
        0.24497866312686414,
        0.35877067027057225,
        0.4636476090008061,
        0.5585993153435624,
        0.6435011087932844,
        0.7188299996216245,
        0.7853981633974483,
    )
)
_ARC_TANGENT_TERMS = tuple((-1.0) ** k / (2 * k + 1) for k in range(1, 8))


def _reduce(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Split angles into the quadrant number 0..3 and a remainder in [-pi/4, pi/4]."""
    # A quadrant number beyond 2**20 would lose bits. There, reduction by the double nearest to 2*pi
    # costs less than the angle's own rounding.
    turned = np.where(np.abs(angle) < _REDUCTION_LIMIT, angle, np.fmod(angle, 2.0 * math.pi))
    count = np.rint(turned * (2.0 / math.pi))
    rest = turned - count * _HALF_PI_HIGH - count * _HALF_PI_MIDDLE - count * _HALF_PI_LOW
    return np.mod(count, 4.0), rest


def _reduce_single(angle: float) -> tuple[float, float]:
    turned = angle if abs(angle) < _REDUCTION_LIMIT else math.fmod(angle, 2.0 * math.pi)
    count = turned * (2.0 / math.pi)
    count = math.copysign(round(count), count)
    rest = turned - count * _HALF_PI_HIGH - count * _HALF_PI_MIDDLE - count * _HALF_PI_LOW
    return count % 4.0, rest


def _horner_single(x: float, coefficients: tuple[float, ...]) -> float:
    total = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        total = total * x + coefficient
    return total


def _horner(x: FloatArray, coefficients: tuple[float, ...]) -> FloatArray:
    total = np.full_like(x, coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        total = total * x + coefficient
    return total


def _sine_cosine_single(angle: float) -> tuple[float, float]:
    """Return the results of `_sine_cosine` for one finite float: the same bits, much faster."""
    quadrant, x = _reduce_single(angle)
    square = x * x
    sine = x + x * square * _horner_single(square, _SINE_TERMS)
    half = 0.5 * square
    leading = 1.0 - half
    cosine = leading + (
        ((1.0 - leading) - half) + square * square * _horner_single(square, _COSINE_TERMS)
    )
    if quadrant in (1.0, 3.0):
        sine, cosine = cosine, sine
    if quadrant >= 2.0:
        sine = -sine
    return sine, -cosine if quadrant in (1.0, 2.0) else cosine


def _sine_cosine(angle: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
    if isinstance(angle, float) and math.isfinite(angle):
        return _sine_cosine_single(float(angle))
    angle = floats(angle, "angle")
    with np.errstate(invalid="ignore"):  # infinite angles give NaN, as in NumPy
        quadrant, x = _reduce(angle)
        square = x * x
        sine = x + x * square * _horner(square, _SINE_TERMS)
        half = 0.5 * square
        leading = 1.0 - half
        # The second summand is the rounding error of the subtraction above.
        cosine = leading + (
            ((1.0 - leading) - half) + square * square * _horner(square, _COSINE_TERMS)
        )
    swapped = (quadrant == 1.0) | (quadrant == 3.0)
    sine, cosine = np.where(swapped, cosine, sine), np.where(swapped, sine, cosine)
    sine = np.where(quadrant >= 2.0, -sine, sine)
    cosine = np.where((quadrant == 1.0) | (quadrant == 2.0), -cosine, cosine)
    return sine, cosine


def _like(angle: npt.ArrayLike, value: FloatArray) -> FloatArray | float:
    """Return a plain float if the angle is a scalar."""
    return float(value) if np.ndim(angle) == 0 else value


@overload
def sin(angle: float) -> float: ...


@overload
def sin(angle: npt.ArrayLike) -> FloatArray: ...


def sin(angle: npt.ArrayLike) -> FloatArray | float:
    """Return the sine of angles in radians.

    Parameters
    ----------
    angle : array_like
        Angles of any shape.

    Returns
    -------
    float or ndarray of float64
        A float for a scalar, else an array of the shape of `angle`. NaN where the angle is NaN
        or infinite.
    """
    return _like(angle, _sine_cosine(angle)[0])


@overload
def cos(angle: float) -> float: ...


@overload
def cos(angle: npt.ArrayLike) -> FloatArray: ...


def cos(angle: npt.ArrayLike) -> FloatArray | float:
    """Return the cosine of angles in radians; shapes as in `sin`."""
    return _like(angle, _sine_cosine(angle)[1])


@overload
def tan(angle: float) -> float: ...


@overload
def tan(angle: npt.ArrayLike) -> FloatArray: ...


def tan(angle: npt.ArrayLike) -> FloatArray | float:
    """Return the tangent of angles in radians; shapes as in `sin`."""
    sine, cosine = _sine_cosine(angle)
    return _like(angle, sine / cosine)


@overload
def atan2(y: float, x: float) -> float: ...


@overload
def atan2(y: npt.ArrayLike, x: npt.ArrayLike) -> FloatArray: ...


def atan2(y: npt.ArrayLike, x: npt.ArrayLike) -> FloatArray | float:
    """Return the angle of the vectors (x, y), counter-clockwise from the X axis.

    Parameters
    ----------
    y, x : array_like
        Finite coordinates that broadcast against each other.

    Returns
    -------
    float or ndarray of float64
        Radians in [-pi, pi]; 0 for the null vector. A float if both arguments are scalars.
    """
    y, x = floats(y, "y"), floats(x, "x")
    if not (np.isfinite(y).all() and np.isfinite(x).all()):
        raise InvalidArgumentError(f"y and x must be finite: {shown(y)}, {shown(x)}")
    scalar = y.ndim == 0 and x.ndim == 0
    try:
        y, x = np.broadcast_arrays(y, x)
    except ValueError:
        raise InvalidArgumentError(f"y and x do not go together: {y.shape}, {x.shape}") from None
    rise, run = np.abs(y), np.abs(x)
    long = np.maximum(rise, run)
    slope = np.minimum(rise, run) / np.where(long == 0.0, 1.0, long)
    nearest = np.rint(8.0 * slope)
    step = (slope - nearest / 8.0) / (1.0 + slope * (nearest / 8.0))
    square = step * step
    angle = _ARC_TANGENTS[nearest.astype(np.intp)] + (
        step + step * square * _horner(square, _ARC_TANGENT_TERMS)
    )
    angle = np.where(rise > run, 0.5 * math.pi - angle, angle)
    angle = np.where(x < 0.0, math.pi - angle, angle)
    angle = np.where(y < 0.0, -angle, angle)
    return float(angle) if scalar else angle


def unit_circle(count: int) -> tuple[FloatArray, FloatArray]:
    """Return the points of a regular polygon on the unit circle, with exact symmetry.

    Point ``k`` is at the angle ``2 * pi * k / count``. The coordinates at multiples of a quarter
    turn are exactly 0 and +-1, and mirror images agree to the bit: each angle is folded, as a
    fraction of integers, into the first octant before its sine and cosine are taken.

    Parameters
    ----------
    count : int
        Number of points, at least 1.

    Returns
    -------
    x, y : ndarray of float64, shape (count,)
        Cosines and sines.
    """
    count = whole_number(count, "count", 1, _MOST_POINTS)
    x, y = (_kept_polygon if count <= _MOST_KEPT else _polygon)(count)
    return x.copy(), y.copy()


def _polygon(count: int) -> tuple[FloatArray, FloatArray]:
    """Return what `unit_circle` does."""
    eighths = 8 * np.arange(count)  # the angle in units of 1/count of an octant
    octant, position = np.divmod(eighths, count)
    folded = np.where(octant % 2 == 1, count - position, position)
    sine, cosine = _sine_cosine(folded * (math.pi / 4.0) / count)
    steep = (octant + 1) & 2 != 0  # octants 1, 2, 5, 6 are nearer to the Y axis than to the X axis
    x = np.where(steep, sine, cosine)
    y = np.where(steep, cosine, sine)
    # The end of an octant is at 45 degrees, where the two series differ by one ulp.
    diagonal = folded == count
    x, y = (np.where(diagonal, math.sqrt(0.5), values) for values in (x, y))
    return np.where((octant + 2) & 4 != 0, -x, x) + 0.0, np.where(octant >= 4, -y, y) + 0.0


_kept_polygon = functools.lru_cache(maxsize=64)(_polygon)
