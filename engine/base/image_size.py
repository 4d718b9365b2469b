"""Checks of image sizes in pixels.

In: a caller's size, (width, height). Out: integers that the core can draw.
"""

from __future__ import annotations

import numbers
from typing import Any

from ..errors import InvalidArgumentError
from .foreign_arrays import without_axes
from .numbers import shown

MAX_SIZE = 16384


def check_size(value: Any) -> tuple[int, int]:
    """Return the width and the height of an image, checked."""
    width, height = sides_of(value)
    return _check_side(width, "width"), _check_side(height, "height")


def sides_of(value: Any) -> tuple[Any, Any]:
    """Return what a caller gave as the width and the height of a size, unchecked."""
    try:
        width, height = value
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"size must be (width, height), not {shown(value)}") from None
    return width, height


def _check_side(value: Any, what: str) -> int:
    """Return a side of an image, checked."""
    value = without_axes(value, what)
    if not isinstance(value, numbers.Integral) or not 1 <= int(value) <= MAX_SIZE:
        raise InvalidArgumentError(
            f"{what} must be a whole number in 1..{MAX_SIZE}, not {shown(value)}"
        )
    return int(value)
