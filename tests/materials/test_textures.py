"""Textures: which images are pixels, copying, versions."""

import numpy as np
import pytest

from engine3d.errors import InvalidArgumentError
from engine3d.model.materials.textures import PlacedTexture, Texture


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


@pytest.mark.parametrize("value", [0, 17, -1, 2.5, True, "4", None, float("nan")])
def test_anisotropies_are_whole_numbers_up_to_16(value):
    with pytest.raises(InvalidArgumentError, match=r"anisotropy must be a whole number in 1..16"):
        Texture(image(1, 1), anisotropy=value)


@pytest.mark.parametrize("value", [16.5, -17, float("nan"), "sharp", None])
def test_biases_are_numbers_of_levels(value):
    with pytest.raises(InvalidArgumentError, match=r"lod_bias must be in -16..16"):
        Texture(image(1, 1), lod_bias=value)


def test_both_count_as_changes():
    texture = Texture(image(1, 1), anisotropy=8.0, lod_bias=1)
    assert (texture.anisotropy, texture.lod_bias) == (8, 1.0)
    before = texture.version
    texture.anisotropy = 16
    between = texture.version
    texture.lod_bias = -0.5
    assert before < between < texture.version


@pytest.mark.parametrize("option", ["color_space", "filter", "wrap"])
def test_unknown_options_are_refused(option):
    with pytest.raises(InvalidArgumentError, match=option):
        Texture(image(1, 1), **{option: "unknown"})


def test_wraps_of_both_coordinates():
    texture = Texture(image(2, 2), wrap=["repeat", "clamp"])
    assert (texture.wrap, texture.side_wraps) == (("repeat", "clamp"), ("repeat", "clamp"))
    before = texture.version
    texture.wrap = ("mirror", "mirror")
    assert (texture.wrap, texture.side_wraps) == ("mirror", ("mirror", "mirror"))
    assert texture.version > before


@pytest.mark.parametrize(
    ("wrap", "message"),
    [
        (("repeat",), r"wrap must be one name or a pair \(u, v\), not \('repeat',\)"),
        (("repeat", "clamp", "clamp"), "a pair"),
        (("repeat", "round"), "wrap must be one of 'repeat', 'clamp', 'mirror', not 'round'"),
        (7, "not 7"),
    ],
)
def test_wrong_wraps_are_refused(wrap, message):
    with pytest.raises(InvalidArgumentError, match=message):
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
        ({"uv_set": 2}, "uv_set must be a whole number in 0..1, not 2"),
        ({"offset": (1,)}, "offset must be two finite numbers"),
        ({"scale": 2.0}, "scale must be two finite numbers"),
        ({"rotation": "left"}, "rotation must be a finite number"),
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
