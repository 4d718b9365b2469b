"""Between two values: straight lines, the shorter way round, cubic splines.

In: values at keys, as float64 arrays with a row each, and shares of the way. Out: float64, with the
same bits on every machine (R76). Sources: glTF 2.0, Appendix C; Shoemake 1985 (slerp).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base import linalg

_STRAIGHT = 1e-6  # of the sine of an angle: below it, the way is straight


class Turns(NamedTuple):
    """Ways from rotations to others, the shorter way round.

    Attributes
    ----------
    starts, ends : (N, 4) float64
        Unit quaternions on the same side.
    angles, sines : (N,) float64
        Of the angle between both.
    """

    starts: np.ndarray
    ends: np.ndarray
    angles: np.ndarray
    sines: np.ndarray

    def rows(self, numbers: np.ndarray) -> Turns:
        """Return some of the ways."""
        return Turns(*(part[numbers] for part in self))

    def at(self, shares: np.ndarray) -> np.ndarray:
        """Return the rotations at shares (N,) of the ways, at a constant rate: (N, 4)."""
        left = 1.0 - shares
        straight = self.sines < _STRAIGHT
        safe = np.where(straight, 1.0, self.sines)
        first = np.where(straight, left, linalg.sin(left * self.angles) / safe)
        second = np.where(straight, shares, linalg.sin(shares * self.angles) / safe)
        return self.starts * first[:, np.newaxis] + self.ends * second[:, np.newaxis]


def turns(a: np.ndarray, b: np.ndarray) -> Turns:
    """Return the turns from rotations to others: (N, 4) quaternions of any length but zero."""
    a, b = unit(a), unit(b)
    cosines = _dot(a, b)
    b = np.where((cosines < 0.0)[:, np.newaxis], -b, b)
    cosines = np.abs(cosines)
    sines = np.sqrt(np.maximum(0.0, 1.0 - cosines * cosines))
    return Turns(a, b, linalg.atan2(sines, cosines), sines)


def slerp(a: np.ndarray, b: np.ndarray, share: float) -> np.ndarray:
    """Return the rotation between two, the shorter way round.

    Parameters
    ----------
    a, b : (4,) float64
        Quaternions of any length but zero.
    share : float
        0 is a, 1 is b.

    Returns
    -------
    (4,) float64
    """
    return turns(a[np.newaxis], b[np.newaxis]).at(np.array([share]))[0]


def straight(a: np.ndarray, b: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Return the values (N, C) at shares (N,) of the straight ways from some to others."""
    shares = shares[:, np.newaxis]
    return a * (1.0 - shares) + b * shares


def spline(
    before: np.ndarray, after: np.ndarray, shares: np.ndarray, spans: np.ndarray
) -> np.ndarray:
    """Return the values of cubic splines.

    Parameters
    ----------
    before, after : (N, 3, C) float64
        At both keys: tangent towards it, value, tangent away from it.
    shares, spans : (N,) float64
        Share of the way from key to key, and how long that is.

    Returns
    -------
    (N, C) float64
    """
    t, span = shares[:, np.newaxis], spans[:, np.newaxis]
    t2 = t * t
    t3 = t2 * t
    value = (2.0 * t3 - 3.0 * t2 + 1.0) * before[:, 1]
    value = value + span * (t3 - 2.0 * t2 + t) * before[:, 2]
    value = value + (3.0 * t2 - 2.0 * t3) * after[:, 1]
    return value + span * (t3 - t2) * after[:, 0]


def unit(quaternions: np.ndarray) -> np.ndarray:
    """Return quaternions (N, 4) at unit length; what has none stays as it is."""
    square = _dot(quaternions, quaternions)
    length = np.sqrt(np.where((square > 0.0) & (square < np.inf), square, 1.0))
    return quaternions / length[:, np.newaxis]


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    product = a * b
    return product[:, 0] + product[:, 1] + product[:, 2] + product[:, 3]
