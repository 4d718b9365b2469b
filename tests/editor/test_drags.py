"""Where a drag of the gizmo takes a pose: exactly by steps, about axes, without drifting."""

import math

import numpy as np
import pytest

from engine3d import linalg
from engine3d.apps.editor.drags import dragged_pose

START = linalg.compose((1, 2, 3), linalg.quaternion_from_axis_angle((1, 2, 0.5), 0.7), (1, 2, 0.5))


def single(pose):
    """What a gizmo makes of a pose: nearly it."""
    return pose.astype(np.float32).astype(np.float64)


def rotated(axis, degrees):
    turn = linalg.rotation_axis(axis, math.radians(degrees))
    pose = linalg.multiply(turn, START)
    pose[:3, 3] = START[:3, 3]
    return pose


@pytest.mark.parametrize("axis", [(0, 0, 1), (0, -1, 0), START[:3, 0]])
def test_turns_are_whole_steps_about_the_axis(axis):
    made = single(rotated(axis, 59.98))
    expected = rotated(axis, 60)
    np.testing.assert_allclose(dragged_pose("rotate", START, made, 15), expected, atol=1e-12)
    free = dragged_pose("rotate", START, made)
    np.testing.assert_allclose(free, rotated(axis, 59.98), atol=1e-5)
    np.testing.assert_allclose(linalg.length(free[:3, :3].T), (1, 2, 0.5), atol=1e-12)
    assert free[:3, 3].tolist() == [1, 2, 3]


def test_a_turn_of_nothing_is_the_pose():
    assert dragged_pose("rotate", START, START.copy(), 15).tobytes() == START.tobytes()


def test_moves_are_whole_steps_along_the_axes():
    made = START.copy()
    made[:3, 3] += (0.26, -0.99, 0.1)
    assert dragged_pose("move", START, made, 0.25)[:3, 3].tolist() == [1.25, 1, 3]
    assert np.array_equal(dragged_pose("move", START, made)[:3, 3], made[:3, 3])
    axis = linalg.normalize(np.ascontiguousarray(START[:3, 1]))
    made[:3, 3] = START[:3, 3] + 1.1 * axis
    moved = dragged_pose("move", START, single(made), 0.5, is_local=True)
    np.testing.assert_allclose(moved[:3, 3], START[:3, 3] + axis, atol=1e-12)


def test_scales_are_whole_steps_and_leave_other_axes_as_they_are():
    made = START.copy()
    made[:3, 1] *= 1.26
    scaled = dragged_pose("scale", START, single(made), 10)
    assert scaled[:, [0, 2, 3]].tobytes() == START[:, [0, 2, 3]].tobytes()
    np.testing.assert_allclose(scaled[:3, 1], START[:3, 1] * 1.3, rtol=1e-12)
    made[:3, 1] = START[:3, 1] * 0.001
    np.testing.assert_allclose(
        dragged_pose("scale", START, made, 10)[:3, 1], START[:3, 1] * 0.1, rtol=1e-12
    )
