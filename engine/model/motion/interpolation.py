"""Interpolation between two values: linear, spherical (slerp) or by cubic splines.

In: values at keys, as float64 arrays with a row each, and interpolation factors. Out: float64, with
the same bits on every machine (R76). Sources: glTF 2.0, Appendix C; Shoemake 1985 (slerp).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...base import linalg

_STRAIGHT = 1e-6  # of the sine of an angle: below it, interpolate linearly


class Turns(NamedTuple):
    """Pairs of rotations to interpolate along the shorter arc.

    Attributes
    ----------
    starts, ends : (N, 4) float64
        Unit quaternions in the same hemisphere.
    angles, sines : (N,) float64
        The angle between each pair, and its sine.
    """

    starts: np.ndarray
    ends: np.ndarray
    angles: np.ndarray
    sines: np.ndarray

    def rows(self, numbers: np.ndarray) -> Turns:
        """Return some of the pairs."""
        return Turns(*(part[numbers] for part in self))

    def at(self, shares: np.ndarray) -> np.ndarray:
        """Return the rotations at fractions (N,), at constant angular velocity: (N, 4)."""
        left = 1.0 - shares
        straight = self.sines < _STRAIGHT
        safe = np.where(straight, 1.0, self.sines)
        first = np.where(straight, left, linalg.sin(left * self.angles) / safe)
        second = np.where(straight, shares, linalg.sin(shares * self.angles) / safe)
        return self.starts * first[:, np.newaxis] + self.ends * second[:, np.newaxis]


def turns(a: np.ndarray, b: np.ndarray) -> Turns:
    """Return the pairs from and to given rotations: (N, 4) quaternions of any nonzero length."""
    a, b = unit(a), unit(b)
    cosines = _dot(a, b)
    b = np.where((cosines < 0.0)[:, np.newaxis], -b, b)
    cosines = np.abs(cosines)
    sines = np.sqrt(np.maximum(0.0, 1.0 - cosines * cosines))
    return Turns(a, b, linalg.atan2(sines, cosines), sines)


def slerp(a: np.ndarray, b: np.ndarray, share: float) -> np.ndarray:
    """Return the spherical interpolation of two rotations along the shorter arc.

    Parameters
    ----------
    a, b : (4,) float64
        Quaternions of any nonzero length.
    share : float
        0 is a, 1 is b.

    Returns
    -------
    (4,) float64
    """
    return turns(a[np.newaxis], b[np.newaxis]).at(np.array([share]))[0]


def straight(a: np.ndarray, b: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Return the linear interpolation (N, C) of two values at fractions (N,)."""
    shares = shares[:, np.newaxis]
    return a * (1.0 - shares) + b * shares


def spline(
    before: np.ndarray, after: np.ndarray, shares: np.ndarray, spans: np.ndarray
) -> np.ndarray:
    """Return values of cubic splines.

    Parameters
    ----------
    before, after : (N, 3, C) float64
        In-tangent, value and out-tangent of both keys.
    shares, spans : (N,) float64
        Fraction of the time between the keys, and that time.

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
    """Return quaternions (N, 4) at unit length; zeros stay zero."""
    square = _dot(quaternions, quaternions)
    length = np.sqrt(np.where((square > 0.0) & (square < np.inf), square, 1.0))
    return quaternions / length[:, np.newaxis]


def _dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    product = a * b
    return product[:, 0] + product[:, 1] + product[:, 2] + product[:, 3]
