"""Spins and keyframes as functions of time; pausing; what is far moves less often."""

import gc
import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d import linalg
from engine3d.model.scene.animation import motions_of


@pytest.fixture
def scene():
    return e3d.Scene()


def test_spins_are_turns_about_the_own_axis(scene):
    first = linalg.quaternion_from_axis_angle((1, 0, 0), 0.5)
    nodes = [scene.add(rotation=first, scale=k + 1) for k in range(5)]
    animator = e3d.Animator(scene)
    animator.spin(nodes, axis=(0, 2, 0), period=8.0, phase=0.25)
    for time in (0.0, 1.0, 3.3, 1000.0, -2.0):
        animator.seek(time)
        turn = linalg.quaternion_from_axis_angle((0, 1, 0), 2 * math.pi * (time / 8 + 0.25))
        expected = linalg.quaternion_to_matrix(linalg.quaternion_multiply(first, turn))
        for k, node in enumerate(nodes):
            np.testing.assert_allclose(
                linalg.quaternion_to_matrix(node.rotation), expected, atol=1e-10
            )
            np.testing.assert_allclose(node.scale, k + 1)


def test_the_time_alone_decides(scene):
    node, other = scene.add(), e3d.Scene()
    twin = other.add()
    one, two = e3d.Animator(scene), e3d.Animator(other)
    one.spin(node, period=3.0)
    two.spin(twin, period=3.0)
    for _ in range(10):
        one.advance(0.25)
    two.seek(2.5)
    assert node.pose.tobytes() == twin.pose.tobytes()


def test_pausing(scene):
    node = scene.add()
    animator = e3d.Animator(scene)
    animator.spin(node, period=4.0)
    animator.advance(1.0)
    kept = node.pose
    animator.paused = True
    animator.advance(1.0)
    assert node.pose is kept
    assert animator.time == 1.0
    animator.paused = False
    animator.advance(1.0)
    assert animator.time == 2.0
    assert node.pose.tobytes() != kept.tobytes()


def test_keyframes(scene):
    node = scene.add()
    animator = e3d.Animator(scene)
    quarter = linalg.quaternion_from_axis_angle((0, 0, 1), math.pi / 2)
    animator.track(
        node,
        [1, 2, 4],
        translations=[(0, 0, 0), (2, 0, 0), (2, 8, 0)],
        rotations=[(0, 0, 0, 1), quarter * 3, (0, 0, 0, -1)],
        scales=[(1, 1, 1), (3, 3, 3), (1, 1, 1)],
    )
    animator.seek(1.5)
    np.testing.assert_allclose(node.translation, (1, 0, 0))
    np.testing.assert_allclose(node.euler, (0, 0, math.pi / 4), atol=1e-12)
    np.testing.assert_allclose(node.scale, (2, 2, 2))
    animator.seek(2.5 + 3 * 100)  # the track repeats every 3 seconds
    np.testing.assert_allclose(node.translation, (2, 2, 0), atol=1e-10)
    np.testing.assert_allclose(node.euler, (0, 0, math.pi * 3 / 8), atol=1e-10)


def test_a_track_that_repeats_shows_its_last_keyframe(scene):
    node = scene.add()
    animator = e3d.Animator(scene)
    animator.track(node, [0, 1, 2.01], translations=[(0, 0, 0), (1, 0, 0), (5, 0, 0)])
    for time, place in ((2.01, 5.0), (np.nextafter(2.01, 3.0), 0.0), (-1.01, 1.0), (4.02, 0.0)):
        animator.seek(time)
        np.testing.assert_allclose(node.translation, (place, 0, 0), atol=1e-12)


def test_a_track_that_ends_stays_there(scene):
    node, still = scene.add(), scene.add()
    animator = e3d.Animator(scene)
    animator.track(node, [0, 1], translations=[(0, 0, 0), (1, 0, 0)], repeat=False)
    animator.track(still, [5], translations=[(7, 0, 0)])
    animator.seek(-3)
    assert node.translation.tolist() == [0, 0, 0]
    animator.seek(9)
    assert node.translation.tolist() == [1, 0, 0]
    assert still.translation.tolist() == [7, 0, 0]


