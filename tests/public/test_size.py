"""Whatever draws takes its size as one pair, and says so when it gets two numbers."""

import numpy as np
import pytest

import engine3d as e3d

TRIANGLE = (np.zeros((3, 4)), [[0, 1, 2]])
TAKERS = {
    "Renderer": lambda *sides, **named: e3d.Renderer(*sides, **named),
    "Renderer.resize": lambda *sides, **named: e3d.Renderer((4, 4)).resize(*sides, **named),
    "Window": lambda *sides, **named: e3d.Window(*sides, **named),
    "Canvas": lambda *sides, **named: e3d.Canvas(*sides, **named),
    "Frame": lambda *sides, **named: e3d.Frame(*sides, {}, **named),
    "rasterize": lambda *sides, **named: e3d.rasterization.rasterize(*TRIANGLE, *sides, **named),
    "PerspectiveCamera.projection": lambda *sides, **named: e3d.PerspectiveCamera().projection(
        *sides, **named
    ),
}


@pytest.mark.parametrize("name", TAKERS)
def test_two_numbers_are_refused_by_the_new_word(name):
    with pytest.raises(TypeError) as refused:
        TAKERS[name](8, 6)
    assert str(refused.value) == f"{name}() takes size=(width, height), not a width and a height"


@pytest.mark.parametrize("name", [name for name in TAKERS if name != "Frame"])
def test_the_old_words_are_refused_by_the_new_one(name):
    with pytest.raises(TypeError, match=r"takes size=\(width, height\)"):
        TAKERS[name](width=8, height=6)


@pytest.mark.parametrize("size", [8, "8x6", (8, 6, 4), (8,), None])
@pytest.mark.parametrize("name", TAKERS)
def test_what_is_no_pair_is_told(name, size):
    with pytest.raises(e3d.InvalidArgumentError, match=r"size must be \(width, height\), not "):
        TAKERS[name](size)


def test_what_was_drawn_knows_its_size():
    with e3d.Renderer(size=(8, 6)) as renderer:
        frame = renderer.render(e3d.box())
        assert renderer.size == frame.size == frame.canvas().size == (8, 6)
        renderer.resize(size=(5, 7))
        assert renderer.size == (renderer.width, renderer.height) == (5, 7)
    assert e3d.Canvas(size=(8, 6)).size == (8, 6)
