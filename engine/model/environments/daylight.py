"""The daylight sky: its radiance and colour, from the sun's position and the turbidity of the air.

In: the direction towards the sun, and the turbidity of the air. Out: the picture of the sky over
bare ground, and the light of the sun itself. Source: Preetham, Shirley and Smits, "A practical
analytic model for daylight", 1999: Perez's formula with their coefficients for the sky, Rayleigh
scattering and aerosols for the sun. A radiance of 1 is 25 kcd/m2, so that white paper shows about
as white under the midday sun.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ._directions import directions, picture, ramp, toward

Floats = NDArray[np.float64]

LEAST_TURBIDITY, MOST_TURBIDITY = 2.0, 10.0
_SCALE = 0.04  # of kcd/m2
_SUN = 128.0  # klx, outside the atmosphere
# Perez's five coefficients as slope and offset over the turbidity: for the luminance Y and the
# chromaticities x and y.
_PEREZ = (
    ((0.1787, -1.4630), (-0.3554, 0.4275), (-0.0227, 5.3251), (0.1206, -2.5771), (-0.0670, 0.3703)),
    (
        (-0.0193, -0.2592),
        (-0.0665, 0.0008),
        (-0.0004, 0.2125),
        (-0.0641, -0.8989),
        (-0.0033, 0.0452),
    ),
    (
        (-0.0167, -0.2608),
        (-0.0950, 0.0092),
        (-0.0079, 0.2102),
        (-0.0441, -1.6537),
        (-0.0109, 0.0529),
    ),
)
# Chromaticity at the zenith: rows by falling powers of the turbidity, columns by falling powers of
# the sun's zenith angle.
_ZENITH_X = (
    (0.00166, -0.00375, 0.00209, 0.0),
    (-0.02903, 0.06377, -0.03202, 0.00394),
    (0.11693, -0.21196, 0.06052, 0.25886),
)
_ZENITH_Y = (
    (0.00275, -0.00610, 0.00317, 0.0),
    (-0.04214, 0.08970, -0.04153, 0.00516),
    (0.15346, -0.26756, 0.06670, 0.26688),
)
_SRGB = ((3.2406, -1.5372, -0.4986), (-0.9689, 1.8758, 0.0415), (0.0557, -0.2040, 1.0570))
# At 650, 550 and 450 nm: the wavelengths in micrometres to the powers of -4.08 and -1.3.
_RAYLEIGH = (5.798471, 11.463579, 25.995187)
_AEROSOL = (1.750704, 2.175347, 2.823734)
_GROUND = (0.20, 0.175, 0.14)  # albedo
# Cosines at the disc's edge and core, about a degree from its centre: wider than the true sun so
# that pixels resolve it, and dimmer in proportion.
_EDGE, _CORE = 0.99982, 0.99988
_DISC = 2.0 * math.pi * (1.0 - 0.5 * (_EDGE + _CORE))  # steradians
_LEAST_COSINE = 0.02  # of the zenith angle at which the sky's colour is evaluated


class _Sky(NamedTuple):
    sun: tuple[float, float, float]
    angle: float  # zenith angle of the sun
    perez: tuple[tuple[float, ...], ...]
    zenith: tuple[float, float, float]


def pixels(
    sun: tuple[float, float, float], turbidity: float, has_disc: bool
) -> NDArray[np.float32]:
    """Return the picture, (H, W, 3) float32.

    Parameters
    ----------
    sun : (3,) float
        Towards the sun, of unit length and not below the horizon.
    turbidity : float
    has_disc : bool
        Whether the sun's disc is drawn.
    """
    rays = directions(512)
    cosine = toward(sun, rays)
    up = np.maximum(rays[1], _LEAST_COSINE)
    sky = _colors(_sky_of(sun, turbidity), up, cosine)
    light = sunlight(sun, turbidity)
    ground = _ground(sun, turbidity, light)
    above = ramp(-0.012, 0.004, rays[1])
    far = np.clip(1.0 + rays[1], 0.0, 1.0)
    for _ in range(4):
        far = far * far
    disc = ramp(_EDGE, _CORE, cosine) if has_disc else 0.0
    channels = []
    for k in range(3):
        earth = ground[k] + (sky[k] - ground[k]) * (0.8 * far)
        seen = earth + (sky[k] - earth) * above
        channels.append(seen + disc * above * (light[k] / _DISC))
    return picture(channels)


def sunlight(sun: tuple[float, float, float], turbidity: float) -> tuple[float, float, float]:
    """Return the irradiance of the sun on a surface that faces it, in red, green and blue."""
    degrees = math.degrees(_from_zenith(sun))
    air = 1.0 / (sun[1] + 0.15 * _power(93.885 - degrees, -1.253))
    beta = 0.04608 * turbidity - 0.04586
    red, green, blue = (
        _SUN * _SCALE * _exp(-0.008735 * rayleigh * air) * _exp(-beta * aerosol * air)
        for rayleigh, aerosol in zip(_RAYLEIGH, _AEROSOL, strict=True)
    )
    return red, green, blue


def _sky_of(sun: tuple[float, float, float], t: float) -> _Sky:
    angle = _from_zenith(sun)
    chi = (4.0 / 9.0 - t / 120.0) * (math.pi - 2.0 * angle)
    luminance = (4.0453 * t - 4.9710) * linalg.tan(chi) - 0.2155 * t + 2.4192
    perez = tuple(tuple(slope * t + offset for slope, offset in row) for row in _PEREZ)
    zenith = luminance, _chromaticity(_ZENITH_X, t, angle), _chromaticity(_ZENITH_Y, t, angle)
    return _Sky(sun, angle, perez, zenith)


def _chromaticity(rows: tuple[tuple[float, ...], ...], t: float, angle: float) -> float:
    total = 0.0
    for row in rows:
        value = 0.0
        for coefficient in row:
            value = value * angle + coefficient
        total = total * t + value
    return total


def _colors(sky: _Sky, up: Any, cosine: Any) -> list[Any]:
    """Return red, green and blue from the cosines with the zenith and with the sun."""
    straight = [_distribution(row, 1.0, sky.sun[1], sky.angle) for row in sky.perez]
    bent = np.clip(cosine, -1.0, 1.0)
    gamma = linalg.atan2(np.sqrt(1.0 - bent * bent), bent)
    luminance, x, y = (
        zenith * _distribution(row, up, bent, gamma) / over
        for zenith, row, over in zip(sky.zenith, sky.perez, straight, strict=True)
    )
    luminance = luminance * _SCALE
    big_x, big_z = x / y * luminance, (1.0 - x - y) / y * luminance
    return [np.maximum(r * big_x + g * luminance + b * big_z, 0.0) for r, g, b in _SRGB]


def _distribution(row: tuple[float, ...], up: Any, cosine: Any, gamma: Any) -> Any:
    """Evaluate Perez's formula."""
    a, b, c, d, e = row
    return (1.0 + a * _exp(b / up)) * (1.0 + c * _exp(d * gamma) + e * (cosine * cosine))


