"""Instances: what poses and colours may be, and their bounds."""

import numpy as np
import pytest

import engine3d as e3d


@pytest.fixture
def box():
    return e3d.box()


def test_poses_are_rounded_once_and_read_only(box):
    poses = np.zeros((3, 4))
    poses[:, 3] = 1 / 3
    instances = e3d.InstancedMesh(box, poses)
    assert instances.poses.dtype == np.float32
    assert instances.poses[0, 3] == np.float32(1 / 3)
    with pytest.raises(ValueError, match="read-only"):
        instances.poses[0, 0] = 1
    poses[:] = 7
    assert instances.poses[0, 0] == 0


def test_colors_are_widened(box):
    poses = np.zeros((2, 4))
    floats = e3d.InstancedMesh(box, poses, colors=e3d.linear(np.full((2, 3), 0.5)))
    assert floats.colors.tolist() == [[0.5, 0.5, 0.5, 1.0]] * 2
    bytes_ = e3d.InstancedMesh(box, poses, colors=np.full((2, 3), 7, np.uint8))
    assert bytes_.colors.tolist() == [[7, 7, 7, 255]] * 2


def test_number_changes_by_replace(box):
    instances = e3d.InstancedMesh(box, np.zeros((2, 4)), colors=np.zeros((2, 3)))
    with pytest.raises(e3d.InvalidArgumentError, match="replace"):
        instances.poses = np.zeros((5, 4))
    before = instances.version
    instances.replace(np.zeros((5, 4)))
    assert len(instances) == 5
    assert instances.colors is None
    assert instances.version > before


def test_no_instances(box):
    for none in (np.zeros((0, 4)), np.zeros((0, 4, 4)), []):
        assert e3d.InstancedMesh(box, none).bounds_in_node() is None


def test_bounds(box):
    offsets = e3d.InstancedMesh(box, [[10, 0, 0, 1], [0, 0, 0, -4]])
    np.testing.assert_array_equal(offsets.bounds_in_node(), [[-2, -2, -2], [10.5, 2, 2]])
    matrices = e3d.InstancedMesh(box, [np.diag([2, 4, 6, 1])])
    np.testing.assert_array_equal(matrices.bounds_in_node(), [[-1, -2, -3], [1, 2, 3]])


def test_bounds_leave_out_what_is_not_finite(box):
    instances = e3d.InstancedMesh(box, [[np.nan, 0, 0, 1], [0, 0, 0, 1]])
    np.testing.assert_array_equal(instances.bounds_in_node(), box.bounds)


@pytest.mark.parametrize(
    ("poses", "colors", "message"),
    [
        (np.zeros((3, 3)), None, "poses"),
        (np.zeros(4), None, "poses"),
        ("nonsense", None, "poses must be numbers"),
        (np.ones((1, 4, 4)), None, "affine"),
        (np.zeros((2, 4)), np.zeros((3, 3)), "colors"),
        (np.zeros((2, 4)), np.full((2, 3), 256), "0..255, but one is 256"),
    ],
)
def test_invalid_arguments(box, poses, colors, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.InstancedMesh(box, poses, colors=colors)


def test_mesh_is_required():
    with pytest.raises(e3d.InvalidArgumentError, match="mesh must be a Mesh"):
        e3d.InstancedMesh("box", np.zeros((1, 4)))
