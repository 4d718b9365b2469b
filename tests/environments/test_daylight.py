"""The sky by where the sun stands, against the formulas of Preetham et al. in float64."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.environments import daylight

NOON, DUSK = (0.3, 0.9, -0.2), (0.2, 0.02, -1.0)


def zenith_luminance(angle, t):
    chi = (4 / 9 - t / 120) * (math.pi - 2 * angle)
    return (4.0453 * t - 4.9710) * math.tan(chi) - 0.2155 * t + 2.4192


def perez_luminance(t, theta, gamma):
    a, b, c = 0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251
    d, e = 0.1206 * t - 2.5771, -0.0670 * t + 0.3703
    first = 1 + a * math.exp(b / math.cos(theta))
    return first * (1 + c * math.exp(d * gamma) + e * math.cos(gamma) ** 2)


def unit(v):
    return np.array(v) / np.linalg.norm(v)


@pytest.mark.parametrize("turbidity", [2.0, 3.5, 6.0])
@pytest.mark.parametrize("sun", [NOON, DUSK, (1, 1, 1)])
def test_luminance_of_the_sky(sun, turbidity):
    pixels = e3d.Environment.sky(sun, turbidity, sun_disc=False).pixels.astype(np.float64)
    towards = unit(sun)
    sun_angle = math.acos(towards[1])
    scale = zenith_luminance(sun_angle, turbidity) / perez_luminance(turbidity, 0, sun_angle)
    checked = 0
    for row in (20, 90, 160, 220):
        for column in range(0, 1024, 93):
            elevation = (0.5 - (row + 0.5) / 512) * math.pi
            azimuth = ((column + 0.5) / 1024 - 0.5) * 2 * math.pi
            level = math.cos(elevation)
            ray = level * math.cos(azimuth), math.sin(elevation), level * math.sin(azimuth)
            gamma = math.acos(min(1.0, float(np.dot(ray, towards))))
            expected = scale * perez_luminance(turbidity, math.pi / 2 - elevation, gamma)
            color = pixels[row, column]
            if (color > 0).all():  # else a colour that sRGB lacks was cut off
                luminance = 25 * float(color @ (0.2126, 0.7152, 0.0722))
                assert luminance == pytest.approx(expected, rel=2e-3)
                checked += 1
    assert checked > 20


def test_colours_by_the_hour():
    noon, dusk = (e3d.Environment.sky(sun).pixels for sun in (NOON, DUSK))
    assert (noon[30, ::100, 2] > 1.5 * noon[30, ::100, 0]).all()  # blue above
    horizon = dusk[250, 256]  # where the sun goes down
    assert horizon[0] > horizon[1] > horizon[2]
    assert noon.mean() > 5 * dusk.mean()
    assert np.isfinite(noon).all() and noon.min() >= 0


def test_the_sun_in_the_picture_gives_as_much_as_its_light():
    with_sun, without = (
        e3d.Environment.sky(NOON, 4.0, sun_disc=disc).pixels.astype(np.float64)
        for disc in (True, False)
    )
    rows = (0.5 - (np.arange(512) + 0.5) / 512) * math.pi
    solid = np.cos(rows)[:, None, None] * (2 * math.pi / 1024) * (math.pi / 512)
    disc = ((with_sun - without) * solid).sum(axis=(0, 1))
    light = e3d.DirectionalLight.sun(NOON, 4.0)
    assert np.allclose(disc, np.array(light.color) * light.intensity, rtol=0.1)
    assert np.allclose(light.direction, -unit(NOON))


def test_sunlight_reddens():
    high, low = (e3d.DirectionalLight.sun(sun) for sun in (NOON, DUSK))
    assert high.intensity > 10 * low.intensity
    assert high.color[2] > 0.7 > 0.1 > low.color[2] and high.color[0] == low.color[0] == 1


def test_exponentials_and_powers():
    x = np.linspace(-600, 20, 1001)
    assert np.allclose(daylight._exp(x), np.exp(x), rtol=1e-13)
    for base in (3.885, 45.0, 93.885):
        assert daylight._power(base, -1.253) == pytest.approx(base**-1.253, rel=1e-12)


def test_the_painted_sky_is_as_before():
    assert e3d.Environment.sky() is e3d.Environment.sky() and e3d.Environment.sky().sun is None
    made = e3d.Environment.sky(NOON)
    assert made is e3d.Environment.sky(NOON) and made.built_in == "sky"
    assert made.sun == (tuple(made.sun[0]), 3.0, True)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (((0, 0, 0),), "zero"),
        (((0, -0.1, 1),), "below the horizon"),
        (((0, 1, 0), 1.0), "turbidity"),
        ((None, 4.0), "sun_direction"),
        (((0, 1),), "sun_direction"),
    ],
)
def test_bad_arguments(arguments, told):
    with pytest.raises(e3d.InvalidArgumentError, match=told):
        e3d.Environment.sky(*arguments)
