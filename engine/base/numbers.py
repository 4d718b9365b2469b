"""Conversion of callers' numbers and arrays.

In: any value. Out: a float, or a float64 array; or an `InvalidArgumentError` that names the
argument that must be a number. Integers too large for floats become infinite; later checks refuse
them if necessary.
"""

from __future__ import annotations

import math
import numbers
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InvalidArgumentError
from .foreign_arrays import on_host, without_axes


def real(value: Any) -> float:
    """Return a value as a float; NaN if it is not a number."""
    if not isinstance(value, numbers.Real):
        value = without_axes(value, "a number")
        if not isinstance(value, numbers.Real):
            return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf  # type: ignore[operator]


def shown(value: Any) -> str:
    """Return a value for a message: on one line, and short."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # too many digits to print
        text = f"an integer of {value.bit_length()} bits" if type(value) is int else "numbers"
    return text if len(text) <= 80 else f"{text[:60]} …"


def as_array(value: Any, what: str) -> NDArray[Any]:
    """Return an array of any dtype; those of other libraries share their memory."""
    given = on_host(value, what)
    try:
        return np.asarray(given)
    except (TypeError, ValueError, OverflowError, RecursionError) as error:
        raise InvalidArgumentError(f"{what} is not an array: {error}") from None


def count_not_finite(rows: NDArray[np.float32]) -> int:
    """Return how many rows hold a number that is not finite; quick if none does."""
    with np.errstate(over="ignore", invalid="ignore"):
        if math.isfinite(np.add.reduce(rows.reshape(-1))):
            return 0
    return int((~np.isfinite(rows)).any(axis=1).sum())  # or too large to sum


def floats(value: Any, what: str) -> NDArray[np.float64]:
    """Return a float64 copy of numbers, C-contiguous."""
    kind = value.__class__
    if kind is tuple or kind is list:  # the common case first: this runs for every node
        wrong = bool(value) and value[0].__class__ is str  # NumPy would accept "1" as 1
    else:
        wrong = value is None or getattr(getattr(value, "dtype", None), "kind", "f") in "cmMSU"
        value = on_host(value, what)
    if wrong:
        given = getattr(value, "dtype", None) or shown(value)
        raise InvalidArgumentError(f"{what} must be numbers, not {given}")
    try:
        return np.array(value, np.float64, order="C")
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidArgumentError(f"{what} must be numbers: {error}") from None
