"""Every picture, with every output, on each backend: the reference's bytes, whose hashes are kept.

Each backend draws each picture with one thread and with two, three or eight, in turn: each picture
with all of them on some backend, each backend with all of them over the pictures.
"""

import functools
import gc

import numpy as np
import pytest
from images import golden
from images.picture import digests
from images.scenes import SCENES

import engine3d as e3d
from engine3d._native.rasterizer import BACKENDS
from engine3d.rendering.frame import OUTPUTS

THREADS = (2, 3, 8)
IDS = tuple(name for name in OUTPUTS if name.endswith("_id"))
NAMES = sorted(SCENES)
HOW = "to look: python tests/images/golden.py --pictures FOLDER; if it is meant: --update"


@functools.lru_cache(maxsize=4)
def reference(name):
    """The picture, and its frame by the scalar reference."""
    gc.collect()  # scenes and nodes hold each other: gigabytes of them would wait for Python
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
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("name", NAMES)
def test_same_bytes(backend, name):
    if backend not in e3d.backends():
        pytest.skip(f"{backend}: this build or CPU lacks it")
    picture, expected = reference(name)
    if backend == "scalar":
        assert digests(expected) == hashes().get(name), f"the picture has changed; {HOW}"
        return
    several = THREADS[(NAMES.index(name) + list(BACKENDS).index(backend)) % len(THREADS)]
    for threads in (1, several):
        assert_same(picture.draw(backend, threads), expected)
    for outputs in (("color",), IDS):
        assert_same(picture.draw(backend, several, outputs), expected, outputs)


@functools.cache
def hashes():
    """What golden.json keeps: of what the reference drew when a person last looked at it."""
    return golden.load()


def test_each_picture_has_its_hashes():
    assert set(hashes()) == set(SCENES), HOW


@pytest.mark.parametrize("name", ["mode_lit", "samples_16", "wireframe_only", "mode_overdraw"])
@pytest.mark.parametrize("output", OUTPUTS)
def test_one_output_at_a_time(name, output):
    """What else is asked for changes no output; for each backend by itself."""
    picture, expected = reference(name)
    for backend in e3d.backends():
        assert_same(picture.draw(backend, 2, (output,)), expected, (output,))


def test_enough_pictures():
    assert len(SCENES) >= 50
