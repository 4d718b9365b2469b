"""Argument checks, and attributes that check assignments.

In: a caller's value. Out: the checked value, or an `InvalidArgumentError`. Assigning a
`CheckedAttribute` increases its owner's ``version``, so the renderer knows to rebuild its own data.
Attributes that a class with `FixedNames` does not declare cannot be assigned.
"""

from __future__ import annotations

import functools
import math
import numbers
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, TypeAlias, TypeVar, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._native.loaders import frozen, is_frozen
from ..choices import Color, ColorLike
from ..errors import InvalidArgumentError
from .calls import hinted, is_flag
from .dirty_tracking import renew
from .foreign_arrays import without_axes
from .foreign_names import UnknownName, refuses_foreign_names
from .near_words import meant
from .numbers import floats, real, shown

Given = TypeVar("Given")
Kept = TypeVar("Kept")


class FixedNames:
    """Base of classes that refuse undeclared public attributes, so that a typo is an error.

    Annotations declare the attributes of instances; a subclass may declare more.
    """

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        if "__init__" in vars(cls):
            cls.__init__ = hinted(cls.__init__, cls)  # type: ignore[method-assign]
        refuses_foreign_names(cls)

    if not TYPE_CHECKING:  # otherwise type checkers would allow any attribute

        def __setattr__(self, name: str, value) -> None:
            kind = type(self)
            if name[0] != "_" and not hasattr(kind, name) and name not in _declared(kind):
                raise UnknownName(kind, name)
            object.__setattr__(self, name, value)


class Closed(FixedNames):
    """Base of classes with fixed names whose copies are their own.

    Copies and unpickled objects hold read-only arrays, and their own lists and dicts.
    """

    _FORGOTTEN: tuple[
        str, ...
    ] = ()  # attributes recomputed in a copy; the class has their initial values

    def __getstate__(self) -> dict[str, Any]:
        return {key: self.__dict__[key] for key in self.__dict__ if key not in self._FORGOTTEN}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update({key: own(value) for key, value in state.items()})


class Versioned(Closed):
    """Base of classes whose version grows with each assignment to a `CheckedAttribute`."""

    version: int


def own(value: Any) -> Any:
    """Return a value for a copy: arrays become read-only, containers are copied."""
    if isinstance(value, np.ndarray):
        return frozen(value if is_frozen(value) or value.flags.owndata else value.copy())
    if isinstance(value, dict):
        return {key: own(item) for key, item in value.items()}
    return list(map(own, value)) if isinstance(value, list) else value


@functools.cache
def _declared(kind: type) -> frozenset[str]:
    """Return the names that a class and its bases annotate."""
    return frozenset().union(*(getattr(base, "__annotations__", {}) for base in kind.__mro__))


class CheckedAttribute(Generic[Given, Kept]):
    """A data descriptor: ``check(value, name)`` returns the value to keep, or raises.

    Parameters
    ----------
    check : callable
    doc : str
        The text for ``help``.
    """

    def __init__(self, check: Callable[[Given, str], Kept], doc: str = "") -> None:
        self._check = check
        self.__doc__ = doc

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(
        self, owner: None, owner_type: type | None = None
    ) -> CheckedAttribute[Given, Kept]: ...

    @overload
    def __get__(self, owner: object, owner_type: type | None = None) -> Kept: ...

    def __get__(self, owner: Any, owner_type: type | None = None) -> Any:
        if owner is None:
            return self
        try:
            return owner.__dict__[self._name]
        except KeyError:
            kind = type(owner).__name__
            raise AttributeError(f"{kind!r} object has no attribute {self._name!r}") from None

    def __set__(self, owner: object, value: Given) -> None:
        owner.__dict__[self._name] = self._check(value, self._name)
        renew(owner)


NumberAttribute: TypeAlias = CheckedAttribute[float, float]
OptionalNumberAttribute: TypeAlias = CheckedAttribute[float | None, float | None]
VectorAttribute: TypeAlias = CheckedAttribute[ArrayLike, NDArray[np.float64]]
ColorAttribute: TypeAlias = CheckedAttribute[ColorLike, Color]


def one_of(allowed: tuple[Kept, ...]) -> Callable[[Kept, str], Kept]:
    """Return a check that a value is one of a few given ones."""

    def check(value: Kept, what: str) -> Kept:
        return cast(Kept, choose(value, allowed, what))

    return check