def _ground(
    sun: tuple[float, float, float], turbidity: float, light: tuple[float, float, float]
) -> list[float]:
    """Return the radiance of bare ground, lit by the sun and by some directions of the sky."""
    sky = _sky_of(sun, turbidity)
    total, weights = [0.0, 0.0, 0.0], 0.0
    for elevation in (0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.3, 1.5):
        up, level = linalg.sin(elevation), linalg.cos(elevation)
        for x, z in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)):
            cosine = up * sun[1] + level * (x * sun[0] + z * sun[2])
            color = _colors(sky, up, cosine)
            total = [s + up * level * float(c) for s, c in zip(total, color, strict=True)]
            weights += up * level
    return [
        reflects * (s / weights + received * sun[1] / math.pi)
        for reflects, s, received in zip(_GROUND, total, light, strict=True)
    ]


def _from_zenith(sun: tuple[float, float, float]) -> float:
    return linalg.atan2(math.sqrt(sun[0] * sun[0] + sun[2] * sun[2]), sun[1])


def _exp(x: Any) -> Any:
    """Return the exponential, with the same bits everywhere: a power of two times a series."""
    x = np.maximum(x, -700.0)
    whole = np.rint(x * 1.4426950408889634)
    rest = x - whole * 0.6931471805599453
    total = 1.0
    for k in range(14, 0, -1):
        total = 1.0 + total * rest / k
    return np.ldexp(total, np.asarray(whole, np.int32))


def _power(base: float, exponent: float) -> float:
    """Return a power of a number between 1 and 100, with the same bits everywhere."""
    low, high = 0.0, 5.0  # the bisection's bounds for its logarithm
    for _ in range(60):
        middle = 0.5 * (low + high)
        if _exp(middle) < base:
            low = middle
        else:
            high = middle
    return float(_exp(exponent * low))
