"""PNG files without alpha, read back by Pillow."""

import io

import numpy as np
import pytest
from PIL import Image

import engine3d as e3d
from engine3d._native.images import encode_opaque_png
from engine3d.datasets.opaque_png import color_png, grey_png, mask_png


def read(data):
    with Image.open(io.BytesIO(data)) as image:
        return np.asarray(image), image.mode


@pytest.mark.parametrize("shape", [(1, 1), (37, 53), (64, 300)])
def test_grey_pictures_read_back(shape):
    random = np.random.default_rng(0)
    deep = (random.integers(0, 65536, shape) // (1 + np.arange(shape[1]))).astype(np.uint16)
    pixels, mode = read(grey_png(deep))
    assert mode.startswith("I") and np.array_equal(pixels, deep)
    shallow = (deep >> 8).astype(np.uint8)
    pixels, mode = read(grey_png(shallow[:, ::-1]))
    assert mode == "L" and np.array_equal(pixels, shallow[:, ::-1])
    mask = shallow > 20
    assert np.array_equal(read(mask_png(mask))[0], mask * 255)


def test_color_reads_back_without_alpha():
    scene = e3d.Scene(background=None)
    scene.add(e3d.torus(), euler=(1, 0, 0))
    frame = e3d.render(scene, size=(41, 30), samples=4)
    pixels, mode = read(color_png(frame))
    assert mode == "RGB" and np.array_equal(pixels, frame.color[..., :3])


@pytest.mark.parametrize("shape", [(4, 4, 4), (4, 4, 5), (0, 4, 1), (4, 0, 2)])
def test_other_shapes_are_refused(shape):
    with pytest.raises(e3d.InvalidArgumentError):
        encode_opaque_png(np.zeros(shape, np.uint8))


def test_pixels_with_gaps_are_refused():
    with pytest.raises(e3d.InvalidArgumentError, match="contiguous"):
        encode_opaque_png(np.zeros((4, 8, 1), np.uint8)[:, ::2])
