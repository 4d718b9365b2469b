"""Conversion of colours as people write them to linear light, which the core computes in.

In: a colour, as a word or as three numbers. Words, floats from 0 to 1 and 8-bit values (``uint8``
arrays, Python integers in 0..255) are display values, which are sRGB; `linear` marks linear light.
Out: three float32 in linear light. The sRGB curve is that of IEC 61966-2-1, as a table for the 256
8-bit values, with straight lines between them (R155).
"""

from __future__ import annotations

import functools
import math
import numbers
from collections.abc import Sequence
from typing import Any, cast, get_args

import numpy as np

from ..._native.loaders import frozen
from ...base.foreign_arrays import is_foreign_array, without_axes
from ...base.numbers import as_array, real, shown
from ...choices import Color, ColorLike, ColorSpace, SurfaceColor
from ...errors import InvalidArgumentError
from .color_names import color_of_word
from .linear_colors import LinearColor, is_linear, marked

COLOR_SPACES: tuple[ColorSpace, ...] = get_args(ColorSpace)
_ROUNDING = 1e-6  # what interpolated display values may exceed 0 and 1 by
_SAME_CODE = 2.0**-16  # codes: more than float32 rounds c/255 by
_ROWS = 1 << 16  # decoded at once


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


def linear_from_display(values: np.ndarray) -> np.ndarray:
    """Return the linear light of display values (R155).

    Parameters
    ----------
    values : (...) float
        From 0 to 1; what is beyond counts as 0 or 1.

    Returns
    -------
    values : (...) float32
        At c/255, exactly that of the 8-bit value c.
    """
    places = np.clip(np.asarray(values, np.float64), 0, 1) * 255
    nearest = np.rint(places)
    places = np.where(np.abs(places - nearest) <= _SAME_CODE, nearest, places)
    lower = np.minimum(places.astype(np.uint8), np.uint8(254))
    table = srgb_to_linear_table().astype(np.float64)
    start = table[lower]
    return (start + (places - lower) * (table[lower + np.uint8(1)] - start)).astype(np.float32)


def display_from_linear(values: np.ndarray) -> np.ndarray:
    """Return the display values, float64, that `linear_from_display` maps to the given light."""
    table = srgb_to_linear_table().astype(np.float64)
    light = np.clip(np.asarray(values, np.float64), 0, 1)
    lower = np.clip(np.searchsorted(table, light, "right") - 1, 0, 254)
    start = table[lower]
    return (lower + (light - start) / (table[lower + 1] - start)) / 255


def check_color(value: ColorLike, what: str = "color") -> Color:
    """Return ``value`` as a tuple, or raise if it is not a colour.

    Parameters
    ----------
    value : str, or sequence of 3 numbers
        A name or ``#rrggbb``; display values, floats at most 1 or integers at most 255; or linear
        light, of any brightness. A fourth number may say that the colour is opaque.
    what : str
        The name used in the message.

    Raises
    ------
    InvalidArgumentError
    """
    color = check_surface_color(value, what)
    if len(color) == 3:
        return color
    rgb, alpha = split_alpha(color)
    if alpha != 1:
        raise InvalidArgumentError(f"{what} needs 3 components, got an alpha, too: {shown(value)}")
    return rgb


def check_surface_color(value: ColorLike, what: str = "color") -> SurfaceColor:
    """Return ``value`` as a tuple, or raise if it is not a colour, with or without alpha.

    Parameters
    ----------
    value : str, or sequence of 3 or 4 numbers
        As for `check_color`; alpha is at most 1, or 255 where the four are 8-bit values.
    what : str
        The name used in the message.

    Returns
    -------
    color : tuple
        8-bit values as integers, floats as they are; linear light as a `LinearColor`.

    Raises
    ------
    InvalidArgumentError
    """
    if isinstance(value, str):
        return cast(SurfaceColor, color_of_word(value, what))
    components = _components(value, what)
    if len(components) not in (3, 4):
        raise InvalidArgumentError(f"{what} needs 3 or 4 components, got {len(components)}")
    if is_8bit(components):
        return cast(SurfaceColor, components)
    if len(components) == 4 and components[3] > 1:
        raise InvalidArgumentError(f"the alpha of {what} must be in 0..1: {shown(value)}")
    if is_linear(value):
        return cast(SurfaceColor, LinearColor(components))
    _require_display(max(components[:3]), what)
    return cast(SurfaceColor, components)


