"""Open3D's colour maps, by which things without colours of their own are drawn.

In: values, from 0 to 1. Out: colours as displayed. The formulas are those of Open3D's ColorMap.cpp.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

_HOT = np.array([(1.0, 1.0, 1.0), (1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)])


def _jet(values: NDArray[np.float64]) -> NDArray[np.float64]:
    shifted = values[:, np.newaxis] * 2.0 - np.array([1.5, 1.0, 0.5])
    return np.clip(1.5 - 2.0 * np.abs(shifted), 0.0, 1.0)


def _gray(values: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.repeat(values[:, np.newaxis], 3, axis=1)


def _summer(values: NDArray[np.float64]) -> NDArray[np.float64]:
    share = np.clip(values, 0.0, 1.0)
    return np.stack([share, 0.5 + 0.5 * share, np.full_like(share, 0.4)], axis=1)


def _winter(values: NDArray[np.float64]) -> NDArray[np.float64]:
    share = np.clip(values, 0.0, 1.0)
    return np.stack([np.zeros_like(share), share, 1.0 - 0.5 * share], axis=1)


def _hot(values: NDArray[np.float64]) -> NDArray[np.float64]:
    third = np.clip(values, 0.0, 1.0) * 3.0
    low = np.minimum(third.astype(np.intp), 2)
    return _HOT[low] + (_HOT[low + 1] - _HOT[low]) * (third - low)[:, np.newaxis]


#: By the numbers of Open3D's keys.
MAPS: dict[int, Callable[[NDArray[np.float64]], NDArray[np.float64]]] = {
    0: _gray,
    1: _jet,
    2: _summer,
    3: _winter,
    4: _hot,
}
_chosen = [1]  # Open3D has one for all windows of a process


def choose_map(number: int) -> None:
    """Draw by another map from now on."""
    _chosen[0] = number


def map_colors(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return colours, (N, 3), of values, (N,); NaN is as 0."""
    return MAPS[_chosen[0]](np.nan_to_num(values, posinf=1.0, neginf=0.0))
