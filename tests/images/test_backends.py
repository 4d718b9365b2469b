"""Every picture, with every output, on each backend and thread count: the reference's bytes."""

import functools

import numpy as np
import pytest
from images.scenes import SCENES

import engine3d as e3d
from engine3d._native.rasterizer import BACKENDS
from engine3d.rendering.frame import OUTPUTS

THREADS = (1, 2, 3, 8)


@functools.lru_cache(maxsize=4)
def reference(name):
    """The picture, and its frame by the scalar reference."""
    picture = SCENES[name]()
    return picture, picture.draw("scalar")


def assert_same(frame, expected, outputs=tuple(OUTPUTS)):
    for name in outputs:
        got, wanted = getattr(frame, name), getattr(expected, name)
        if got.tobytes() != wanted.tobytes():
            view = np.uint8 if name == "color" else np.uint32
            differ = np.argwhere(np.atleast_3d(got.view(view) != wanted.view(view)).any(axis=2))
            row, column = differ[0]
            raise AssertionError(
                f"{name}: {len(differ)} pixels differ, the first at row {row}, column {column}: "
                f"{got[row, column]}, not {wanted[row, column]}"
            )


# The backends of a picture follow each other, so that its reference is drawn once.
@pytest.mark.parametrize("backend", [backend for backend in BACKENDS if backend != "scalar"])
@pytest.mark.parametrize("name", sorted(SCENES))
def test_same_bytes(backend, name):
    if backend not in e3d.backends():
        pytest.skip(f"{backend}: this build or CPU lacks it")
    picture, expected = reference(name)
    for threads in THREADS:
        assert_same(picture.draw(backend, threads), expected)
    assert_same(picture.draw(backend, 2, ("color",)), expected, ("color",))


@pytest.mark.parametrize("name", ["mode_lit", "samples_16", "wireframe_only", "mode_overdraw"])
@pytest.mark.parametrize("output", OUTPUTS)
def test_one_output_at_a_time(name, output):
    """What else is asked for changes no output; for each backend by itself."""
    picture, expected = reference(name)
    for backend in e3d.backends():
        assert_same(picture.draw(backend, 2, (output,)), expected, (output,))


def test_enough_pictures():
    assert len(SCENES) >= 50
