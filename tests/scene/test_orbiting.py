"""Camera poses around a target."""

import math

import numpy as np
import pytest

import engine3d as e3d


@pytest.mark.parametrize(
    ("azimuth", "elevation", "up", "side"),
    [
        (0.0, 0.0, (0, 1, 0), (0, 0, 1)),
        (math.pi / 2, 0.0, (0, 1, 0), (1, 0, 0)),
        (math.pi, 0.0, (0, 2, 0), (0, 0, -1)),
        (0.0, math.pi / 2, (0, 1, 0), (0, 1, 0)),
        (0.0, -math.pi / 2, (0, 1, 0), (0, -1, 0)),
        (0.0, 0.0, (0, 0, 1), (0, -1, 0)),
        (math.pi / 2, 0.0, (0, 0, 1), (1, 0, 0)),
    ],
)
def test_right_angles_are_exact(azimuth, elevation, up, side):
    pose = e3d.orbit((1, 2, 3), 4.0, azimuth, elevation, up=up)
    np.testing.assert_array_equal(pose[:3, 3], np.array((1, 2, 3)) + 4.0 * np.array(side))
    np.testing.assert_array_equal(pose[:3, 2], side)


def test_poses_look_at_the_target():
    azimuths = np.linspace(-3.0, 9.0, 17)
    poses = e3d.orbit((1, -2, 0.5), 3.0, azimuths, 0.4, up=(0, 0, 1))
    assert poses.shape == (17, 4, 4)
    for pose, azimuth in zip(poses, azimuths, strict=True):
        eye = pose[:3, 3]
        np.testing.assert_allclose(pose, e3d.look_at(eye, (1, -2, 0.5), (0, 0, 1)), atol=1e-12)
        np.testing.assert_array_equal(
            pose, e3d.orbit((1, -2, 0.5), 3.0, azimuth, 0.4, up=(0, 0, 1))
        )
    assert e3d.orbit((0, 0, 0), 1.0, 0.0, [0.0, 0.5]).shape == (2, 4, 4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((0, 0), 1.0, 0.0), "target"),
        (((0, 0, 0), 0.0, 0.0), "distance"),
        (((0, 0, 0), 1.0, "east"), "azimuth"),
        (((0, 0, 0), 1.0, math.nan), "finite"),
        (((0, 0, 0), 1.0, [[0.0]]), "azimuth"),
        (((0, 0, 0), 1.0, [0.0, 1.0], [0.0, 1.0, 1.5]), "azimuth and elevation"),
        (((0, 0, 0), 1.0, 0.0, 1.6), "elevation"),
    ],
)
def test_wrong_arguments(arguments, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.orbit(*arguments)


def test_no_up_direction():
    with pytest.raises(e3d.InvalidArgumentError, match="up"):
        e3d.orbit((0, 0, 0), 1.0, 0.0, up=(0, 0, 0))
