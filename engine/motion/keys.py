"""Times and values of keys, as channels take them: float64, read-only, copied only if need be."""

from __future__ import annotations

from typing import get_args

import numpy as np

from .._native.loaders import frozen, is_frozen
from .._support.numbers import floats
from ..choices import Interpolation
from ..errors import InvalidArgumentError

INTERPOLATIONS = get_args(Interpolation)


def check_times(value) -> np.ndarray:
    """Check times of keys: (K,) float64, increasing, at least one."""
    times = frozen_or_copied(value, "times")
    if times.ndim != 1 or not len(times):
        raise InvalidArgumentError(f"times must be (K,), at least one, not {times.shape}")
    if not np.isfinite(times).all() or not (np.diff(times) > 0).all():
        raise InvalidArgumentError("times must be finite and increase")
    return times


def frozen_or_copied(value, what: str) -> np.ndarray:
    """Return numbers as a read-only float64 array: the given one, if nobody can write to it."""
    is_kept = isinstance(value, np.ndarray) and value.dtype == np.float64 and is_frozen(value)
    if is_kept and value.flags.c_contiguous:
        return value
    return frozen(floats(value, what))