def split_alpha(color: SurfaceColor) -> tuple[Color, float]:
    """Return a colour's three components and its alpha, which is 1 if it has none."""
    if len(color) == 3:
        return color, 1.0
    rgb = color[:3]
    if isinstance(rgb, LinearColor):
        return cast(Color, rgb), float(color[3])
    if not is_8bit(color):
        return cast(Color, tuple(map(float, rgb))), float(color[3])
    return cast(Color, tuple(map(np.uint8, rgb))), int(color[3]) / 255


def with_alpha(rgb: Color, alpha: float) -> SurfaceColor:
    """Return a colour of three components with an alpha from 0 to 1, in the same space."""
    if isinstance(rgb, LinearColor):
        return cast(SurfaceColor, LinearColor((*rgb, alpha)))
    return (*rgb, round(255 * alpha) if is_8bit(rgb) else alpha)


def _components(value: Any, what: str) -> tuple[Any, ...]:
    components = tuple(_scalar(component, what) for component in _sequence(value, what))
    for component in components:
        if not isinstance(component, numbers.Real) or isinstance(component, bool):
            raise InvalidArgumentError(f"{what} is not made of numbers: {value!r}")
        if not 0 <= real(component) < math.inf:
            raise InvalidArgumentError(f"{what} must be finite and not negative: {shown(value)}")
    if components and is_8bit(components) and max(components) > 255:
        raise InvalidArgumentError(f"{what} of integers must be in 0..255: {value!r}")
    return components


def _require_display(high: float, what: str) -> None:
    if not high <= 1 + _ROUNDING:
        raise InvalidArgumentError(
            f"{what} holds the float {high:g}, but floats are display values from 0 to 1: "
            "8-bit values are integers, and brighter light is e3d.linear(...)"
        )


def eight_bit_or_linear(value: Any, what: str) -> np.ndarray:
    """Return many colours as uint8 or as float32 in linear light.

    Parameters
    ----------
    value : (N, 3) or (N, 4) int or float, or a sequence of N colours
        By the rules of `linear_color`. Integers that are all 0 or 1 mean 0.0 and 1.0.
    what : str
        The name used in the message.

    Returns
    -------
    colors : (N, 3) or (N, 4) uint8 or `LinearColors`

    Raises
    ------
    InvalidArgumentError
        They are a single number or not colours, display values beyond 0..1, or integers beyond
        0..255.
    """
    if isinstance(value, str):
        raise InvalidArgumentError(
            f"{what} has a colour for each row: one for all of them is Material(color={value!r})"
        )
    if holds_colors(value):
        return _rows(value, what)
    colors = as_array(value, what)
    if not colors.ndim:
        raise InvalidArgumentError(f"{what} must be (N, 3) or (N, 4), got ()")
    if colors.dtype == np.uint8:
        return colors
    if colors.dtype.kind not in "fiu":
        raise InvalidArgumentError(f"{what} must be integers 0..255 or floats, not {colors.dtype}")
    if colors.dtype.kind == "f":
        colors = float32_of(colors)
        return marked(colors if is_linear(value) or not colors.size else _decoded(colors, what))
    low, high = int(colors.min(initial=0)), int(colors.max(initial=0))
    if low < 0 or high > 255:
        wrong = low if low < 0 else high
        raise InvalidArgumentError(f"{what} of integers must be in 0..255, but one is {wrong}")
    return marked(colors.astype(np.float32 if high <= 1 else np.uint8))


def holds_colors(value: Any) -> bool:
    """Return whether a sequence holds words or linear colours."""
    if not isinstance(value, (list, tuple)):
        array = as_array(value, "colors") if hasattr(value, "__array__") else np.empty(0)
        return array.ndim == 1 and array.dtype.kind in "UO" and len(array) > 0
    return any(isinstance(row, (str, LinearColor)) for row in value)


def _rows(value: Any, what: str) -> np.ndarray:
    """Return colours of any kind as rows of four, in linear light unless all are 8-bit values."""
    given = [check_surface_color(color, what) for color in value]
    split = [split_alpha(color) for color in given]
    if all(map(is_8bit, given)):
        rows = [(*rgb, round(255 * alpha)) for rgb, alpha in split]
        return np.array(rows, np.uint8)
    return marked(np.array([(*linear_color(rgb), alpha) for rgb, alpha in split], np.float32))


