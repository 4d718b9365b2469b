"""The orbit and the walking controller."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.stage.views.fps import FAST, MAX_PITCH, RADIANS_A_SECOND, FpsController
from engine3d.stage.views.orbit import DOLLY_STEP, OrbitController
from engine3d.stage.views.viewpoint import QUARTER_TURN, Sphere, Viewpoint
from engine3d.stage.views.walkable_ground import Ground
from engine3d.stage.views.walking import GroundController

BOUNDS = Sphere((0.0, 0.0, 0.0), 1.0)


@pytest.fixture
def view():
    return Viewpoint(np.zeros(3), 4.0, azimuth=0.0, elevation=0.0)


def test_a_drag_to_the_right_turns_the_model_to_the_right(view):
    OrbitController(view).rotate(100, 0, 400)
    assert view.azimuth == pytest.approx(-QUARTER_TURN)


def test_a_drag_down_shows_the_top_and_stops_there(view):
    orbit = OrbitController(view)
    orbit.rotate(0, 50, 400)
    assert view.elevation == pytest.approx(math.pi / 4)
    orbit.rotate(0, 1000, 400)
    assert view.elevation == QUARTER_TURN
    orbit.rotate(0, -5000, 400)
    assert view.elevation == -QUARTER_TURN


def test_azimuth_stays_within_half_a_turn(view):
    orbit = OrbitController(view)
    for _ in range(100):
        orbit.rotate(333, 0, 400)
        assert abs(view.azimuth) <= math.pi


def test_the_wheel_approaches_and_a_middle_drag_down_recedes(view):
    orbit = OrbitController(view)
    orbit.dolly(2)
    assert view.distance == pytest.approx(4.0 * DOLLY_STEP**2)
    orbit.dolly_drag(40)
    assert view.distance == pytest.approx(4.0)


def test_dolly_never_reaches_the_target_nor_infinity(view):
    orbit = OrbitController(view)
    orbit.dolly(100_000)
    assert view.distance > 0.0
    orbit.dolly(-100_000)
    assert math.isfinite(view.distance)


def test_pan_keeps_the_target_plane_under_the_pointer(view):
    width, height, drag = 640, 480, (37, -21)

    def pixel(point):
        camera = view.camera(BOUNDS)
        clip = camera.projection((width, height)) @ np.linalg.inv(view.pose()) @ [*point, 1.0]
        return (clip[0] / clip[3] + 1) * width / 2, (1 - clip[1] / clip[3]) * height / 2

    view.azimuth, view.elevation = 0.7, 0.4
    point = view.target.copy()
    before = pixel(point)
    OrbitController(view).pan(*drag, height)
    after = pixel(point)
    assert (after[0] - before[0], after[1] - before[1]) == pytest.approx(drag, abs=1e-9)


def test_entering_and_leaving_walking_keeps_the_camera(view):
    view.azimuth, view.elevation = 0.6, -0.3
    before = view.pose()
    walker = FpsController(view, BOUNDS)
    walker.leave(view)
    np.testing.assert_allclose(view.pose(), before, atol=1e-12)
    assert view.distance > 0.0


def test_leaving_aims_abreast_of_the_scene(view):
    walker = FpsController(view, BOUNDS)
    walker.leave(view)
    assert view.distance == pytest.approx(4.0)
    np.testing.assert_allclose(view.target, (0, 0, 0), atol=1e-12)


@pytest.mark.parametrize(
    ("key", "direction"),
    [
        ("W", (0, 0, -1)),
        ("S", (0, 0, 1)),
        ("A", (-1, 0, 0)),
        ("D", (1, 0, 0)),
        ("E", (0, 1, 0)),
        ("Q", (0, -1, 0)),
    ],
)
def test_keys_walk_along_the_gaze(view, key, direction):
    walker = FpsController(view, BOUNDS)
    start = walker.position
    assert walker.walk({key}, 0.5)
    expected = np.array(direction) * walker.speed * 0.5
    np.testing.assert_allclose(walker.position - start, expected, atol=1e-12)


def test_diagonal_walking_is_no_faster_and_shift_is(view):
    walker = FpsController(view, BOUNDS)
    start = walker.position
    walker.walk({"W", "D"}, 1.0)
    assert np.linalg.norm(walker.position - start) == pytest.approx(walker.speed)
    start = walker.position
    walker.walk({"W"}, 1.0, fast=True)
    assert np.linalg.norm(walker.position - start) == pytest.approx(walker.speed * FAST)


def test_opposite_keys_and_other_keys_stand_still(view):
    walker = FpsController(view, BOUNDS)
    assert not walker.walk({"W", "S"}, 1.0)
    assert not walker.walk({"G"}, 1.0)
    assert not walker.walk(set(), 1.0)


def test_looking_turns_right_and_up_and_stops_short_of_the_zenith(view):
    walker = FpsController(view, BOUNDS)
    walker.look(100, -50)
    assert walker.yaw < 0.0
    assert walker.pitch > 0.0
    walker.place(view)
    ahead = -view.rotation()[:, 2]
    assert ahead[0] > 0.0
    assert ahead[1] > 0.0
    walker.look(0, -100_000)
    assert walker.pitch == MAX_PITCH


def test_arrows_look(view):
    walker = FpsController(view, BOUNDS)
    start, yaw, pitch = walker.position, walker.yaw, walker.pitch
    assert walker.walk({"Right", "Up"}, 0.1)
    assert (yaw - walker.yaw) == pytest.approx(0.1 * RADIANS_A_SECOND)
    assert (walker.pitch - pitch) == pytest.approx(0.1 * RADIANS_A_SECOND)
    assert not walker.walk({"Right", "Left"}, 0.1)
    np.testing.assert_array_equal(walker.position, start)


def ground_walker(view, gaze=(0.0, 0.0)):
    """Somebody at the origin of a floor with a step of 0.3 and a wall of 2, one after the other."""
    floor = e3d.plane((20, 20))
    step, wall = e3d.box((20, 0.6, 3)), e3d.box((20, 4, 0.2))
    step.positions = step.positions + np.float32([0, 0, -4.5])
    wall.positions = wall.positions + np.float32([0, 0, -8])
    walker = e3d.navigation.Walker(e3d.navigation.NavigationGrid([floor, step, wall]), 0.1, 0.1)
    return GroundController(view, BOUNDS, Ground(np.eye(3), 1.0, walker), gaze)


def test_on_the_ground_one_walks_level_whatever_the_gaze(view):
    walker = ground_walker(view, (0.0, 1.0))
    walker.walk({"W", "E"}, 0.2)
    np.testing.assert_allclose(walker.position, (0.1, 1.7, 0.1 - 0.2 * walker.speed), atol=1e-12)
    walker.walk({"D"}, 0.2)
    assert walker.position[0] == pytest.approx(0.1 + 0.2 * walker.speed)
    turned = ground_walker(view, (math.pi / 2, 0.0))
    turned.walk({"W"}, 0.2)
    assert turned.position[0] == pytest.approx(0.1 - 0.2 * turned.speed)
    walker.place(view)
    np.testing.assert_allclose(view.position(), walker.position, atol=1e-9)


def test_on_the_ground_steps_are_climbed_smoothly_and_walls_stop(view):
    walker = ground_walker(view)
    heights = []
    for _ in range(100):
        walker.walk({"W"}, 0.02)
        heights.append(walker.position[1])
    assert max(heights) == pytest.approx(2.0, abs=0.01)
    assert max(np.diff(heights)) < 0.1 and min(heights) == pytest.approx(1.7)
    for _ in range(100):
        walker.walk({"W"}, 0.02)
    assert walker.position[2] > -7.9
    for _ in range(20):
        walker.walk(set(), 0.05)
    assert not walker.walk(set(), 0.05)
    assert walker.position[1] == pytest.approx(1.7, abs=2e-3)


def test_walking_follows_the_up_direction(view):
    view.up = (0.0, 0.0, 1.0)
    walker = FpsController(view, BOUNDS)
    start = walker.position
    walker.walk({"E"}, 1.0)
    np.testing.assert_allclose(walker.position - start, (0, 0, walker.speed), atol=1e-12)


def test_the_wheel_changes_the_speed(view):
    walker = FpsController(view, BOUNDS)
    before = walker.speed
    walker.change_speed(1)
    assert walker.speed > before
    walker.change_speed(-1)
    assert walker.speed == pytest.approx(before)
