"""Checks of image sizes in pixels.

In: a caller's width and height. Out: integers that the core can draw.
"""

from __future__ import annotations

import numbers
from typing import Any

from ..errors import InvalidArgumentError

MAX_SIZE = 16384


def check_side(value: Any, what: str) -> int:
    """Return a side of an image, checked."""
    if not isinstance(value, numbers.Integral) or not 1 <= int(value) <= MAX_SIZE:
        raise InvalidArgumentError(f"{what} must be a whole number in 1..{MAX_SIZE}, not {value!r}")
    return int(value)


def check_size(value: Any) -> tuple[int, int]:
    """Return the width and the height of an image, checked."""
    try:
        width, height = value
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"size must be (width, height), not {value!r}") from None
    return check_side(width, "width"), check_side(height, "height")
