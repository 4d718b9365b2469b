"""The sRGB table against exact arithmetic; which numbers are colours, and in which space."""

from decimal import Decimal, getcontext

import numpy as np
import pytest

from engine3d.errors import Engine3DError
from engine3d.model.materials.colors import linear_color, srgb_to_linear_table


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


def test_floats_are_linear():
    assert linear_color((0.25, 0.5, 2.0)).tolist() == [0.25, 0.5, 2.0]


def test_integers_are_srgb():
    assert linear_color((255, 0, 128)).tolist() == pytest.approx([1, 0, 0.2158605], abs=1e-6)


def test_in_linear_color_space_bytes_keep_their_value():
    assert linear_color((255, 0, 51), "linear").tolist() == pytest.approx([1, 0, 0.2])


def test_integers_of_zero_and_one_mean_floats():
    assert linear_color((1, 1, 1)).tolist() == [1, 1, 1]
    assert linear_color((0, 1, 0)).tolist() == [0, 1, 0]


def test_one_float_makes_all_floats():
    assert linear_color((1, 0.9, 0.8)).tolist() == pytest.approx([1, 0.9, 0.8])


def test_uint8_is_always_8_bit():
    assert linear_color(np.array([1, 1, 1], np.uint8))[0] == srgb_to_linear_table()[1]


@pytest.mark.parametrize(
    "value", [(1, 2), (1, 2, 3, 4), 3, (256, 0, 0), (-1, 0, 0), (float("nan"), 0, 0), "red", None]
)
def test_what_is_no_color_is_refused(value):
    with pytest.raises(Engine3DError):
        linear_color(value)
