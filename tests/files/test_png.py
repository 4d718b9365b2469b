"""PNG files: lossless at every size, small where pictures are flat, sound to other readers."""

import hashlib
import io

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d._native.images import encode_png
from engine3d.apps.golden.png_files import is_deep, read_deep
from engine3d.base.files.png import encode_pixels


def decoded(data):
    with Image.open(io.BytesIO(data)) as image:
        image.load()
        assert (image.format, image.mode) == ("PNG", "RGBA")
        return np.asarray(image)


@pytest.mark.parametrize("size", [(1, 1), (1, 70), (70, 1), (2, 3), (33, 129), (300, 400)])
def test_noise_is_kept(size):
    pixels = np.random.default_rng(sum(size)).integers(0, 256, (*size, 4), np.uint8)
    np.testing.assert_array_equal(decoded(encode_png(pixels)), pixels)


def test_rows_may_lie_apart():
    pixels = np.random.default_rng(1).integers(0, 256, (40, 30, 4), np.uint8)
    for view in (pixels[::-1], pixels[3:9, 4:7], pixels[::2]):
        np.testing.assert_array_equal(decoded(encode_png(view)), view)


@pytest.mark.parametrize("shape", [(0, 4, 4), (4, 0, 2), (4, 4, 5), (1, 16385, 4)])
def test_shapes_that_are_refused(shape):
    with pytest.raises(e3d.InvalidArgumentError):
        encode_png(np.zeros(shape, np.uint8))
    with pytest.raises(e3d.InvalidArgumentError):
        encode_png(np.zeros((4, 8, 4), np.uint8)[:, ::2])
    for channels, bits in ((3, 16), (10, 16), (4, 32)):
        with pytest.raises(e3d.InvalidArgumentError):
            encode_png(np.zeros((4, 8, channels), np.uint8), bits)


@pytest.mark.parametrize("shape", [(1, 16384), (16384, 1), (40, 16384), (2000, 700)])
@pytest.mark.parametrize("kind", ["flat", "steps", "few values", "gradient", "mostly noise"])
def test_long_pictures_are_kept(shape, kind):
    """More than a chunk, a window and a block of whatever a picture may be made of."""
    rng = np.random.default_rng(shape[0])
    height, width = shape
    y, x = np.mgrid[:height, :width]
    plane = {
        "flat": np.full(shape, 43),
        "steps": x // 7 * 31 + y // 5,
        "few values": rng.integers(0, 2, shape) * 200,
        "gradient": (x * y) >> 6,
        "mostly noise": np.where(x % 900 < 700, rng.integers(0, 256, shape), 0),
    }[kind]
    pixels = np.stack([plane, plane + 1, plane * 3, np.full(shape, 255)], axis=-1).astype(np.uint8)
    np.testing.assert_array_equal(decoded(encode_png(pixels)), pixels)


def test_rare_symbols_get_codes_of_bounded_length():
    """Frequencies that double from value to value would make codes longer than 15 bits."""
    values = np.repeat(np.arange(20), 1 << np.arange(20))[-(1 << 19) :]
    steps = np.random.default_rng(3).permutation(values)
    row = np.cumsum(steps).astype(np.uint8)
    pixels = np.repeat(row[:, np.newaxis], 4, axis=1).reshape(64, -1, 4)
    np.testing.assert_array_equal(decoded(encode_png(pixels)), pixels)


def test_flat_pictures_are_small_and_noise_hardly_grows():
    assert len(encode_png(np.full((720, 1280, 4), 43, np.uint8))) < 6_000
    noise = np.random.default_rng(4).integers(0, 256, (300, 300, 4), np.uint8)
    assert len(encode_png(noise)) < noise.size * 1.002


def test_same_pixels_same_bytes():
    pixels = np.random.default_rng(2).integers(0, 256, (50, 60, 4), np.uint8)
    assert encode_png(pixels) == encode_png(pixels.copy())


def test_bytes_are_those_of_every_machine():
    y, x = np.mgrid[:90, :120]
    pixels = np.stack([x ^ y, (x * y) >> 3, x + y, np.full(x.shape, 255)], axis=-1)
    data = encode_png(np.ascontiguousarray(pixels.astype(np.uint8)))
    assert hashlib.sha256(data).hexdigest()[:16] == "83222f41c817420c"


@pytest.mark.parametrize("size", [(1, 1), (37, 53), (64, 300)])
@pytest.mark.parametrize("channels", [0, 1, 2, 3, 4])
def test_every_kind_of_pixels_is_kept(size, channels):
    shape = (*size, channels) if channels else size
    random = np.random.default_rng(channels)
    steps = 1 + np.arange(size[1]).reshape(1, -1, *([1] if channels else []))
    deep = (random.integers(0, 65536, shape) // steps).astype(np.uint16)
    for pixels in (deep >> 8).astype(np.uint8), (deep >> 8).astype(np.uint8)[::-1, ::-1]:
        with Image.open(io.BytesIO(encode_pixels(pixels))) as image:
            assert image.mode == ("L", "L", "LA", "RGB", "RGBA")[channels]
            assert np.array_equal(np.asarray(image).reshape(shape), pixels)
    data = encode_pixels(deep)
    if is_deep(data):
        assert np.array_equal(read_deep(data), deep)
    else:
        with Image.open(io.BytesIO(data)) as image:
            assert image.mode.startswith("I")
            assert np.array_equal(np.asarray(image).reshape(shape), deep)
    mask = deep > 5000
    assert encode_pixels(mask) == encode_pixels(np.where(mask, np.uint8(255), np.uint8(0)))
