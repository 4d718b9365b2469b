"""The view round a target: axes, poses, framing, clip planes."""

import math

import numpy as np
import pytest
from stage.projection import project

import engine3d as e3d
from engine3d.rendering.support_functions import support_of_points
from engine3d.stage.views.viewpoint import (
    UP_DIRECTIONS,
    Sphere,
    Viewpoint,
    clip_planes,
    home_axes,
)


@pytest.mark.parametrize("up", UP_DIRECTIONS.values())
def test_home_axes_are_orthonormal_and_right_handed(up):
    right, upward, back = home_axes(up)
    np.testing.assert_array_equal(upward, up)
    np.testing.assert_allclose(np.cross(right, upward), back, atol=1e-15)
    np.testing.assert_allclose([right @ right, right @ upward], [1, 0], atol=1e-15)


def test_home_axes_of_z_up_look_along_plus_y():
    np.testing.assert_array_equal(home_axes((0, 0, 1)), [[1, 0, 0], [0, 0, 1], [0, -1, 0]])


def test_a_zero_up_direction_is_refused():
    with pytest.raises(e3d.InvalidArgumentError):
        home_axes((0, 0, 0))


def test_front_view_looks_down_minus_z_exactly():
    view = Viewpoint(np.array([1.0, 2.0, 3.0]), 5.0, azimuth=0.0, elevation=0.0)
    expected = np.eye(4)
    expected[:3, 3] = (1, 2, 8)
    np.testing.assert_array_equal(view.pose(), expected)


def test_right_and_top_views_are_exact():
    right = Viewpoint(np.zeros(3), 2.0, azimuth=math.pi / 2, elevation=0.0)
    np.testing.assert_array_equal(right.position(), [2, 0, 0])
    top = Viewpoint(np.zeros(3), 2.0, azimuth=0.0, elevation=math.pi / 2)
    np.testing.assert_array_equal(top.position(), [0, 2, 0])
    np.testing.assert_array_equal(top.rotation()[:, 1], [0, 0, -1])


@pytest.mark.parametrize("up", UP_DIRECTIONS.values())
@pytest.mark.parametrize(("azimuth", "elevation"), [(0.3, 0.2), (-2.0, -1.1), (3.0, 1.5)])
def test_pose_is_a_rotation_that_looks_at_the_target(up, azimuth, elevation):
    view = Viewpoint(np.array([0.5, -1.0, 2.0]), 3.0, azimuth, elevation, up)
    pose = view.pose()
    rotation = pose[:3, :3]
    np.testing.assert_allclose(rotation.T @ rotation, np.eye(3), atol=1e-12)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    np.testing.assert_allclose(pose[:3, 3] - 3.0 * rotation[:, 2], view.target, atol=1e-12)
    assert rotation[:, 1] @ np.array(up) >= 0.0
    np.testing.assert_allclose(pose, e3d.look_at(pose[:3, 3], view.target, up), atol=1e-9)


def test_look_from_is_the_inverse_of_position():
    view = Viewpoint(np.zeros(3), 1.0, up=(0, 0, 1))
    view.look_from((3.0, -4.0, 2.0), (1.0, 1.0, 1.0))
    np.testing.assert_allclose(view.position(), (3, -4, 2), atol=1e-12)
    np.testing.assert_allclose(view.target, (1, 1, 1), atol=1e-12)


def test_look_from_the_focal_point_itself_is_refused():
    with pytest.raises(e3d.InvalidArgumentError):
        Viewpoint(np.zeros(3), 1.0).look_from((1, 2, 3), (1, 2, 3))


@pytest.mark.parametrize("aspect", [0.4, 1.0, 1.8])
@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("elevation", [0.0, 0.6, -1.2])
def test_framing_shows_all_points_and_wastes_no_room(aspect, orthographic, elevation):
    points = np.random.default_rng(1).normal(size=(500, 3)) * (1.0, 2.0, 0.5) + (3.0, -2.0, 1.0)
    view = Viewpoint(np.zeros(3), 1.0, elevation=elevation, orthographic=orthographic)
    view.frame(points, aspect)
    ndc = project(view, points, round(500 * aspect), 500)
    assert np.abs(ndc[:, :2]).max() < 1.0
    assert np.abs(ndc[:, :2]).max() > 0.7


@pytest.mark.parametrize("aspect", [0.4, 1.8])
@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("elevation", [0.6, -1.2, math.pi / 2])
def test_fitting_fills_the_picture_in_its_middle(aspect, orthographic, elevation):
    points = np.random.default_rng(1).normal(size=(500, 3)) * (1.0, 2.0, 0.5) + (3.0, -2.0, 1.0)
    view = Viewpoint(np.zeros(3), 1.0, elevation=elevation, orthographic=orthographic)
    view.fit(support_of_points(points), np.array((3.0, -2.0, 1.0)), aspect)
    ndc = project(view, points, round(500 * aspect), 500)[:, :2]
    assert 0.9 < np.abs(ndc).max() < 1.0
    np.testing.assert_allclose(ndc.min(axis=0), -ndc.max(axis=0), atol=0.03)


def test_framing_keeps_the_middle_of_what_is_wide_in_the_middle():
    points = np.array([[x, y, z] for x in (-9, 9) for y in (-1, 1) for z in (-1, 1)], np.float64)
    view = Viewpoint(np.zeros(3), 1.0, azimuth=0.0, elevation=0.0)
    view.frame(points, 1.0)
    np.testing.assert_allclose(view.target, (0, 0, 0), atol=1e-12)


def test_clip_planes_enclose_the_sphere_and_stay_positive_inside_it():
    sphere = Sphere((0.0, 0.0, 0.0), 1.0)
    near, far = clip_planes((0, 0, 10), sphere)
    assert 8.5 < near <= 9.0
    assert 11.0 <= far < 11.5
    near, far = clip_planes((0, 0, 0.5), sphere)
    assert 0.0 < near < 0.01
    assert far >= 1.5
