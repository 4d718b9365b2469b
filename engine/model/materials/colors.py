"""Conversion of colours as people write them to linear light, which the core computes in.

In: a colour of three numbers. Floats are linear light; 8-bit values (``uint8`` arrays, Python
integers in 0..255) are sRGB. Out: three float32 in linear light. The sRGB curve is that of IEC
61966-2-1, as a table for the 256 8-bit values.
"""

from __future__ import annotations

import functools
import math
import numbers
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, cast, get_args

import numpy as np

from ..._native.loaders import frozen
from ...base.numbers import real, shown
from ...choices import Color, ColorLike, ColorSpace, SurfaceColor
from ...errors import InvalidArgumentError, warn

COLOR_SPACES: tuple[ColorSpace, ...] = get_args(ColorSpace)
_LEAST_SUSPECT = 16.0  # whole-number floats from here on look like 8-bit values
_is_suspicious: ContextVar[bool] = ContextVar("_is_suspicious", default=True)


@functools.cache
def srgb_to_linear_table() -> np.ndarray:
    """Return the linear value of each 8-bit sRGB value: (256,) float32, read-only."""
    table = np.empty(256, np.float64)
    for value in range(256):
        encoded = value / 255
        if encoded <= 0.04045:
            table[value] = encoded / 12.92
        else:
            table[value] = math.pow((encoded + 0.055) / 1.055, 2.4)
    return frozen(table.astype(np.float32))


def check_color(value: ColorLike, what: str = "color") -> Color:
    """Return ``value`` as a tuple, or raise if it is not a colour.

    Parameters
    ----------
    value : sequence of 3 numbers
        Finite and not negative; integers at most 255. Floats above 1 are allowed (bright lights).
    what : str
        The name used in the message.

    Raises
    ------
    InvalidArgumentError
    """
    components = _three(value, what)
    if max(components) >= _LEAST_SUSPECT and not is_8bit(components):
        warn_of_8bit_floats(np.array(components, np.float64), what)
    return components


def check_surface_color(value: ColorLike, what: str = "color") -> SurfaceColor:
    """Return ``value`` as a tuple, or raise if it is not a colour, with or without alpha.

    Parameters
    ----------
    value : sequence of 3 or 4 numbers
        As for `check_color`; alpha is at most 1, or 255 where the four are 8-bit values.
    what : str
        The name used in the message.

    Raises
    ------
    InvalidArgumentError
    """
    components = _components(value, what)
    if len(components) not in (3, 4):
        raise InvalidArgumentError(f"{what} needs 3 or 4 components, got {len(components)}")
    if not is_8bit(components):
        if max(components[:3]) >= _LEAST_SUSPECT:
            warn_of_8bit_floats(np.array(components[:3], np.float64), what)
        if len(components) == 4 and components[3] > 1:
            raise InvalidArgumentError(f"the alpha of {what} must be in 0..1: {shown(value)}")
    return components


def split_alpha(color: SurfaceColor) -> tuple[Color, float]:
    """Return a colour's three components and its alpha, which is 1 if it has none."""
    if len(color) == 3:
        return color, 1.0
    rgb = color[:3]
    if not is_8bit(color):
        return cast(Color, tuple(map(float, rgb))), float(color[3])
    return cast(Color, tuple(map(np.uint8, rgb))), int(color[3]) / 255


def _three(value: ColorLike, what: str) -> Color:
    components = _components(value, what)
    if len(components) != 3:
        raise InvalidArgumentError(f"{what} needs 3 components, got {len(components)}")
    return components


def _components(value: ColorLike, what: str) -> tuple[Any, ...]:
    components = tuple(_scalar(component) for component in _sequence(value, what))
    for component in components:
        if not isinstance(component, numbers.Real) or isinstance(component, bool):
            raise InvalidArgumentError(f"{what} is not made of numbers: {value!r}")
        if not 0 <= real(component) < math.inf:
            raise InvalidArgumentError(f"{what} must be finite and not negative: {shown(value)}")
    if components and is_8bit(components) and max(components) > 255:
        raise InvalidArgumentError(f"{what} of integers must be in 0..255: {value!r}")
    return components


@contextmanager
def certainly_linear() -> Iterator[None]:
    """Disable the warning about 8-bit floats: the file's format declares its floats linear."""
    before = _is_suspicious.set(False)
    try:
        yield
    finally:
        _is_suspicious.reset(before)


