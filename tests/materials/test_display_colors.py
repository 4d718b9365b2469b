"""Colours look the same whether the frame's encoder makes them or not."""

import numpy as np
import pytest

from engine3d import linear
from engine3d.model.materials.display_colors import display_color, encode_srgb, shading_color


@pytest.mark.parametrize("code", range(256))
def test_8_bit_colours_keep_their_code(code):
    value = display_color((code, 255, 2), "srgb")
    assert [int(255 * np.float32(component) + 0.5) for component in value] == [code, 255, 2]
    value = display_color((code, 255, 2), "linear")
    assert [int(255 * np.float32(component) + 0.5) for component in value] == [code, 255, 2]


def test_marked_floats_are_linear_light():
    assert shading_color(linear(0.5, 2.0, 0), "srgb") == (0.5, 2.0, 0.0)
    assert display_color(linear(0.5, 2.0, 0), "srgb") == (188 / 255, 1.0, 0.0)
    assert display_color((0.5, 1.0, 0.0), "srgb") == (128 / 255, 1.0, 0.0)


def test_equal_numbers_of_other_kinds_are_other_colours():
    dark = np.uint8(1)
    assert shading_color((1, 1, 1), "srgb") == (1.0, 1.0, 1.0)
    assert shading_color((dark, dark, dark), "srgb") < (0.001, 0.001, 0.001)
    assert shading_color(linear(0.5, 0, 0), "srgb") > shading_color((0.5, 0, 0), "srgb")


def test_encode_ends():
    assert [encode_srgb(value) for value in (-1, 0, 1, 7)] == [0, 0, 255, 255]
