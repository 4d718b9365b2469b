"""Angle checks that detect values in degrees.

In: angles in radians, as everywhere in Python here. Out: a warning for angles beyond four turns,
which are probably in degrees.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidArgumentError, warn
from .numbers import floats, real, shown
from .validation import finite

FOUR_TURNS = 8.0 * math.pi


class Angle(float):
    """Radians that were given with their unit, and therefore are no length."""


def finite_angle(value: float, what: str) -> float:
    """Return an angle of any size, checked to be a finite number of radians."""
    number = finite(value, what)
    if not -FOUR_TURNS <= number <= FOUR_TURNS:
        warn_of_degrees(what)
    return number


def field_of_view(value: float, what: str = "yfov") -> float:
    """Return a field of view, checked: the angle between opposite sides of a picture."""
    return limited_angle(value, what, math.pi, "between 0 and pi radians", open=True)


def limited_angle(value: float, what: str, most: float, words: str, *, open: bool = False) -> float:
    """Return an angle, checked to be from 0 to ``most`` radians as ``words`` describe."""
    number = real(value)
    if not (0.0 < number < most if open else 0.0 <= number <= most):
        beyond = "; degrees go through numpy.radians" if number > 2.0 * math.pi else ""
        raise InvalidArgumentError(f"{what} must be {words}, not {shown(value)}{beyond}")
    return number


def angles(value: Any, what: str) -> NDArray[np.float64]:
    """Return a float64 copy of angles; the caller checks whether they are finite."""
    array = floats(value, what)
    if (np.abs(array) > FOUR_TURNS).any():
        warn_of_degrees(what)
    return array


def warn_of_degrees(what: str) -> None:
    """Warn that angles are radians, in constant words, so that each line warns once."""
    warn(f"{what} is beyond four turns: angles are radians; degrees go through numpy.radians")
