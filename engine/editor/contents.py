"""What a mesh, material, texture, light or camera holds, and how to put it back.

In: things. Out: their attributes, with lists and dicts of their own; arrays are not copied, since
nobody can write to them. What follows from the rest is left out.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .._support.dirty_tracking import renew
from .._support.validation import Closed

_DERIVED = {"version", "_derived", "_box_of", "_tree_of"}


def contents(thing: Closed) -> dict[str, Any]:
    """Return what a thing holds."""
    return {key: kept(value) for key, value in vars(thing).items() if key not in _DERIVED}


def put_contents(thing: Closed, held: dict[str, Any]) -> None:
    """Let a thing hold what `contents` returned, if it does not."""
    if same(contents(thing), held):
        return
    thing.__dict__.update({key: kept(value) for key, value in held.items()})
    vars(thing).get("_derived", {}).clear()
    renew(thing)


def kept(value: Any) -> Any:
    """Return a value that stays as it is: a list or dict of its own."""
    return type(value)(value) if type(value) in (list, dict) else value


def same(one: Any, other: Any) -> bool:
    """Whether two values are the same: things if they are one object, arrays to the bit."""
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, np.ndarray):
        alike = one.dtype == other.dtype and one.shape == other.shape
        return alike and one.tobytes() == other.tobytes()
    return not isinstance(one, Closed) and one == other
