"""The sRGB table against exact arithmetic; which numbers are colours, and in which space."""

from decimal import Decimal, getcontext

import numpy as np
import pytest

from engine3d import linear
from engine3d.errors import Engine3DError
from engine3d.model.materials.colors import (
    display_from_linear,
    linear_color,
    linear_from_display,
    srgb_to_linear_table,
)


def test_the_table_is_the_srgb_curve_rounded_once():
    getcontext().prec = 40
    table = srgb_to_linear_table()
    for value in range(256):
        encoded = Decimal(value) / 255
        if encoded <= Decimal("0.04045"):
            exact = encoded / Decimal("12.92")
        else:
            exact = ((encoded + Decimal("0.055")) / Decimal("1.055")) ** Decimal("2.4")
        assert table[value] == np.float32(float(exact))


def test_floats_are_display_values():
    assert linear_color((0.0, 0.5, 1.0)).tolist() == pytest.approx([0, 0.2140411, 1], abs=1e-5)
    for code in range(256):
        assert linear_color((code / 255, 0.5, 0))[0] == srgb_to_linear_table()[code]
        assert linear_color(np.float32([code / 255, 0.5, 0]))[0] == srgb_to_linear_table()[code]


def test_what_is_marked_is_linear_light():
    assert linear_color(linear(0.25, 0.5, 2.0)).tolist() == [0.25, 0.5, 2.0]


def test_display_values_ascend_and_come_back():
    values = np.linspace(0, 1, 5001)
    light = linear_from_display(values)
    assert (np.diff(light) > 0).all()
    np.testing.assert_allclose(display_from_linear(light), values, atol=1e-6)
    random = np.random.default_rng(1).random(5000).astype(np.float32)
    assert (linear_from_display(display_from_linear(random)) == random).mean() > 0.999


def test_between_codes_light_is_within_a_hundredth_of_a_code_of_the_curve():
    values = np.linspace(0, 1, 5001)
    curve = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    codes = 255 * display_from_linear(linear_from_display(values))
    np.testing.assert_allclose(255 * display_from_linear(curve), codes, atol=0.01)


def test_display_values_end_at_one():
    assert linear_color((1 + 1e-9, 0, 0))[0] == 1
    for brighter in ((1.1, 0, 0), (255.0, 0, 0), np.array([2.0, 0, 0])):
        with pytest.raises(Engine3DError, match="linear"):
            linear_color(brighter)


def test_integers_are_srgb():
    assert linear_color((255, 0, 128)).tolist() == pytest.approx([1, 0, 0.2158605], abs=1e-6)


def test_in_linear_color_space_bytes_keep_their_value():
    assert linear_color((255, 0, 51), "linear").tolist() == pytest.approx([1, 0, 0.2])


def test_integers_of_zero_and_one_mean_floats():
    assert linear_color((1, 1, 1)).tolist() == [1, 1, 1]
    assert linear_color((0, 1, 0)).tolist() == [0, 1, 0]


def test_one_float_makes_all_floats():
    assert linear_color((1, 0.9, 0.8)).tolist() == pytest.approx([1, 0.787412, 0.603827], abs=1e-5)


def test_uint8_is_always_8_bit():
    assert linear_color(np.array([1, 1, 1], np.uint8))[0] == srgb_to_linear_table()[1]


@pytest.mark.parametrize(
    "value",
    [
        (1, 2),
        (2, 2, 3, 4),
        3,
        (256, 0, 0),
        (-1, 0, 0),
        (float("nan"), 0, 0),
        "redd",
        b"red",
        "",
        None,
    ],
)
def test_what_is_no_color_is_refused(value):
    with pytest.raises(Engine3DError):
        linear_color(value)
