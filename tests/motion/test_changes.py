"""Skinned nodes while scenes change: nodes go and come back, slots are packed, threads draw."""

import gc
import threading

import numpy as np
from motion.test_posing import bent_tube, by_matrices, posed, skinned_scene
from motion.test_shown import stage, view, wriggle

import engine3d as e3d
from engine3d.linalg import transform_points
from engine3d.motion.shown import placing_pose


def world_points(scene, node):
    scene._update()
    return transform_points(placing_pose(node), node._posed.now().positions)


def test_nodes_that_go_and_come_back_are_bent_again():
    rng = np.random.default_rng(1)
    scene, node = skinned_scene(bent_tube(rng), rng)
    renderer = e3d.Renderer(64, 64)
    before = world_points(scene, node)
    scene.remove(node)
    renderer.render(scene)
    assert not scene.bounds.any()
    scene.nodes[2].translation = (0, 1, 0)
    scene.restore(node)
    after = world_points(scene, node)
    assert np.abs(after - before).max() > 0.1
    assert np.abs(after - by_matrices(node.object, node)).max() < 1e-4


def test_slots_that_are_packed_keep_their_joints():
    rng = np.random.default_rng(2)
    scene = e3d.Scene()
    crowd = [scene.add() for _ in range(3000)]
    mesh = bent_tube(rng)
    joints = [scene.add(translation=(0, k * 0.1, 0)) for k in range(5)]
    node = scene.add(mesh)
    node.skin = e3d.Skin(joints, np.tile(np.eye(4), (5, 1, 1)))
    before = world_points(scene, node)
    slot = node._slot
    while crowd:
        scene.remove(crowd.pop())
    assert node._slot != slot  # packed
    assert np.array_equal(world_points(scene, node), before)
    joints[1].translation = (3, 0, 0)
    assert np.abs(world_points(scene, node) - by_matrices(mesh, node)).max() < 1e-5
    e3d.render(scene, size=(16, 16))


def test_nothing_is_kept_of_nodes_that_are_gone():
    rng = np.random.default_rng(3)
    scene, joints, _ = stage(3, count=4)
    scene._update()
    count = len(scene._posing.poses)
    for node in [node for node in scene.nodes if node.skin][:3]:
        scene.remove(node)
    del node
    gc.collect()
    scene._update()
    assert (count, len(scene._posing.poses)) == (4, 1)
    assert len(scene._posing._nodes) == 1
    assert rng is not None


def test_a_mesh_without_joints_any_longer_is_drawn_at_rest():
    rng = np.random.default_rng(4)
    scene, node = skinned_scene(bent_tube(rng), rng)
    scene._update()
    node.object.set_influences(None, None)
    assert np.array_equal(posed(scene, node).positions, node.object.positions)
    assert scene._arrays.columns["anchor"][node._slot] == -1


def test_what_a_thread_draws_stays_as_it_is_while_another_moves_it():
    scene, joints, rng = stage(5, count=4)
    poses = []
    for _ in range(4):
        wriggle(joints, rng)
        poses.append(joints.poses)
    renderer = e3d.Renderer(128, 96, threads=1)
    expected = set()
    for pose in poses:
        joints.poses = pose
        expected.add(renderer.render(scene, view()).color.tobytes())
    assert len(expected) == 4
    seen, stop = [], threading.Event()

    def draw():
        own = e3d.Renderer(128, 96, threads=1)
        while not stop.is_set():
            seen.append(own.render(scene, view()).color.tobytes())

    threads = [threading.Thread(target=draw) for _ in range(2)]
    for thread in threads:
        thread.start()
    for turn in range(400):
        joints.poses = poses[turn % 4]
        scene._update()
    stop.set()
    for thread in threads:
        thread.join()
    assert len(seen) > 2 and set(seen) <= expected
