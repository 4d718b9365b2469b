"""PNG files: lossless at every size, small where pictures are flat, sound to other readers."""

import io

import numpy as np
import pytest
from PIL import Image

from engine3d.png import encode_png


def decoded(data):
    with Image.open(io.BytesIO(data)) as image:
        image.load()
        assert (image.format, image.mode) == ("PNG", "RGBA")
        return np.asarray(image)


@pytest.mark.parametrize("size", [(1, 1), (1, 70), (70, 1), (2, 3), (33, 129), (300, 400)])
def test_noise_is_kept(size):
    pixels = np.random.default_rng(sum(size)).integers(0, 256, (*size, 4), np.uint8)
    np.testing.assert_array_equal(decoded(encode_png(pixels)), pixels)


def test_views_are_kept():
    pixels = np.random.default_rng(1).integers(0, 256, (40, 30, 4), np.uint8)
    for view in (pixels[::-1], pixels[:, ::2], pixels[3:9, 4:7]):
        np.testing.assert_array_equal(decoded(encode_png(view)), view)


def test_flat_pictures_are_small():
    assert len(encode_png(np.full((720, 1280, 4), 43, np.uint8))) < 40_000


def test_same_pixels_same_bytes():
    pixels = np.random.default_rng(2).integers(0, 256, (50, 60, 4), np.uint8)
    assert encode_png(pixels) == encode_png(pixels.copy())
