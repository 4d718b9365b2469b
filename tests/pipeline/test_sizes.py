"""The smallest, the largest and odd sizes of a frame."""

import os

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d

LARGEST = 16384
CAMERA = (e3d.Camera(np.eye(4)), np.eye(4))  # view space is clip space


def left_half():
    """A scene whose left half of the picture is white, its right half background."""
    scene = e3d.Scene(background=(0, 0, 90))
    scene.add(e3d.primitives.quad((-1, -1, 0), (0, -1, 0), (0, 1, 0), (-1, 1, 0)))
    return scene


def free_memory():
    if not hasattr(os, "sysconf"):
        return 0  # Windows does not tell
    return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.parametrize("backend", e3d.backends())
@pytest.mark.parametrize(
    ("width", "height"),
    [(1, 1), (2, 1), (1, 2), (3, 5), (63, 65), (64, 64), (127, 3), (LARGEST, 1), (1, LARGEST)],
)
def test_odd_sizes(backend, width, height):
    frame = render(left_half(), CAMERA, size=(width, height), mode="unlit", backend=backend)
    white = np.arange(width) + 0.5 < width / 2
    expected = np.where(white[:, None], (255, 255, 255, 255), (0, 0, 90, 255)).astype(np.uint8)
    np.testing.assert_array_equal(frame.color, np.broadcast_to(expected, frame.color.shape))


OUTPUTS = ("color",), ("color", "ndc_depth"), ("color", "depth", "object_id"), ("ndc_depth",)


@pytest.mark.parametrize("backend", [name for name in e3d.backends() if name != "scalar"])
@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("size", [(640, 480), (601, 475)])  # 1 MB and more: past the caches
def test_every_pixel_is_written(backend, samples, size):
    """Over what the memory held before: tiles of spheres, and those that nothing is in."""
    scene = e3d.Scene(background=(20, 30, 40))
    for x in (-1, 1):
        scene.add(e3d.uv_sphere(0.4, (24, 16)), translation=(x, x / 3, -3))
    camera, settings = e3d.PerspectiveCamera(), {"samples": samples}
    names = OUTPUTS[1] + OUTPUTS[2][1:]
    expected = render(
        scene, (camera, np.eye(4)), size=size, backend="scalar", outputs=names, **settings
    )
    for threads in (1, 2):
        renderer = Renderer(size, backend=backend, threads=threads, **settings)
        for outputs in OUTPUTS:
            frame = renderer.render(scene, (camera, np.eye(4)), outputs=outputs)
            for name in outputs:
                getattr(frame, name).view(np.uint8)[...] = 77
            renderer.render(scene, (camera, np.eye(4)), out=frame)
            for name in outputs:
                np.testing.assert_array_equal(getattr(frame, name), getattr(expected, name))


@pytest.mark.skipif(free_memory() < 4 << 30, reason="needs 4 GB of free memory")
def test_the_largest_frame():
    frame = render(left_half(), CAMERA, size=(LARGEST, LARGEST), mode="unlit")
    half = LARGEST // 2
    assert (frame.color[::97, :half, 0] == 255).all()
    assert (frame.color[::97, half:, 2] == 90).all()
    assert (frame.color[-1, :half] == 255).all()
