"""Curves of lenses from an angle or slope to a radius, and their inverses.

In: a curve and its derivative, in closed form. Out: how far it rises, and the argument for a value.
The turning point is bracketed on a fixed grid and found by bisection; the inverse is bracketed on
the same grid and found by Newton's method, which bisects where a step leaves the bracket
(Press et al. 2007, section 9.4). Each step is a single float64 operation (docs/exactness, R200).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Function = Callable[[Floats], Floats]

_HALVINGS = 60
_STEPS = 8


class RisingCurve:
    """The part of a curve from 0 on that rises.

    Parameters
    ----------
    value, slope : callable
        The curve, 0 at 0, and its derivative.
    grid : (N,) float64
        Arguments in rising order, from 0 to the greatest of interest.

    Attributes
    ----------
    end : float
        The greatest argument that has an inverse.
    turns : bool
        Whether the curve turns back there, rather than ends with the grid.
    top : float
        The value at the end.
    """

    @np.errstate(all="ignore")
    def __init__(self, value: Function, slope: Function, grid: Floats) -> None:
        self._value, self._slope = value, slope
        falls = np.flatnonzero(~(slope(grid) > 0.0))
        self.turns = bool(len(falls))
        if self.turns:
            first = int(falls[0])
            self.end = self._turning(float(grid[max(first - 1, 0)]), float(grid[first]))
            grid = np.append(grid[: max(first, 1)], self.end)
        else:
            self.end = float(grid[-1])
        self._arguments, self._values = grid, np.maximum.accumulate(value(grid))
        self.top = float(self._values[-1])

    def _turning(self, low: float, high: float) -> float:
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            if self._slope(np.array([middle]))[0] > 0.0:
                low = middle
            else:
                high = middle
        return low

    @np.errstate(all="ignore")
    def inverse(self, values: Floats) -> Floats:
        """Return the arguments of values; NaN for values that the rising part does not reach."""
        inside = (values >= 0.0) & (values <= self.top)
        wanted = np.where(inside, values, 0.0)
        place = np.searchsorted(self._values, wanted, side="left")
        place = np.clip(place, 1, len(self._values) - 1)
        low, high = self._arguments[place - 1], self._arguments[place]
        below, above = self._values[place - 1], self._values[place]
        share = np.where(above > below, (wanted - below) / (above - below), 0.0)
        at = low + (high - low) * share
        for _ in range(_STEPS):
            error = self._value(at) - wanted
            low, high = np.where(error <= 0.0, at, low), np.where(error >= 0.0, at, high)
            step = at - error / self._slope(at)
            at = np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
        return np.where(inside, at, np.nan)
