"""Filament's tone mapping, by which Open3D's offscreen pictures are made.

In: linear light. Out: light to be shown. It is a fit of the ACES output transform for monitors,
with 1/0.6 of its light (Filament's "ACES legacy"). In float64, by single operations, so that a
picture has the same bytes everywhere.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from .._phong import power

_Floats = NDArray[np.float64]
_Matrix = tuple[tuple[float, float, float], ...]

#: Primaries and white points (x, y) of what the matrices convert between; CIE 1931.
_D65, _ACES_WHITE = (0.31271, 0.32902), (0.32168, 0.33767)
_REC709 = ((0.640, 0.330), (0.300, 0.600), (0.150, 0.060))
_AP0 = ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.077))
_AP1 = ((0.713, 0.293), (0.165, 0.830), (0.128, 0.044))


def tone_mapped(light: _Floats) -> _Floats:
    """Return what is shown of linear light of Rec. 709, (N, 3), from 0 to 1."""
    color = _times(_TO_AP0, np.clip(light, 0.0, 65504.0))
    color = _glow(color)
    color = _less_red(color)
    color = np.clip(_times(_AP0_TO_AP1, color), 0.0, 65504.0)
    color = _toward_grey(color, 0.96) / 0.6
    color = (
        color * (2.785085 * color + 0.107772) / (color * (2.936045 * color + 0.887122) + 0.806889)
    )
    # A viewer in a dim room: luminance to the power 0.9811, colours as they are.
    luminance = _luminance(color)
    shown = np.where(luminance > 0, power(luminance, 0.9811), 0.0)
    color = color * (shown / np.where(luminance > 0, luminance, 1.0))[:, np.newaxis]
    return np.clip(_times(_AP1_TO_REC709, _toward_grey(color, 0.93)), 0.0, 1.0)


def _glow(color: _Floats) -> _Floats:
    """Brighten dark saturated colours."""
    red, green, blue = color[:, 0], color[:, 1], color[:, 2]
    spread = blue * (blue - green) + green * (green - red) + red * (red - blue)
    chroma = np.sqrt(np.maximum(spread, 0.0))
    bright = (blue + green + red + 1.75 * chroma) / 3.0
    shaped = (_saturation(color) - 0.4) / 0.2
    half = np.maximum(1.0 - np.abs(shaped / 2.0), 0.0)
    gain = 0.05 * (1.0 + np.sign(shaped) * (1.0 - half * half)) / 2.0
    fading = gain * (0.08 / np.where(bright > 0, bright, 1.0) - 0.5)
    gain = np.where(bright <= 0.16 / 3.0, gain, np.where(bright >= 0.16, 0.0, fading))
    return color * (1.0 + gain)[:, np.newaxis]


def _less_red(color: _Floats) -> _Floats:
    """Darken the red of saturated reds."""
    red, green, blue = color[:, 0], color[:, 1], color[:, 2]
    hue = linalg.atan2(math.sqrt(3.0) * (green - blue), 2.0 * red - green - blue)
    near = np.clip(1.0 - np.abs(2.0 * np.degrees(hue) / 135.0), 0.0, 1.0)
    weight = near * near * (3.0 - 2.0 * near)
    weight = weight * weight
    changed = color.copy()
    changed[:, 0] = red + weight * _saturation(color) * (0.03 - red) * 0.18
    return changed


def _saturation(color: _Floats) -> _Floats:
    least, most = color.min(axis=1), color.max(axis=1)
    return (np.maximum(most, 1e-5) - np.maximum(least, 1e-5)) / np.maximum(most, 1e-2)


def _luminance(color: _Floats) -> _Floats:
    weights = _LUMINANCE
    return (color[:, 0] * weights[0] + color[:, 1] * weights[1]) + color[:, 2] * weights[2]


def _toward_grey(color: _Floats, share: float) -> _Floats:
    grey = _luminance(color)[:, np.newaxis]
    return grey + (color - grey) * share


def _times(matrix: _Floats, color: _Floats) -> _Floats:
    parts = color[:, np.newaxis, :] * matrix
    return (parts[..., 0] + parts[..., 1]) + parts[..., 2]


def _product(a: _Floats, b: _Floats) -> _Floats:
    return _times(a, b.T).T


def _inverse(matrix: _Floats) -> _Floats:
    whole = np.eye(4)
    whole[:3, :3] = matrix
    return linalg.inverse(whole)[:3, :3]


def _white(place: tuple[float, float]) -> _Floats:
    return np.array([place[0] / place[1], 1.0, (1.0 - place[0] - place[1]) / place[1]])


def _to_xyz(primaries, white: tuple[float, float]) -> _Floats:
    """Return the matrix from a colour space to CIE XYZ."""
    columns = np.array([[x, y, 1.0 - x - y] for x, y in primaries]).T
    amounts = _times(_inverse(columns), _white(white)[np.newaxis])[0]
    return columns * amounts


_AP0_XYZ, _AP1_XYZ = _to_xyz(_AP0, _ACES_WHITE), _to_xyz(_AP1, _ACES_WHITE)
_REC709_XYZ = _to_xyz(_REC709, _D65)
# White stays that of the monitor meanwhile, which makes it a little warm: so does Filament.
_TO_AP0 = _product(_inverse(_AP0_XYZ), _REC709_XYZ)
_AP0_TO_AP1 = _product(_inverse(_AP1_XYZ), _AP0_XYZ)
_AP1_TO_REC709 = _product(_inverse(_REC709_XYZ), _AP1_XYZ)
_LUMINANCE = _AP1_XYZ[1]
