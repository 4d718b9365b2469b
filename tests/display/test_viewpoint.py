"""The view round a target: axes, poses, framing, clip planes."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.display.viewpoint import (
    UP_DIRECTIONS,
    Sphere,
    Viewpoint,
    bounding_sphere,
    clip_planes,
    home_axes,
    turning_outline,
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


def project(view, points, width, height):
    """Return the points' normalised device coordinates as the view sees them."""
    camera = view.camera(Sphere(tuple(points.mean(axis=0)), 100.0))
    clip_from_world = camera.projection(width, height) @ np.linalg.inv(view.pose())
    clip = np.c_[points, np.ones(len(points))] @ clip_from_world.T
    return clip[:, :3] / clip[:, 3:]


@pytest.mark.parametrize("up", UP_DIRECTIONS.values())
def test_a_framed_outline_holds_the_scene_however_it_turns(up):
    scene = e3d.Scene()
    scene.add(e3d.box((3.0, 1.0, 0.4)), translation=(1.0, 2.0, 3.0))
    scene.add(e3d.icosphere(0.6, 2), translation=(1.0, 3.0, 3.5))
    points = np.concatenate(
        [node.object.positions + node.translation for node in scene.nodes], dtype=np.float64
    )
    view = Viewpoint(np.zeros(3), 1.0, up=up)
    view.frame(turning_outline(scene, up), 1.5)
    reached = []
    for azimuth in np.linspace(0.0, 6.0, 13):
        view.azimuth = azimuth
        reached.append(np.abs(project(view, points, 300, 200)[:, :2]).max())
    assert max(reached) < 1.0
    assert max(reached) > 0.75


def test_the_outline_of_an_empty_scene_can_be_framed():
    view = Viewpoint(np.zeros(3), 1.0)
    view.frame(turning_outline(e3d.Scene(), (0, 1, 0)), 1.0)
    assert 1.0 < view.distance < 10.0


def test_clip_planes_enclose_the_sphere_and_stay_positive_inside_it():
    sphere = Sphere((0.0, 0.0, 0.0), 1.0)
    near, far = clip_planes((0, 0, 10), sphere)
    assert 0.3 < near <= 9.0
    assert 11.0 <= far < 11.5
    near, far = clip_planes((0, 0, 0.5), sphere)
    assert 0.0 < near < 0.01
    assert far >= 1.5


def test_bounding_sphere_reaches_the_farthest_vertex():
    scene = e3d.Scene()
    scene.add(e3d.icosphere(2.0, 3), translation=(5, 0, 0), scale=0.5)
    sphere = bounding_sphere(scene)
    np.testing.assert_allclose(sphere.center, (5, 0, 0), atol=1e-6)
    assert sphere.radius == pytest.approx(1.0, abs=1e-6)


def test_bounding_sphere_of_instances_holds_their_boxes():
    scene = e3d.Scene()
    poses = np.stack([np.eye(4), np.eye(4)])
    poses[1, 0, 3] = 4.0
    scene.add(e3d.InstancedMesh(e3d.box(), poses))
    sphere = bounding_sphere(scene)
    np.testing.assert_allclose(sphere.center, (2, 0, 0), atol=1e-6)
    assert sphere.radius == pytest.approx(math.sqrt(2.5**2 + 0.5), abs=1e-6)


def test_bounding_sphere_leaves_out_hidden_nodes_and_wild_vertices():
    scene = e3d.Scene()
    scene.add(e3d.box(), translation=(100, 0, 0)).visible = False
    positions = np.array([[-1, 0, 0], [1, 0, 0], [0, np.nan, 0]], dtype=np.float32)
    scene.add(e3d.Mesh(positions, [[0, 1, 2]]))
    assert bounding_sphere(scene).radius == 1.0


def test_an_empty_scene_has_a_sphere_of_radius_one():
    assert bounding_sphere(e3d.Scene()) == Sphere((0.0, 0.0, 0.0), 1.0)


def test_bounding_sphere_survives_an_extent_without_size():
    scene = e3d.Scene()
    scene.add(e3d.Mesh([[1, 2, 3]], points=[0]))
    assert bounding_sphere(scene) == Sphere((1.0, 2.0, 3.0), 1.0)
