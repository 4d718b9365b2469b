"""Checks of what callers pass to the primitives.

In: raw arguments. Out: floats and ints in range, or InvalidArgumentError that names the argument.
"""

from __future__ import annotations

import functools
import inspect
import operator
from collections.abc import Callable
from typing import Any, ParamSpec

import numpy as np

from ...base.calls import hinted
from ...base.numbers import as_array, shown
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..geometry.origins import PrimitiveOrigin, remember_origin

Parameters = ParamSpec("Parameters")

# Keeps every index below 2**31, and a slip of the keyboard from eating the memory.
MAX_SEGMENTS = 8192


def positive(name: str, value: Any) -> float:
    """Return a finite number greater than 0."""
    try:
        if getattr(value, "ndim", 0):  # old NumPy makes numbers of arrays of one
            raise TypeError
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise InvalidArgumentError(f"{name} must be a number, not {shown(value)}") from None
    if not (0.0 < number < float("inf")):
        raise InvalidArgumentError(f"{name} must be finite and greater than 0, not {shown(value)}")
    return number


def positives(name: str, values: Any, count: int) -> tuple[float, ...]:
    """Return `count` positive numbers; one number stands for all."""
    given, values = values, as_array(values, name)
    if values.ndim == 0:
        return (positive(name, values.item()),) * count
    if values.shape != (count,):
        raise InvalidArgumentError(f"{name} must be one number or {count}, not {shown(given)}")
    return tuple(positive(name, value) for value in values)


def integer(name: str, value: Any, least: int, most: int) -> int:
    """Return an integer in [least, most]."""
    try:
        number = operator.index(value)
    except TypeError:
        raise InvalidArgumentError(f"{name} must be an integer, not {shown(value)}") from None
    if not least <= number <= most:
        raise InvalidArgumentError(f"{name} must be from {least} to {most}, not {shown(number)}")
    return number


def segment_pair(
    name: str, values: Any, least: tuple[int, int], what: tuple[str, str]
) -> tuple[int, int]:
    """Return two counts of segments, each at least its own minimum; ``what`` says of what."""
    given, values = values, as_array(values, name)
    if values.shape != (2,):
        raise InvalidArgumentError(
            f"{name} must be two integers, {' and '.join(what)}, not {shown(given)}"
        )
    first, second = (
        integer(name, value, low, MAX_SEGMENTS) for value, low in zip(values, least, strict=True)
    )
    return first, second


def names_itself(make: Callable[Parameters, Mesh]) -> Callable[Parameters, Mesh]:
    """Let a function's meshes know by which arguments it makes them, as scene files say."""
    hinting = hinted(make)
    signature = functools.cache(lambda: inspect.signature(make))

    @functools.wraps(make)
    def named(*args: Parameters.args, **kwargs: Parameters.kwargs) -> Mesh:
        mesh = hinting(*args, **kwargs)
        given = signature().bind(*args, **kwargs).arguments
        plain = {name: np.asarray(value).tolist() for name, value in given.items()}
        remember_origin(mesh, PrimitiveOrigin(make.__name__, plain))
        return mesh

    return named
