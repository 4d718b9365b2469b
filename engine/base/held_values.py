"""Snapshots of values, for restoring and comparing.

In: numbers, texts, arrays, objects, and lists and dicts of these. Out: the same with copied lists
and dicts, at any depth; and whether two such values are identical to the bit.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .._native.loaders import is_frozen
from .validation import Closed


def kept(value: Any) -> Any:
    """Return a value with copies of its lists, dicts and arrays, so that it stays unchanged."""
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
    """Return whether two values are identical: objects by identity, numbers to the bit.

    The order of dicts counts, since files keep it.
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