def test_what_is_far_moves_less_often(scene):
    near = [scene.add(translation=(1, 0, k)) for k in range(3)]
    far = [scene.add(translation=(35, 0, k)) for k in range(8)]  # every fourth time
    animator = e3d.Animator(scene, full_rate_distance=10)
    animator.spin([*near, *far], period=100.0)
    animator.track(far[0], [0, 1], translations=[(35, 0, 0), (35, 0, 0.5)])
    moved = dict.fromkeys((*near, *far), 0)
    for _ in range(16):
        before = {node: node.pose for node in moved}
        animator.advance(0.1, eye=(0, 0, 0))
        for node, pose in before.items():
            moved[node] += node.pose is not pose
    assert all(moved[node] == 16 for node in near)
    assert all(moved[node] == 4 for node in far)
    animator.advance(0.1)  # without an eye, all move
    turns = {node.rotation.tobytes() for node in moved}
    assert len(turns) == 1


def test_removed_nodes_are_forgotten(scene):
    gone, kept = scene.add(), scene.add()
    animator = e3d.Animator(scene)
    animator.spin([gone, kept], period=2.0)
    animator.track(gone, [0, 1], translations=[(0, 0, 0), (1, 1, 1)])
    scene.remove(gone)
    animator.seek(0.5)
    assert gone.translation.tolist() == [0, 0, 0]
    np.testing.assert_allclose(kept.euler[1], math.pi / 2)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda a, n: a.spin(n, period=0), "period"),
        (lambda a, n: a.spin(n, period=1, axis=(0, 0, 0)), "axis"),
        (lambda a, n: a.spin(e3d.Scene().add(), period=1), "not a node of this scene"),
        (lambda a, n: a.track(n, []), "increase"),
        (lambda a, n: a.track(n, [1, 1]), "increase"),
        (lambda a, n: a.track(n, [0, 1], translations=[(0, 0, 0)]), "rows"),
        (lambda a, n: a.track(n, [0], rotations=[(0, 0, 0, 0)]), "zero"),
        (lambda a, n: a.track(n, [0], scales=[(1, 1)]), "shape"),
        (lambda a, n: a.seek(math.nan), "time"),
    ],
)
def test_arguments(scene, make, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        make(e3d.Animator(scene), scene.add())


def test_distance_must_be_positive(scene):
    with pytest.raises(e3d.InvalidArgumentError, match="full_rate_distance"):
        e3d.Animator(scene, full_rate_distance=0)


def test_what_is_no_scene_or_no_nodes(scene):
    with pytest.raises(e3d.InvalidArgumentError, match="scene must be a Scene"):
        e3d.Animator(None)
    animator = e3d.Animator(scene)
    for nodes in (None, 3, "ab", [e3d.Scene().add()]):
        with pytest.raises(e3d.InvalidArgumentError, match="is not a node of this scene"):
            animator.spin(nodes, period=1.0)
    with pytest.raises(e3d.InvalidArgumentError, match="iterable of Node"):
        scene.select(3)


def test_a_node_that_comes_back_moves_again(scene):
    node = scene.add()
    animator = e3d.Animator(scene)
    animator.spin(node, period=4.0)
    animator.track(node, (0, 1), translations=[(0, 0, 0), (4, 0, 0)])
    scene.remove(node)
    animator.seek(0.25)
    assert node.translation.tolist() == [0, 0, 0]
    scene.restore(node)
    animator.seek(0.5)
    assert node.translation.tolist() == [2, 0, 0] and node.rotation[1] > 0.3


def test_what_moved_nodes_that_nobody_has_is_forgotten(scene):
    animator = e3d.Animator(scene)
    for _ in range(3):
        node = scene.add()
        animator.spin(node, period=4.0)
        scene.remove(node)
    del node
    gc.collect()
    animator.seek(1.0)
    assert not any(motions_of(animator))
