"""Clips and their player against the formulas of glTF, one channel at a time."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.linalg import quaternion_from_axis_angle

TIMES = (0.5, 1.0, 2.5)


def channel(node, path, values, interpolation="linear", times=TIMES):
    return e3d.motion.Channel(node, path, times, values, interpolation)


def player_of(*channels, scene, loop="once", **options):
    player = e3d.AnimationPlayer(scene, [e3d.motion.AnimationClip(channels, "a")])
    player.loop = loop
    player.play(**options)
    return player


@pytest.fixture
def moved():
    scene = e3d.Scene()
    return scene, scene.add(translation=(9, 9, 9))


def test_steps_stay_until_the_next_key(moved):
    scene, node = moved
    values = [(1, 0, 0), (2, 0, 0), (3, 0, 0)]
    player = player_of(channel(node, "translation", values, "step"), scene=scene)
    for time, x in ((0, 1), (0.5, 1), (0.99, 1), (1, 2), (2.4999, 2), (2.5, 3), (7, 3)):
        player.seek(time)
        assert node.translation[0] == x


def test_lines_are_straight(moved):
    scene, node = moved
    player = player_of(channel(node, "scale", [(1, 1, 1), (2, 4, 8), (0, 0, 0)]), scene=scene)
    for time, scale in ((0, (1, 1, 1)), (0.75, (1.5, 2.5, 4.5)), (1.75, (1, 2, 4)), (3, (0, 0, 0))):
        player.seek(time)
        assert np.allclose(node.scale, scale, atol=1e-15)


def test_rotations_turn_the_shorter_way_at_a_constant_rate(moved):
    scene, node = moved

    def turn(angle):
        return quaternion_from_axis_angle((0, 0, 1), angle)

    values = [turn(0.0), -turn(1.0), 3.0 * turn(-1.0)]
    player = player_of(channel(node, "rotation", values), scene=scene)
    for time, angle in ((0.6, 0.2), (0.9, 0.8), (1.75, 0.0), (2.125, -0.5)):
        player.seek(time)
        expected = turn(angle)
        sign = math.copysign(1.0, float(node.rotation @ expected))
        assert np.allclose(sign * node.rotation, expected, atol=1e-14)


def test_splines_are_those_of_the_specification(moved):
    scene, node = moved
    rng = np.random.default_rng(2)
    values = rng.normal(size=(3, 3, 3))
    player = player_of(channel(node, "translation", values, "cubicspline"), scene=scene)
    for time in (0.6, 0.9, 1.0, 1.9):
        k = 0 if time < 1 else 1
        span = TIMES[k + 1] - TIMES[k]
        t = (time - TIMES[k]) / span
        expected = (
            (2 * t**3 - 3 * t**2 + 1) * values[k, 1]
            + span * (t**3 - 2 * t**2 + t) * values[k, 2]
            + (-2 * t**3 + 3 * t**2) * values[k + 1, 1]
            + span * (t**3 - t**2) * values[k + 1, 0]
        )
        player.seek(time)
        assert np.allclose(node.translation, expected, atol=1e-14)


def test_splines_of_rotations_are_made_unit(moved):
    scene, node = moved
    values = np.zeros((3, 3, 4))
    values[:, 1, 3] = (1, 2, 1)
    values[:, 2, 0] = 0.7
    player = player_of(channel(node, "rotation", values, "cubicspline"), scene=scene)
    player.seek(0.8)
    assert node.rotation[0] > 0.01
    assert math.isclose(float(node.rotation @ node.rotation), 1.0, abs_tol=1e-14)


def test_weights_move_morph_targets():
    scene = e3d.Scene()
    target = e3d.motion.MorphTarget(np.tile(np.float32((0, 0, 1)), (3, 1)))
    node = scene.add(e3d.Mesh(np.eye(3), [[0, 1, 2]], morph_targets=[target, target]))
    values = [(0, 0), (1, 2), (1, 2)]
    player = player_of(channel(node, "weights", values), scene=scene)
    player.seek(0.75)
    assert node.morph_weights.tolist() == [0.5, 1.0]
    scene.data.update()
    assert np.allclose(node._drawn.now().positions, np.eye(3) + [0, 0, 1.5])


@pytest.mark.parametrize(
    ("loop", "cases"),
    (
        ("once", ((-1, 0), (1, 1), (5, 4))),
        ("repeat", ((-1, 3), (1, 1), (5, 1), (4, 0))),
        ("ping-pong", ((-1, 1), (1, 1), (4, 4), (5, 3), (9, 1))),
    ),
)
def test_loops(moved, loop, cases):
    scene, node = moved
    line = channel(node, "translation", [(0, 0, 0), (4, 0, 0)], times=(0, 4))
    player = player_of(line, scene=scene, loop=loop)
    for time, x in cases:
        player.seek(time)
        assert math.isclose(node.translation[0], x, abs_tol=1e-12)


def test_offsets_let_clips_play_ahead():
    scene = e3d.Scene()
    nodes = [scene.add() for _ in range(3)]
    clips = [
        e3d.motion.AnimationClip(
            [channel(node, "translation", [(0, 0, 0), (4, 0, 0)], times=(0, 4))]
        )
        for node in nodes
    ]
    player = e3d.AnimationPlayer(scene, clips)
    player.play(clips, offsets=(0, 1, 2))
    player.advance(1.5)
    assert [node.translation[0] for node in nodes] == [1.5, 2.5, 3.5]


def test_speed_pause_and_going_on(moved):
    scene, node = moved
    line = channel(node, "translation", [(0, 0, 0), (4, 0, 0)], times=(0, 4))
    player = player_of(line, scene=scene)
    player.speed = 2.0
    player.advance(1.0)
    player.pause()
    player.advance(1.0)
    assert (player.time, node.translation[0]) == (2.0, 2.0)
    player.play()
    player.speed = -1.0
    player.advance(0.5)
    assert (player.time, node.translation[0]) == (1.5, 1.5)


def two_clips():
    scene = e3d.Scene()
    node, other = scene.add(), scene.add(translation=(0, 7, 0))
    first = e3d.motion.AnimationClip(
        [
            channel(node, "translation", [(0, 0, 0), (4, 0, 0)], times=(0, 4)),
            channel(other, "translation", [(0, 1, 0), (0, 1, 0)], times=(0, 4)),
        ],
        "walk",
    )
    second = e3d.motion.AnimationClip(
        [channel(node, "translation", [(0, 0, 10), (0, 0, 10)], times=(0, 1))], "stand"
    )
    return scene, node, other, e3d.AnimationPlayer(scene, [first, second])


def test_fading_goes_from_what_played_on_to_what_plays():
    scene, node, other, player = two_clips()
    player.play("walk")
    player.seek(1.0)
    player.play("stand", fade=2.0)
    assert node.translation.tolist() == [1, 0, 0]
    player.advance(0.5)  # the first clip goes on
    assert np.allclose(node.translation, (1.5 * 0.75, 0, 2.5))
    assert np.allclose(other.translation, (0, 1 * 0.75 + 7 * 0.25, 0))
    player.seek(2.0)
    assert node.translation.tolist() == [0, 0, 10]
    assert other.translation.tolist() == [0, 7, 0]
    player.seek(0.5)  # by the time alone
    assert np.allclose(node.translation, (1.5 * 0.75, 0, 2.5))


def test_without_a_fade_what_played_is_put_back():
    scene, node, other, player = two_clips()
    player.play("walk")
    player.seek(1.0)
    player.play(1)
    assert other.translation.tolist() == [0, 7, 0] and node.translation.tolist() == [0, 0, 10]
    player.stop()
    assert node.translation.tolist() == [0, 0, 0] and player.playing == ()


def test_the_order_of_times_changes_nothing(moved):
    scene, node = moved
    rng = np.random.default_rng(8)
    times = np.sort(rng.random(50))
    values = rng.normal(size=(50, 4))
    player = player_of(channel(node, "rotation", values, times=times), scene=scene)
    when = rng.random(40) * 1.2 - 0.1
    seen = {}
    for time in (*when, *when[::-1]):
        player.seek(time)
        assert seen.setdefault(time, node.rotation.tobytes()) == node.rotation.tobytes()


@pytest.mark.parametrize(
    ("path", "times", "values", "message"),
    (
        ("turn", (0,), [(0, 0, 0)], "path must be one of"),
        ("translation", (0, 0), [(0, 0, 0)] * 2, "increase"),
        ("translation", (), [], "at least one"),
        ("translation", (0, 1), [(0, 0, 0)], r"must be \(2, 3\)"),
        ("rotation", (0,), [(0, 0, 0, 0)], "zero quaternions"),
        ("scale", (0,), [(0, math.nan, 0)], "finite"),
    ),
)
def test_wrong_keys_are_told(moved, path, times, values, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        e3d.motion.Channel(moved[1], path, times, values)


def test_clips_that_are_not_there_are_told(moved):
    scene, node = moved
    player = player_of(channel(node, "scale", [(1, 1, 1)], times=(0,)), scene=scene)
    for wrong in ("b", 3, -1, None.__class__, [], 1.5):
        with pytest.raises(e3d.InvalidArgumentError):
            player.play(wrong)
    other = e3d.Scene().add()
    with pytest.raises(e3d.InvalidArgumentError, match="scene"):
        e3d.AnimationPlayer(
            scene, [e3d.motion.AnimationClip([channel(other, "scale", [(1, 1, 1)], times=(0,))])]
        )
