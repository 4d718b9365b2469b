"""Inverts tone mapping: finds the light that a tone mapper maps to a given colour.

In: a displayable colour, linear. Out: the light that maps to it (docs/exactness, R118 and R119,
backwards, in float64). Fog over lit surfaces uses it, so that full fog shows exactly the fog's
colour, like the background beside it.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ..choices import ToneMapping

_BRIGHTEST = 0.999  # only infinite light maps to white
_ACES_IN = np.array(
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]]
)
_ACES_OUT = np.array(
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]]
)
_AGX_IN = np.array(
    [
        [0.544812083, 0.373797446, 0.0813809633],
        [0.140419349, 0.754107773, 0.105396748],
        [0.0888171345, 0.178859755, 0.732315421],
    ]
)
_AGX_OUT = np.array(
    [
        [1.12710059, -0.110606641, -0.0164939389],
        [-0.141329765, 1.15782368, -0.0164939389],
        [-0.141329765, -0.110606641, 1.25193644],
    ]
)
_AGX_SRGB = np.array(
    [[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]]
)
_AGX_CURVE = (15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232)  # from the highest power down
_AGX_STOPS = 4.026069 + 12.47393
# R119's own approximations: log2(m) - (m - 1) for m from 1 to 2, and w**2.2 / w**2 from the root of
# w.
_AGX_LOG = (-1.1536209, 2.04788446, -1.05187511, 0.158248708)
_AGX_POWER = (0.393614709, 0.859294593, -0.256217986)


def light_that_shows(
    color: tuple[float, float, float], mapping: ToneMapping
) -> tuple[float, float, float]:
    """Return the light that a tone mapper maps to a colour, or to the nearest colour it reaches.

    Parameters
    ----------
    color : (3,) float
        Linear; values above 1 count as 1.
    mapping : {"none", "neutral", "aces", "agx"}
    """
    if mapping == "none":
        return color
    shown = np.clip(np.array(color, np.float64), 0.0, _BRIGHTEST)
    inverse = {"neutral": _neutral, "aces": _aces, "agx": _agx}[mapping]
    red, green, blue = np.maximum(inverse(shown), 0.0).tolist()
    return red, green, blue


def _neutral(shown: np.ndarray) -> np.ndarray:
    lower = float(shown.max())
    if lower >= 0.76:
        peak = 0.52 + 0.0576 / (1.0 - lower)
        whiter = 1.0 - 1.0 / (0.15 * (peak - lower) + 1.0)
        shown = np.maximum((shown - lower * whiter) / (1.0 - whiter), 0.0) * (peak / lower)
    least = float(shown.min())
    offset = math.sqrt(least / 6.25) - least if least < 0.04 else 0.04
    return shown + offset


def _aces(shown: np.ndarray) -> np.ndarray:
    v = np.clip(np.linalg.solve(_ACES_OUT, shown), 0.0, _BRIGHTEST)
    a, b = 1.0 - 0.983729 * v, 0.0245786 - 0.432951 * v
    c = -0.000090537 - 0.238081 * v
    light = (np.sqrt(b * b - 4.0 * a * c) - b) / (2.0 * a)
    return np.linalg.solve(_ACES_IN, light) * 0.6


def _agx(shown: np.ndarray) -> np.ndarray:
    powers = np.maximum(np.linalg.solve(_AGX_SRGB, shown), 0.0).tolist()
    wide = np.array([_where(_agx_power, value, 0.0, 1.2) for value in powers])
    values = np.linalg.solve(_AGX_OUT, wide).tolist()
    own = np.diag(_AGX_IN)  # R119 divides the rows by it
    stops = [_agx_stops(v, first) for v, first in zip(values, np.log2(own).tolist(), strict=True)]
    return np.linalg.solve(_AGX_IN / own[:, None], np.exp2(stops))


def _agx_power(w: float) -> float:
    root = math.sqrt(w)
    return w * w * ((_AGX_POWER[2] * root + _AGX_POWER[1]) * root + _AGX_POWER[0])


def _agx_stops(value: float, first: float) -> float:
    """Return the logarithm, plus ``first``, at which R119's curve, with its error, has a value."""

    def curve(stops: float) -> float:
        whole = math.floor(stops)
        m = 2.0 ** (stops - whole)
        more = ((_AGX_LOG[3] * m + _AGX_LOG[2]) * m + _AGX_LOG[1]) * m + _AGX_LOG[0]
        return _horner((whole + m - 1.0 + more + first + 12.47393) / _AGX_STOPS)

    return _where(curve, value, -12.47393 - first, 4.026069 - first)


def _where(function: Callable[[float], float], value: float, low: float, high: float) -> float:
    """Return where an increasing function has a value, by bisection."""
    for _ in range(50):
        middle = 0.5 * (low + high)
        if function(middle) < value:
            low = middle
        else:
            high = middle
    return low


def _horner(t: float) -> float:
    total = 0.0
    for coefficient in _AGX_CURVE:
        total = total * t + coefficient
    return total
