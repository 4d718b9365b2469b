"""The arguments of the low-level door."""

import numpy as np
import pytest

import engine3d as e3d

CLIP = [[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]
FACES = [[0, 1, 2]]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.zeros((3, 3)), FACES, (4, 4)), r"clip must be \(V, 4\)"),
        (("clip", FACES, (4, 4)), "clip must be numbers"),
        ((CLIP, [[0, 1]], (4, 4)), r"faces must be \(F, 3\)"),
        ((CLIP, [[0.0, 1.0, 2.0]], (4, 4)), "integers"),
        ((CLIP, [[0, 1, 3]], (4, 4)), r"faces must be in 0\.\.2"),
        ((CLIP, [[0, 1, -1]], (4, 4)), r"found -1\.\.1"),
        ((CLIP, FACES, (0, 4)), r"width must be a whole number in 1\.\.16384"),
        ((CLIP, FACES, (4, 16385)), "height"),
        ((CLIP, FACES, (4.0, 4)), "width"),
    ],
)
def test_invalid_arguments(arguments, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.rasterization.rasterize(*arguments)


def test_invalid_options():
    with pytest.raises(
        e3d.InvalidArgumentError, match="cull must be one of 'none', 'back', 'front'"
    ):
        e3d.rasterization.rasterize(CLIP, FACES, (4, 4), cull="sideways")
    with pytest.raises(e3d.errors.BackendError):
        e3d.rasterization.rasterize(CLIP, FACES, (4, 4), backend="gpu")


def test_nothing_to_draw():
    result = e3d.rasterization.rasterize(np.zeros((0, 4)), np.zeros((0, 3), int), (3, 2))
    assert result.face_id.tolist() == [[-1] * 3] * 2
    assert np.isposinf(result.depth).all()
    assert result.barycentric.shape == (2, 3, 3)
    assert not result.barycentric.any()
