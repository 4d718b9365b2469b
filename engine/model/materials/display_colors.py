"""Display values of colours, for modes whose colours bypass the sRGB encoder.

In: a colour as people write it. Out: display values (8-bit codes over 255), so that a background or
line colour has the same bytes in every mode.
"""

from __future__ import annotations

import functools
import math
from typing import Any

from ...choices import ColorSpace
from .colors import check_surface_color, linear_color, split_alpha


def shading_color(value: tuple[Any, ...], color_space: ColorSpace) -> tuple[float, float, float]:
    """Return a colour in the space in which lighting is computed."""
    return _shading_color(value, _types(value), color_space)


def display_color(value: tuple[Any, ...], color_space: ColorSpace) -> tuple[float, float, float]:
    """Return the display values of a colour after a lit frame's encoder."""
    return _display_color(value, _types(value), color_space)


def _types(value: tuple[Any, ...]) -> tuple[type, ...]:
    return type(value), *map(type, value)


# The types are part of the key: 255 and 255.0 compare equal, but 255 is an sRGB code and 255.0 a
# very bright light.
@functools.lru_cache(maxsize=256)
def _shading_color(value: tuple[Any, ...], types: tuple[type, ...], color_space: ColorSpace) -> Any:
    return tuple(linear_color(value, color_space).tolist())


@functools.lru_cache(maxsize=256)
def _display_color(value: tuple[Any, ...], types: tuple[type, ...], color_space: ColorSpace) -> Any:
    linear = _shading_color(value, types, color_space)
    if color_space == "linear":
        return linear
    return tuple(encode_srgb(component) / 255 for component in linear)


def exact_display_color(
    value: tuple[Any, ...], color_space: ColorSpace
) -> tuple[float, float, float]:
    """Return the display values of a colour, clamped but not rounded to 8-bit codes."""
    linear = shading_color(value, color_space)
    if color_space == "linear":
        red, green, blue = (min(component, 1.0) for component in linear)
    else:
        red, green, blue = map(srgb_value, linear)
    return red, green, blue


def rgba_codes(color: Any, what: str = "color") -> bytes:
    """Return the 8-bit display values of a colour, four with alpha."""
    rgb, alpha = split_alpha(check_surface_color(color, what))
    codes = display_color(rgb, "srgb")
    return bytes([round(255 * code) for code in codes] + [int(255 * alpha + 0.5)])


def srgb_value(value: float) -> float:
    """Return the sRGB value of a linear value, both in 0..1, clamped (IEC 61966-2-1)."""
    value = min(max(value, 0.0), 1.0)
    if value <= 0.0031308:
        return 12.92 * value
    return 1.055 * math.pow(value, 1 / 2.4) - 0.055


def encode_srgb(value: float) -> int:
    """Return the 8-bit sRGB code of a linear value, clamped."""
    return int(255 * srgb_value(value) + 0.5)
