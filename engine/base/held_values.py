"""Values as they are at one moment, to be put back or compared later.

In: numbers, texts, arrays, things, and lists and dicts of these. Out: the same with lists and dicts
of their own, however deep these lie; and whether two such values are the same to the bit.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .._native.loaders import is_frozen
from .validation import Closed


def kept(value: Any) -> Any:
    """Return a value that stays as it is: with lists, dicts and arrays of its own."""
    if isinstance(value, list):
        return list(map(kept, value))
    if isinstance(value, dict):
        return {key: kept(item) for key, item in value.items()}
    if type(value) is tuple:
        items = tuple(map(kept, value))
        return value if all(a is b for a, b in zip(items, value, strict=True)) else items
    if isinstance(value, np.ndarray) and not is_frozen(value):
        return value.copy()
    return value


def same(one: Any, other: Any) -> bool:
    """Whether two values are the same: things if they are one object, numbers to the bit.

    Dicts are the same in the same order, since files hold them so.
    """
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, dict):
        return same(list(one.items()), list(other.items()))
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, np.ndarray):
        alike = one.dtype == other.dtype and one.shape == other.shape
        return alike and one.tobytes() == other.tobytes()
    if isinstance(one, float):
        return one.hex() == other.hex()
    return not isinstance(one, Closed) and one == other