def warn_of_8bit_floats(colors: np.ndarray, what: str) -> None:
    """Warn if floats, which mean linear light, are all whole numbers, as 8-bit colours are."""
    if not _is_suspicious.get():
        return
    high = colors.max(initial=0)
    if _LEAST_SUSPECT <= high <= 255 and (colors == np.floor(colors)).all():
        warn(
            f"{what} holds floats up to {high:g}, taken as linear light, where 1 is white. "
            "If they are 8-bit values, give integers"
        )


def eight_bit_or_float(colors: np.ndarray, what: str) -> np.ndarray:
    """Return many colours as uint8 or as floats, by the rules of `linear_color`.

    Raises
    ------
    InvalidArgumentError
        They are not numbers, or integers beyond 0..255.
    """
    if colors.dtype == np.uint8:
        return colors
    if colors.dtype.kind == "f":
        colors = float32_of(colors)
        warn_of_8bit_floats(colors[:, :3], what)
        return colors
    if colors.dtype.kind not in "iu":
        raise InvalidArgumentError(f"{what} must be integers 0..255 or floats, not {colors.dtype}")
    low, high = int(colors.min(initial=0)), int(colors.max(initial=0))
    if low < 0 or high > 255:
        wrong = low if low < 0 else high
        raise InvalidArgumentError(f"{what} of integers must be in 0..255, but one is {wrong}")
    return colors.astype(np.float32 if high <= 1 else np.uint8)


def float32_of(values: np.ndarray) -> np.ndarray:
    """Round to float32; overflow becomes infinite."""
    with np.errstate(over="ignore", invalid="ignore"):
        return values.astype(np.float32, copy=False)


def linear_color(value: ColorLike, color_space: ColorSpace = "srgb") -> np.ndarray:
    """Return a colour in linear light.

    Parameters
    ----------
    value : sequence of 3 numbers
        Floats are linear. Integers are 8-bit sRGB, except that integers all 0 or 1 mean ``0.0`` and
        ``1.0``, so that ``(1, 1, 1)`` is white; NumPy's ``uint8`` is always 8-bit sRGB. One float
        among integers makes all of them floats.
    color_space : {"srgb", "linear"}
        With ``"linear"`` an 8-bit value c means c/255, without the sRGB curve.

    Returns
    -------
    color : (3,) float32

    Raises
    ------
    InvalidArgumentError
    """
    if color_space not in COLOR_SPACES:
        raise InvalidArgumentError(f"color_space must be one of {COLOR_SPACES}: {color_space!r}")
    components = _three(value, "color")  # its owner was already warned
    if not is_8bit(components):
        return float32_of(np.array(components, np.float64))
    if color_space == "linear":
        return (np.array(components, np.float64) / 255).astype(np.float32)
    return srgb_to_linear_table()[np.asarray(components)]


def srgb_bytes(colors: np.ndarray) -> np.ndarray:
    """Return vertex colours as 8-bit display values.

    Parameters
    ----------
    colors : (N, 4) uint8 or float32
        As a mesh holds them: bytes are sRGB, floats linear light.

    Returns
    -------
    colors : (N, 4) uint8
        Bytes unchanged; floats encoded to the nearest byte, alpha scaled.
    """
    if colors.dtype == np.uint8:
        return colors
    table = srgb_to_linear_table()
    encoded = np.searchsorted((table[1:] + table[:-1]) / 2, colors).astype(np.uint8)
    encoded[:, 3] = np.floor(np.clip(colors[:, 3], 0, 1) * 255 + 0.5)
    return encoded


def is_8bit(components: Sequence[Any]) -> bool:
    """Return whether a colour of Python or NumPy scalars holds 8-bit values."""
    if not all(isinstance(c, numbers.Integral) for c in components):
        return False
    return max(components) > 1 or all(isinstance(c, np.uint8) for c in components)


def _sequence(value: Any, what: str) -> list[Any]:
    try:
        if not isinstance(value, str):
            return list(value)
    except TypeError:
        pass
    raise InvalidArgumentError(f"{what} must be a sequence of 3 numbers: {value!r}")


def _scalar(component: Any) -> Any:
    """Return a Python scalar, except for uint8, whose type marks an 8-bit value."""
    if isinstance(component, np.generic) and not isinstance(component, np.uint8):
        return component.item()
    return component
