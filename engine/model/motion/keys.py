"""Times and values of keys, as channels take them: float64, read-only, copied only if needed."""

from __future__ import annotations

from typing import get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen, is_frozen
from ...base.numbers import floats
from ...base.validation import Closed
from ...choices import Interpolation
from ...errors import InvalidArgumentError

INTERPOLATIONS = get_args(Interpolation)


class Keyed(Closed):
    """Base of channels with keys; their makers check the keys."""

    _interpolation: Interpolation
    _times: NDArray[np.float64]
    _values: NDArray[np.float64]

    @property
    def interpolation(self) -> Interpolation:
        return self._interpolation

    @property
    def times(self) -> NDArray[np.float64]:
        """(K,) float64, read-only."""
        return self._times

    @property
    def values(self) -> NDArray[np.float64]:
        """(K, N) or (K, 3, N) float64, read-only."""
        return self._values


def check_times(value: ArrayLike) -> np.ndarray:
    """Check times of keys: (K,) float64, increasing, at least one."""
    times = frozen_or_copied(value, "times")
    if times.ndim != 1 or not len(times):
        raise InvalidArgumentError(f"times must be (K,), at least one, not {times.shape}")
    if not np.isfinite(times).all() or not (np.diff(times) > 0).all():
        raise InvalidArgumentError("times must be finite and increase")
    return times


def frozen_or_copied(value: ArrayLike, what: str) -> np.ndarray:
    """Return numbers as a read-only float64 array; copy them if anybody could write to them."""
    if isinstance(value, np.ndarray) and value.dtype == np.float64 and is_frozen(value):
        if value.flags.c_contiguous:
            return value
    return frozen(floats(value, what))
