"""The smallest, the largest and odd sizes of a frame."""

import os

import numpy as np
import pytest

import engine3d as e3d

LARGEST = 16384
CAMERA = (e3d.Camera(np.eye(4)), np.eye(4))  # view space is clip space


def left_half():
    """A scene whose left half of the picture is white, its right half background."""
    scene = e3d.Scene(background=(0, 0, 90))
    scene.add(e3d.quad((-1, -1, 0), (0, -1, 0), (0, 1, 0), (-1, 1, 0)))
    return scene


def free_memory():
    return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.parametrize("backend", e3d.backends())
@pytest.mark.parametrize(
    ("width", "height"),
    [(1, 1), (2, 1), (1, 2), (3, 5), (63, 65), (64, 64), (127, 3), (LARGEST, 1), (1, LARGEST)],
)
def test_odd_sizes(backend, width, height):
    frame = e3d.render(left_half(), CAMERA, size=(width, height), mode="unlit", backend=backend)
    white = np.arange(width) + 0.5 < width / 2
    expected = np.where(white[:, None], (255, 255, 255, 255), (0, 0, 90, 255)).astype(np.uint8)
    np.testing.assert_array_equal(frame.color, np.broadcast_to(expected, frame.color.shape))


@pytest.mark.skipif(free_memory() < 4 << 30, reason="needs 4 GB of free memory")
def test_the_largest_frame():
    frame = e3d.render(left_half(), CAMERA, size=(LARGEST, LARGEST), mode="unlit")
    half = LARGEST // 2
    assert (frame.color[::97, :half, 0] == 255).all()
    assert (frame.color[::97, half:, 2] == 90).all()
    assert (frame.color[-1, :half] == 255).all()
