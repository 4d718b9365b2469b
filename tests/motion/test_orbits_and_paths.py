"""Orbits and paths: where they lead at which time, in what order, and what they refuse."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.motion.orbits import Orbit, in_order
from engine3d.model.motion.paths import facing
from engine3d.model.motion.periods import LONGEST, common_period
from engine3d.model.scene.animation import motions_of
from engine3d.stage.open_model import open_model


@pytest.fixture
def scene():
    return e3d.Scene()


@pytest.fixture
def animator(scene):
    scene.animator = e3d.Animator(scene)
    return scene.animator


def at(node):
    return node.world_pose[:3, 3].round(9).tolist()


def test_a_node_circles_the_origin_of_its_parent(scene, animator):
    parent = scene.add(translation=(10, 0, 0), scale=2)
    node = scene.add(parent=parent)
    animator.orbit(node, radius=3, period=4)
    places = []
    for time in (0, 1, 2, 3, 4):
        animator.seek(time)
        places.append(at(node))
    assert places == [[16, 0, 0], [10, 0, -6], [4, 0, 0], [10, 0, 6], [16, 0, 0]]


def test_the_axis_the_phase_and_the_sign_of_the_period_count(scene, animator):
    node = scene.add(rotation=(0, 1, 0, 0))
    animator.orbit(node, radius=1, period=-4, axis=(0, 0, 2), phase=0.25)
    animator.seek(0)
    first = np.array(at(node))
    animator.seek(1)
    second = np.array(at(node))
    assert first[2] == second[2] == 0 and np.linalg.norm(first) == np.linalg.norm(second) == 1
    assert np.cross(first, second).tolist() == [0, 0, -1]  # clockwise about +Z
    assert node.rotation.tolist() == [0, 1, 0, 0]


def test_a_moon_follows_its_planet_in_whatever_order_they_were_added(scene, animator):
    sun, earth, moon = (scene.add(name=name) for name in ("sun", "earth", "moon"))
    animator.orbit(moon, earth, radius=1, period=2)
    animator.orbit(earth, sun, radius=10, period=8)
    sun.translation = (5, 0, 0)
    for time in (0.0, 1.3, 2.0, 2.0, 7.7):
        animator.seek(time)
        turn, quick = 2 * math.pi * time / 8, 2 * math.pi * time / 2
        there = np.array([5 + 10 * math.cos(turn), 0, -10 * math.sin(turn)])
        assert np.allclose(earth.translation, there)
        there += (math.cos(quick), 0, -math.sin(quick))
        assert np.allclose(moon.translation, there)
    orbits = in_order(motions_of(animator).orbits)
    assert [orbit.node for orbit in orbits] == [earth, moon]


def test_a_moon_below_a_turning_planet_keeps_its_circle(scene, animator):
    earth = scene.add(translation=(1, 2, 3), rotation=(0.1, 0.2, 0.3, 0.9))
    moon = scene.add(parent=earth)
    animator.spin(earth, period=1)
    animator.orbit(moon, earth, radius=2, period=4)
    animator.seek(1)
    assert at(moon) == [1, 2, 1]


def test_the_place_depends_on_the_time_only(scene, animator):
    sun, earth = scene.add(), scene.add()
    animator.orbit(earth, sun, radius=2, period=3)
    animator.follow(sun, [(0, 0, 0), (5, 1, 2), (0, 3, 0)], period=7)
    animator.seek(1.25)
    poses = [node.pose.tobytes() for node in (sun, earth)]
    for time in (9.0, -3.0, 0.0):
        animator.seek(time)
    animator.seek(1.25)
    assert [node.pose.tobytes() for node in (sun, earth)] == poses


def test_a_node_cannot_circle_what_moves_with_it(scene, animator):
    a, b = scene.add(name="a"), scene.add(name="b")
    below = scene.add(parent=a)
    for about in (a, below):
        with pytest.raises(e3d.InvalidArgumentError, match="'a' cannot circle"):
            animator.orbit(a, about, radius=1, period=1)
    animator.orbit(a, b, radius=1, period=1)
    with pytest.raises(e3d.InvalidArgumentError, match="'b' cannot circle"):
        animator.orbit(b, below, radius=1, period=1)
    assert len(motions_of(animator).orbits) == 1
    with pytest.raises(e3d.InvalidArgumentError, match="about must be a node of this scene"):
        animator.orbit(b, e3d.Scene().add(), radius=1, period=1)


def test_long_chains_are_no_problem(scene):
    chain = [scene.add() for _ in range(1500)]
    pairs = zip(chain, chain[1:], strict=False)
    made = [Orbit(node, about, 1.0, (0, 1, 0), 2.0, 0.0) for node, about in pairs]
    assert [orbit.node for orbit in in_order(made)] == chain[-2::-1]


def test_a_center_that_is_gone_leaves_its_followers(scene, animator):
    sun, earth = scene.add(), scene.add()
    animator.orbit(earth, sun, radius=2, period=4)
    animator.seek(1)
    place = at(earth)
    scene.remove(sun)
    animator.seek(2)
    assert at(earth) == place
    scene.restore(sun)
    animator.seek(2)
    assert at(earth) == [-2, 0, 0]


SQUARE = [(0, 0, 0), (4, 0, 0), (4, 0, 4), (0, 0, 4)]


@pytest.mark.parametrize(
    "end, places",
    [
        ("close", {0: (0, 0, 0), 1: (4, 0, 0), 3.5: (0, 0, 2), 4: (0, 0, 0), 5: (4, 0, 0)}),
        ("restart", {0: (0, 0, 0), 2: (4, 0, 2), 4: (0, 0, 0), -2: (4, 0, 2)}),
        ("return", {0: (0, 0, 0), 1: (4, 0, 2), 2: (0, 0, 4), 3: (4, 0, 2), 4: (0, 0, 0)}),
        ("stop", {-1: (0, 0, 0), 2: (4, 0, 2), 4: (0, 0, 4), 99: (0, 0, 4)}),
    ],
)
def test_a_path_with_corners_goes_from_point_to_point(scene, animator, end, places):
    node = scene.add()
    animator.follow(node, SQUARE, period=4, end=end, smooth=False)
    for time, place in places.items():
        animator.seek(time)
        assert at(node) == list(place), time


def test_a_round_path_meets_its_points_and_has_no_corners(scene, animator):
    node = scene.add()
    animator.follow(node, SQUARE, period=4)
    for number, point in enumerate(SQUARE):
        animator.seek(number)
        assert at(node) == list(point)
    times = np.linspace(0, 4, 401)
    places = []
    for time in times:
        animator.seek(time)
        places.append(node.translation.copy())
    steps = np.diff(places, axis=0)
    cosines = (steps[1:] * steps[:-1]).sum(1)
    cosines /= np.linalg.norm(steps[1:], axis=1) * np.linalg.norm(steps[:-1], axis=1)
    assert cosines.min() > 0.99
    assert np.abs(places).max() > 4.1  # it bulges


def test_points_that_repeat_take_no_time(scene, animator):
    node = scene.add()
    animator.follow(node, [SQUARE[0], SQUARE[0], SQUARE[1], SQUARE[1]], period=2, smooth=False)
    animator.seek(0.5)
    assert at(node) == [2, 0, 0]


@pytest.mark.parametrize("forward", ["+X", "-X", "+Z", "-Z"])
def test_the_chosen_axis_faces_ahead(scene, animator, forward):
    node = scene.add()
    animator.follow(node, SQUARE, period=8, smooth=False, forward=forward, end="return")
    axis = "XYZ".index(forward[1])
    sign = -1.0 if forward[0] == "-" else 1.0
    for time, ahead in ((0.1, (1, 0, 0)), (2, (0, 0, 1)), (6, (0, 0, -1)), (7.9, (-1, 0, 0))):
        animator.seek(time)
        assert np.allclose(sign * node.world_pose[:3, axis], ahead), time
        assert np.allclose(node.world_pose[:3, 1], (0, 1, 0))


def test_nothing_faces_straight_up():
    assert facing(np.array([0.0, 2.0, 0.0]), "+Z") is None
    assert facing(np.zeros(3), "+Z") is None


@pytest.mark.parametrize(
    "values, message",
    [
        ({"points": [(0, 0, 0)]}, "at least 2"),
        ({"points": [(0, 0), (1, 1)]}, "shape"),
        ({"points": [(1, 1, 1), (1, 1, 1)]}, "same"),
        ({"points": [(0, 0, 0), (0, 0, math.inf)]}, "finite"),
        ({"points": [(0, 0, 0), (1, 0, 0), (1, 1e-300, 0)]}, "too near"),
        ({"period": 0}, "period"),
        ({"end": "turn"}, "close"),
        ({"forward": "+Y"}, "forward"),
    ],
)
def test_what_is_no_path(scene, animator, values, message):
    given = {"points": SQUARE, "period": 1.0, **values}
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        animator.follow(scene.add(), **given)


@pytest.mark.parametrize(
    "values, message",
    [({"radius": -1}, "radius"), ({"period": 0}, "period"), ({"axis": (0, 0, 0)}, "axis")],
)
def test_what_is_no_orbit(scene, animator, values, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        animator.orbit(scene.add(), **{"radius": 1.0, "period": 1.0, **values})


def solar(folder):
    scene = e3d.Scene()
    sun, earth, moon = (scene.add(e3d.uv_sphere(), name=name) for name in ("Sun", "Earth", "Moon"))
    scene.animator = animator = e3d.Animator(scene)
    animator.spin(sun, period=9)
    animator.orbit(earth, sun, radius=5, period=12, phase=0.1, axis=(0, 1, 0.1))
    animator.orbit(moon, earth, radius=1, period=-3)
    ship = scene.add(e3d.box(), name="ship")
    animator.follow(ship, SQUARE, period=6, end="return", forward="+Z", smooth=False, phase=0.3)
    animator.orbit(scene.add(name="alone"), radius=2, period=4)
    return scene


def test_files_hold_orbits_and_paths_to_the_bit(tmp_path):
    scene, path = solar(tmp_path), tmp_path / "solar.e3d.json"
    e3d.save_scene(scene, path)
    loaded = e3d.load_scene(path)
    for time in (0.0, 1.7, 30.25):
        scene.animator.seek(time)
        loaded.animator.seek(time)
        assert [node.pose.tobytes() for node in scene.nodes] == [
            node.pose.tobytes() for node in loaded.nodes
        ]
    again = tmp_path / "again.e3d.json"
    scene.animator.seek(2)
    loaded.animator.seek(2)
    e3d.save_scene(scene, path)
    e3d.save_scene(loaded, again)
    assert path.read_bytes() == again.read_bytes()


def test_programs_repeat_a_file_when_all_its_motions_do(tmp_path):
    path = tmp_path / "solar.e3d.json"
    e3d.save_scene(solar(tmp_path), path)
    viewed = open_model(path)
    assert viewed.period == 36.0 and viewed.update == viewed.scene.animator.seek
    e3d.save_scene(scene_at_rest(), path)
    assert open_model(path).update is None


def scene_at_rest():
    scene = e3d.Scene()
    scene.add(e3d.box())
    return scene


def test_a_copied_scene_moves_by_itself(tmp_path):
    scene = solar(tmp_path)
    copied = scene.copy()
    copied.animator.seek(2)
    assert at(scene.nodes[1]) == [0, 0, 0] != at(copied.nodes[1])
    scene.animator.seek(2)
    assert [at(node) for node in scene.nodes] == [at(node) for node in copied.nodes]


@pytest.mark.parametrize(
    "old, new, message",
    [
        ('"about":0', '"about":9', r"nodes\[1\].orbits\[0\].about: 9 is not the number"),
        ('"about":0', '"about":2', r"cannot circle what moves with it"),
        ('"radius":5.0', '"radius":-5', r"nodes\[1\].orbits\[0\]: radius"),
        ('"end":"return"', '"end":"u-turn"', r"nodes\[3\].paths\[0\]: end"),
        ('"end":"return"', '"way":"return"', r"paths\[0\].way: is no property of a motion"),
    ],
)
def test_what_is_wrong_in_a_file_is_named(tmp_path, old, new, message):
    path = tmp_path / "solar.e3d.json"
    e3d.save_scene(solar(tmp_path), path)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    with pytest.raises(e3d.FileFormatError, match=message):
        e3d.load_scene(path)


def test_an_orbit_about_what_is_gone_is_told_when_saved(tmp_path):
    scene, path = solar(tmp_path), tmp_path / "solar.e3d.json"
    scene.remove(scene.nodes[0])
    with pytest.warns(e3d.Engine3DWarning, match="'Earth': what it circles is gone"):
        e3d.save_scene(scene, path)
    assert len(motions_of(e3d.load_scene(path).animator).orbits) == 2


def test_all_motions_repeat_after_their_common_period(scene, animator):
    assert common_period(motions_of(animator)) is None
    animator.spin(scene.add(), period=-4)
    assert common_period(motions_of(animator)) == 4
    animator.orbit(scene.add(), radius=1, period=2 / 3)
    animator.follow(scene.add(), SQUARE, period=6)
    assert common_period(motions_of(animator)) == 12
    animator.track(scene.add(), [0, 2.5], scales=[(1, 1, 1)] * 2)
    assert common_period(motions_of(animator)) == 60
    animator.spin(scene.add(), period=math.pi)
    assert common_period(motions_of(animator)) == 10 * 6 <= LONGEST
    animator.spin(scene.add(), period=100)
    assert common_period(motions_of(animator)) == 100
