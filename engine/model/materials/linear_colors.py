"""Numbers that are marked as linear light: single colours and arrays of them.

In: numbers. Out: the same numbers, of a type that says what they are. Unmarked floats of a colour
are display values; see `colors`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, SupportsIndex, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.numbers import as_array, real, shown
from ...errors import InvalidArgumentError

_read_as_linear: ContextVar[bool] = ContextVar("_read_as_linear", default=False)


class LinearColor(tuple[float, ...]):
    """A colour in linear light, three or four floats; slices of it are linear light, too.

    It equals a plain tuple only if all of its components are 0 or 1, which are the same in every
    space.
    """

    __slots__ = ()

    @overload
    def __getitem__(self, index: SupportsIndex, /) -> float: ...

    @overload
    def __getitem__(self, index: slice, /) -> LinearColor: ...

    def __getitem__(self, index: Any, /) -> Any:
        part = super().__getitem__(index)
        return LinearColor(part) if isinstance(index, slice) else part

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, tuple):
            return NotImplemented
        is_alike = isinstance(other, LinearColor) or all(part in (0, 1) for part in self)
        return is_alike and tuple.__eq__(self, other)

    def __ne__(self, other: object) -> bool:
        is_equal = self.__eq__(other)
        return is_equal if is_equal is NotImplemented else not is_equal

    __hash__ = tuple.__hash__

    def __repr__(self) -> str:
        return f"linear({', '.join(map(repr, self))})"


class LinearColors(np.ndarray[Any, Any]):
    """An array of colours in linear light; its slices and what is computed from it are, too."""

    __slots__ = ()
    __array_priority__ = 1.0  # so that np.concatenate keeps the type


@overload
def linear(red: float, green: float, blue: float, alpha: float = ..., /) -> LinearColor: ...


@overload
def linear(colors: NDArray[Any], /) -> Any: ...


@overload
def linear(color: ArrayLike, /) -> LinearColor: ...


def linear(*values: Any) -> Any:
    """Return numbers marked as linear light, for wherever a colour is taken.

    Parameters
    ----------
    *values : 3 or 4 floats, or one array of any shape
        Linear light: 0 is black, 1 is white, and light may be brighter than white. A fourth number
        of a colour is alpha.

    Returns
    -------
    color : LinearColor
        A tuple, of 3 or 4 numbers.
    colors : LinearColors
        A view of an array of more dimensions. ``np.asarray`` takes the mark away.

    Raises
    ------
    InvalidArgumentError
        They are no numbers, are 8-bit values (``uint8``), which are sRGB, or are a single colour
        that is negative or not finite.
    """
    given = values[0] if len(values) == 1 else values
    if isinstance(given, (LinearColor, LinearColors)) and np.ndim(given) != 1:
        return given
    array = as_array(given, "linear")
    if array.dtype == np.uint8 or array.dtype.kind not in "fiu":
        raise InvalidArgumentError(f"linear light is made of floats, not of {array.dtype}")
    if array.ndim != 1:
        if array.ndim == 0:
            raise InvalidArgumentError("linear needs 3 or 4 numbers or an array, got 1")
        floats = array if array.dtype.kind == "f" else array.astype(np.float64)
        return floats.view(LinearColors)
    return _single(array.tolist(), given)


def _single(parts: list[Any], given: Any) -> LinearColor:
    if len(parts) not in (3, 4):
        raise InvalidArgumentError(f"a colour of linear light has 3 or 4 numbers, got {len(parts)}")
    if not all(0 <= real(part) < math.inf for part in parts):
        raise InvalidArgumentError(f"linear light is finite and not negative: {shown(given)}")
    return LinearColor(map(float, parts))


@contextmanager
def floats_are_linear() -> Iterator[None]:
    """Take unmarked floats for linear light: the format of the file that is read says so."""
    before = _read_as_linear.set(True)
    try:
        yield
    finally:
        _read_as_linear.reset(before)


def is_linear(value: Any) -> bool:
    """Return whether the floats of a colour or an array of colours are linear light."""
    return isinstance(value, (LinearColor, LinearColors)) or _read_as_linear.get()


def marked(colors: NDArray[Any]) -> NDArray[Any]:
    """Return an array of colours, its floats marked as linear light; bytes stay sRGB."""
    if colors.dtype == np.uint8:
        return np.asarray(colors)
    return cast("NDArray[Any]", colors.view(LinearColors))
