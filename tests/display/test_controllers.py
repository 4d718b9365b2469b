"""The orbit and the walking controller."""

import math

import numpy as np
import pytest

from engine3d.display.fps import FAST, MAX_PITCH, FpsController
from engine3d.display.orbit import DOLLY_STEP, OrbitController
from engine3d.display.viewpoint import QUARTER_TURN, Sphere, Viewpoint

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
        clip = camera.projection(width, height) @ np.linalg.inv(view.pose()) @ [*point, 1.0]
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
        ("Down", (0, 0, 1)),
        ("A", (-1, 0, 0)),
        ("Right", (1, 0, 0)),
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