def _decoded(colors: np.ndarray, what: str) -> np.ndarray:
    """Return rows of display values in linear light, with alpha as it is."""
    shown = colors[..., :3]
    low, high = float(shown.min(initial=0)), float(shown.max(initial=0))
    if not low >= -_ROUNDING:  # also if it is no number
        raise InvalidArgumentError(f"{what} must be finite and not negative, but one is {low:g}")
    _require_display(high, what)
    decoded = np.array(colors, order="C")
    for start in range(0, len(decoded), _ROWS):
        rows = decoded[start : start + _ROWS]
        rows[..., :3] = linear_from_display(rows[..., :3])
    return decoded


def float32_of(values: np.ndarray) -> np.ndarray:
    """Round to float32; overflow becomes infinite."""
    with np.errstate(over="ignore", invalid="ignore"):
        return values.astype(np.float32, copy=False)


def linear_color(value: ColorLike, color_space: ColorSpace = "srgb") -> np.ndarray:
    """Return a colour in linear light.

    Parameters
    ----------
    value : str, or sequence of 3 numbers
        Floats are display values, unless they are marked as `linear`. Integers are 8-bit display
        values, except that integers all 0 or 1 mean ``0.0`` and ``1.0``, so that ``(1, 1, 1)`` is
        white; NumPy's ``uint8`` is always 8-bit. One float among integers makes all of them floats.
    color_space : {"srgb", "linear"}
        With ``"linear"`` an 8-bit value c means c/255 and a float itself, without the sRGB curve.

    Returns
    -------
    color : (3,) float32

    Raises
    ------
    InvalidArgumentError
    """
    if color_space not in COLOR_SPACES:
        raise InvalidArgumentError(f"color_space must be one of {COLOR_SPACES}: {color_space!r}")
    components: Any = check_color(value)
    if is_8bit(components):
        if color_space == "linear":
            return (np.array(components, np.float64) / 255).astype(np.float32)
        return srgb_to_linear_table()[np.asarray(components)]
    linear = float32_of(np.array(components, np.float64))
    if color_space == "linear" or isinstance(components, LinearColor):
        return linear
    return linear_from_display(linear)


def display_numbers(color: Color) -> list[float]:
    """Return the display values of a colour, unrounded; light brighter than white as it is."""
    if is_8bit(color):
        return [int(code) / 255 for code in color]
    if not isinstance(color, LinearColor):
        return [float(part) for part in color]
    shown = display_from_linear(np.array(color)).tolist()
    return [part if part > 1 else value for part, value in zip(color, shown, strict=True)]


def linear_rows(colors: np.ndarray) -> np.ndarray:
    """Return colours as a mesh holds them, (N, 4) or (N, 3), as float32 in linear light."""
    if colors.dtype != np.uint8:
        return colors
    linear = srgb_to_linear_table()[colors]
    linear[:, 3:] = colors[:, 3:].astype(np.float64) / 255
    return marked(linear)


def srgb_bytes(colors: np.ndarray) -> np.ndarray:
    """Return vertex colours as 8-bit display values.

    Parameters
    ----------
    colors : (N, 4) or (N, 3) uint8 or float32
        As a mesh holds them: bytes are sRGB, floats linear light.

    Returns
    -------
    colors : (N, 4) or (N, 3) uint8
        Bytes unchanged; floats encoded to the nearest byte, alpha scaled.
    """
    if colors.dtype == np.uint8:
        return colors
    table = srgb_to_linear_table()
    encoded = np.searchsorted((table[1:] + table[:-1]) / 2, colors).astype(np.uint8)
    encoded[:, 3:] = np.floor(np.clip(colors[:, 3:], 0, 1) * 255 + 0.5)
    return encoded


def is_8bit(components: Sequence[Any]) -> bool:
    """Return whether a colour of Python or NumPy scalars holds 8-bit values."""
    if not all(isinstance(c, numbers.Integral) for c in components):
        return False
    return max(components) > 1 or all(isinstance(c, np.uint8) for c in components)


def _sequence(value: Any, what: str) -> list[Any]:
    try:
        if not isinstance(value, bytes):
            is_array = hasattr(value, "__array_interface__") or is_foreign_array(value)
            return list(as_array(value, what) if is_array else value)
    except TypeError:
        pass
    raise InvalidArgumentError(f"{what} must be a colour, such as (255, 128, 0): {value!r}")


def _scalar(component: Any, what: str) -> Any:
    """Return a Python scalar, except for uint8, whose type marks an 8-bit value."""
    component = without_axes(component, what)
    if isinstance(component, np.generic) and not isinstance(component, np.uint8):
        return component.item()
    return component
