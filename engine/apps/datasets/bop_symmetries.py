"""Symmetries of the objects of a BOP data set, checked.

In: what a user says of them, in the words of BOP's models_info.json. Out: the same in JSON's types.
Source: docs/bop_datasets_format.md of bop_toolkit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...base.numbers import floats, shown
from ...base.validation import choose
from ...errors import InvalidArgumentError

_ROUNDING = 1e-5


def checked_symmetries(given: Mapping[str, Mapping[str, Any]]) -> dict[str, dict[str, Any]]:
    """Return symmetries by category.

    Raises
    ------
    InvalidArgumentError
    """
    if not isinstance(given, Mapping):
        raise InvalidArgumentError(f"symmetries must be an object, not {shown(given)}")
    found = {}
    for category, kinds in given.items():
        what = f"symmetries of {category!r}"
        if not isinstance(category, str) or not isinstance(kinds, Mapping):
            raise InvalidArgumentError(f"{what} must be an object, not {shown(kinds)}")
        for kind, values in kinds.items():
            choose(kind, _KINDS, what)
            if isinstance(values, str) or not isinstance(values, Sequence):
                raise InvalidArgumentError(f"{what}: {kind} must be a list, not {shown(values)}")
        found[category] = {
            kind: [_KINDS[kind](one, f"{what}: {kind}") for one in values]
            for kind, values in kinds.items()
        }
    return found


def _discrete(value: Any, what: str) -> list[float]:
    """Return a rigid transform, 16 numbers row by row."""
    matrix = floats(value, what).reshape(-1)
    if matrix.shape != (16,) or not np.isfinite(matrix).all():
        raise InvalidArgumentError(f"{what} must be matrices of 16 numbers, not {shown(value)}")
    rotation = matrix.reshape(4, 4)[:3, :3]
    is_rigid = np.abs(rotation @ rotation.T - np.eye(3)).max() < _ROUNDING
    if not is_rigid or not np.array_equal(matrix[12:], (0, 0, 0, 1)):
        raise InvalidArgumentError(f"{what} must be rotations with a translation: {shown(value)}")
    return matrix.tolist()


def _continuous(value: Any, what: str) -> dict[str, list[float]]:
    """Return an axis and a point on it."""
    if not isinstance(value, Mapping) or value.keys() != {"axis", "offset"}:
        raise InvalidArgumentError(f"{what} must have an axis and an offset, not {shown(value)}")
    found = {}
    for name, numbers in value.items():
        vector = floats(numbers, f"{what}: {name}")
        if vector.shape != (3,) or not np.isfinite(vector).all():
            raise InvalidArgumentError(f"{what}: {name} must be 3 numbers, not {shown(numbers)}")
        found[name] = vector.tolist()
    if not any(found["axis"]):
        raise InvalidArgumentError(f"{what}: the axis must not be zero")
    return found


_KINDS = {"symmetries_discrete": _discrete, "symmetries_continuous": _continuous}
