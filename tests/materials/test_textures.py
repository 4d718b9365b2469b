"""Textures: which images are pixels, copying, versions."""

import numpy as np
import pytest

from engine3d.errors import InvalidArgumentError
from engine3d.materials.textures import PlacedTexture, Texture


def image(*shape):
    return np.arange(np.prod(shape), dtype=np.uint8).reshape(shape)


def test_grey_is_widened():
    pixels = Texture(image(2, 3)).pixels
    assert pixels.shape == (2, 3, 4)
    assert pixels[1, 2].tolist() == [5, 5, 5, 255]


def test_grey_with_alpha_is_widened():
    assert Texture(image(1, 2, 2)).pixels[0, 1].tolist() == [2, 2, 2, 3]


def test_rgb_gets_an_opaque_alpha():
    assert Texture(image(1, 2, 3)).pixels[0, 1].tolist() == [3, 4, 5, 255]


def test_pixels_are_read_only_and_the_textures_own():
    source = image(2, 2, 4)
    texture = Texture(source)
    source[:] = 0
    assert texture.pixels[1, 1, 3] == 15
    with pytest.raises(ValueError, match="read-only"):
        texture.pixels[0, 0, 0] = 1


def test_assigning_raises_the_version():
    texture = Texture(image(2, 2, 4))
    before = texture.version
    texture.pixels = image(4, 4, 4)
    texture.filter = "nearest"
    assert texture.version > before
    assert (texture.width, texture.height) == (4, 4)


@pytest.mark.parametrize(
    "pixels",
    [
        np.zeros((2, 2, 4), np.float32),
        np.zeros((0, 2, 4), np.uint8),
        np.zeros((2, 2, 5), np.uint8),
        np.zeros(4, np.uint8),
        np.zeros((1, 32769), np.uint8),
    ],
)
def test_what_is_no_image_is_refused(pixels):
    with pytest.raises(InvalidArgumentError):
        Texture(pixels)


@pytest.mark.parametrize("option", ["color_space", "filter", "wrap"])
def test_unknown_options_are_refused(option):
    with pytest.raises(InvalidArgumentError, match=option):
        Texture(image(1, 1), **{option: "unknown"})


def test_wraps_along_two_sides_are_one_where_they_are_the_same():
    texture = Texture(image(1, 1), wrap=["clamp", "mirror"])
    assert texture.wrap == ("clamp", "mirror")
    texture.wrap = ("repeat", "repeat")
    assert texture.wrap == "repeat"


@pytest.mark.parametrize("wrap", [(), ("clamp",), ("clamp",) * 3, ("clamp", "unknown"), 3, None])
def test_wraps_that_are_none_are_refused(wrap):
    with pytest.raises(InvalidArgumentError, match="wrap must be one"):
        Texture(image(1, 1), wrap=wrap)


def test_a_path_is_not_taken_for_pixels():
    with pytest.raises(InvalidArgumentError, match=r"use load_texture\('wood.png'\)"):
        Texture("wood.png")


def test_placed_textures_compare_by_value_and_stay_as_they_are():
    texture = Texture(np.zeros((1, 1), np.uint8))
    placed = PlacedTexture(texture, uv_set=1, offset=[1, 2], rotation=0.5, scale=np.ones(2))
    assert placed == PlacedTexture(texture, uv_set=1, offset=(1, 2), rotation=0.5)
    assert placed != PlacedTexture(texture)
    assert not PlacedTexture(texture, uv_set=1).is_moved and placed.is_moved
    with pytest.raises(AttributeError):
        placed.offset = (0, 0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"uv_set": 2}, "uv_set must be 0 or 1, not 2"),
        ({"offset": (1,)}, "offset must be two finite numbers"),
        ({"scale": 2.0}, "scale must be two finite numbers"),
        ({"rotation": "left"}, "rotation must be finite"),
    ],
)
def test_wrong_places_are_refused(arguments, message):
    with pytest.raises(InvalidArgumentError, match=message):
        PlacedTexture(Texture(np.zeros((1, 1), np.uint8)), **arguments)


def test_the_matrix_is_that_of_the_extension():
    """Scaled, turned, moved; with v downwards, as the extension has it."""
    texture = Texture(np.zeros((1, 1), np.uint8))
    placed = PlacedTexture(texture, offset=(0.25, -0.5), rotation=0.7, scale=(3.0, 2.0))
    c, s = np.cos(0.7), np.sin(0.7)
    for u, v in [(0, 0), (1, 0), (0.3, 0.8)]:
        expected = 3 * u * c + 2 * v * s + 0.25, -3 * u * s + 2 * v * c - 0.5
        got = placed.matrix @ (u, 1 - v, 1)
        assert np.allclose((got[0], 1 - got[1]), expected, atol=1e-12)
