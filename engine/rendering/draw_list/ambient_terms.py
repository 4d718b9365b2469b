"""Hemisphere lights and light probes of a frame, summed into one polynomial of the normal.

In: lights and their nodes' rotations. Out: the nine terms of R130 in docs/exactness, three channels
each. All arithmetic is float64, in single operations (R131, R132).

The constants are those of Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance
Environment Maps", 2001, divided by pi.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ...base.linalg.single import normalize
from ...choices import ColorSpace
from ...model.materials.display_colors import shading_color
from ...model.scene.ambient_lights import AmbientLight, HemisphereLight, LightProbe

_CONSTANT = 0.5 / math.sqrt(math.pi)
_LINEAR = math.sqrt(3.0 / math.pi) / 3.0
_ALONG_Z = math.sqrt(5.0 / math.pi) / 16.0
_ACROSS = math.sqrt(15.0 / math.pi) / 16.0

_Rows = list[list[float]]


def ambient_terms(
    lights: Iterable[tuple[AmbientLight, Sequence[float]]], color_space: ColorSpace
) -> _Rows:
    """Return the sum of the lights' terms.

    Parameters
    ----------
    lights : iterable of (light, pose)
        Each light with the first three rows of its node's world pose, 12 floats.
    color_space : {"srgb", "linear"}
        How 8-bit colours are decoded.

    Returns
    -------
    terms : (9, 3) list of float
        For 1, x, y, z, xx - zz, yy - zz, xy, yz and zx.
    """
    total = [[0.0] * 3 for _ in range(9)]
    for light, pose in lights:
        axes = [normalize([pose[k], pose[4 + k], pose[8 + k]]) for k in range(3)]
        if isinstance(light, HemisphereLight):
            terms = _of_hemisphere(light, axes[1], color_space)
        else:
            terms = _of_probe(light, axes)
        for row, more in zip(total, terms, strict=True):
            for channel in range(3):
                row[channel] += light.intensity * more[channel]
    return total


def _of_hemisphere(light: HemisphereLight, up: Sequence[float], color_space: ColorSpace) -> _Rows:
    """Return the terms of a hemisphere light (R131)."""
    sky = shading_color(light.sky_color, color_space)
    ground = shading_color(light.ground_color, color_space)
    half = [0.5 * (a + b) for a, b in zip(sky, ground, strict=True)]
    rise = [0.5 * (a - b) for a, b in zip(sky, ground, strict=True)]
    return [half, *([part * c for c in rise] for part in up), *([0.0] * 3 for _ in range(5))]


def _of_probe(light: LightProbe, axes: Sequence[Sequence[float]]) -> _Rows:
    """Return the rotated terms of a probe (R132): per channel, a vector and a traceless matrix."""
    channels = [_turned(values, axes) for values in light.coefficients.T.tolist()]
    return [list(row) for row in zip(*channels, strict=True)]


def _turned(c: list[float], axes: Sequence[Sequence[float]]) -> list[float]:
    linear = [_LINEAR * c[3], _LINEAR * c[1], _LINEAR * c[2]]
    xy, yz, zx = _ACROSS * c[4], _ACROSS * c[5], _ACROSS * c[7]
    along, difference = _ALONG_Z * c[6], _ACROSS * c[8]
    matrix = [[difference - along, xy, zx], [xy, -difference - along, yz], [zx, yz, 2.0 * along]]
    turned = [_sum(linear[k] * axes[k][row] for k in range(3)) for row in range(3)]
    half = [
        [_sum(axes[k][row] * matrix[k][j] for k in range(3)) for j in range(3)] for row in range(3)
    ]
    full = [
        [_sum(half[row][j] * axes[j][col] for j in range(3)) for col in range(3)]
        for row in range(3)
    ]
    products = full[0][0], full[1][1], 2.0 * full[0][1], 2.0 * full[1][2], 2.0 * full[2][0]
    return [_CONSTANT * c[0], *turned, *products]


def _sum(values: Iterable[float]) -> float:
    a, b, c = values
    return (a + b) + c