def choose(value: Any, allowed: Any, what: str) -> Any:
    """Return ``value`` if it is in ``allowed``; the error lists the allowed values."""
    if is_one_of(value, allowed):
        return value
    choices = ", ".join(repr(choice) for choice in allowed)
    hint = meant(value, filter(_is_text, allowed)) if _is_text(value) else ""
    raise InvalidArgumentError(f"{what} must be one of {choices}, not {shown(value)}{hint}")


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def flag(value: bool, what: str) -> bool:
    """Return a checked flag: True, False, NumPy's bool, 0 or 1."""
    if value is True or value is False:
        return value
    if not is_flag(value):
        raise InvalidArgumentError(f"{what} must be True or False, not {shown(value)}")
    return bool(value)


def text(value: str, what: str) -> str:
    """Return a checked str."""
    if not isinstance(value, str):
        raise InvalidArgumentError(f"{what} must be a str, not {shown(value)}")
    return str(value)


def whole_number(value: int, what: str, least: int, most: int) -> int:
    """Return a checked integer in a range."""
    value = without_axes(value, what)
    whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    if not (whole and least <= value <= most):
        raise InvalidArgumentError(
            f"{what} must be a whole number in {least}..{most}, not {shown(value)}"
        )
    return int(value)


def is_one_of(value: Any, allowed: Any) -> bool:
    """Return whether a value of any type is among the allowed ones."""
    if isinstance(value, np.ndarray):  # its comparisons are arrays, or warnings
        return False
    try:
        return bool(value in allowed)
    except (TypeError, ValueError):  # not hashable, or an array of another library
        return False


def finite(value: float, what: str) -> float:
    """Return a checked finite number."""
    number = real(value)
    if not math.isfinite(number):
        raise InvalidArgumentError(f"{what} must be a finite number, not {shown(value)}")
    return number


def positive(value: float, what: str) -> float:
    """Return a checked finite number greater than 0."""
    number = real(value)
    if not 0 < number < math.inf:
        raise InvalidArgumentError(
            f"{what} must be a finite number greater than 0, not {shown(value)}"
        )
    return number


def optional_positive(value: float | None, what: str) -> float | None:
    """Return a checked finite number greater than 0, or None."""
    return None if value is None else positive(value, what)


def fraction(value: float, what: str) -> float:
    """Return a checked number from 0 to 1."""
    number = real(value)
    if not 0 <= number <= 1:
        raise InvalidArgumentError(f"{what} must be a number from 0 to 1, not {shown(value)}")
    return number


def optional_fraction(value: float | None, what: str) -> float | None:
    """Return a checked number from 0 to 1, or None."""
    return None if value is None else fraction(value, what)


def not_negative(value: float, what: str) -> float:
    """Return a checked finite number that is at least 0."""
    number = real(value)
    if not 0 <= number < math.inf:
        raise InvalidArgumentError(
            f"{what} must be a finite number, 0 or greater, not {shown(value)}"
        )
    return number


def how_far(value: float, what: str) -> float:
    """Return a checked distance: a number that is at least 0 and may be infinite."""
    number = real(value)
    if not number >= 0:
        raise InvalidArgumentError(f"{what} must be a number, 0 or greater, not {shown(value)}")
    return number


def vector3(value: ArrayLike, what: str) -> NDArray[np.float64]:
    """Return three checked finite numbers as a new float64 array."""
    return finite_floats(value, what, (3,))


def matrix4(value: ArrayLike, what: str) -> NDArray[np.float64]:
    """Return a checked 4x4 matrix of finite numbers as a new float64 array."""
    return finite_floats(value, what, (4, 4))


def frozen_floats(value: ArrayLike, what: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return a read-only float64 copy of ``value``, checked for its shape and to be finite."""
    return frozen(finite_floats(value, what, shape))


def finite_floats(value: ArrayLike, what: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return a float64 copy of ``value``, checked for its shape and to be finite."""
    array = floats(value, what)
    if array.shape != shape:
        raise InvalidArgumentError(f"{what} must have shape {shape}, not {array.shape}")
    if not all(map(math.isfinite, array.ravel().tolist())):  # for few numbers, faster than NumPy
        raise InvalidArgumentError(f"{what} must be finite: {array.tolist()}")
    return array
