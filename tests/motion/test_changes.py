"""Skinned nodes while scenes change: nodes go and come back, slots are packed, threads draw."""

import gc
import threading

import numpy as np
import pytest
from motion.test_posing import bent_tube, by_matrices, skinned_scene
from motion.test_shown import stage, view, wriggle
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.linalg import transform_points
from engine3d.model.scene.shown import placing_pose, shown_object


def world_points(scene, node):
    scene.data.update()
    return transform_points(placing_pose(node), node._drawn.now().positions)


def test_nodes_that_go_and_come_back_are_bent_again():
    rng = np.random.default_rng(1)
    scene, node = skinned_scene(bent_tube(rng), rng)
    renderer = Renderer((64, 64))
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
    node.skin = e3d.motion.Skin(joints, np.tile(np.eye(4), (5, 1, 1)))
    before = world_points(scene, node)
    slot = node._slot
    while crowd:
        scene.remove(crowd.pop())
    assert node._slot != slot  # packed
    assert np.array_equal(world_points(scene, node), before)
    joints[1].translation = (3, 0, 0)
    assert np.abs(world_points(scene, node) - by_matrices(mesh, node)).max() < 1e-5
    render(scene, size=(16, 16))


def test_nothing_is_kept_of_nodes_that_are_gone():
    rng = np.random.default_rng(3)
    scene, joints, _ = stage(3, count=4)
    scene.data.update()
    count = len(scene.data.posing.poses)
    for node in [node for node in scene.nodes if node.skin][:3]:
        scene.remove(node)
    del node
    gc.collect()
    scene.data.update()
    assert (count, len(scene.data.posing.poses)) == (4, 1)
    assert len(scene.data.posing._nodes) == 1
    assert rng is not None


def test_a_mesh_without_joints_any_longer_is_drawn_at_rest():
    rng = np.random.default_rng(4)
    scene, node = skinned_scene(bent_tube(rng), rng)
    scene.data.update()
    node.object.set_influences(None, None)
    scene.data.update()
    assert shown_object(node) is node.object
    assert scene.data.arrays.columns["anchor"][node._slot] == -1


def test_what_a_thread_draws_stays_as_it_is_while_another_moves_it():
    scene, joints, rng = stage(5, count=4)
    poses = []
    for _ in range(4):
        wriggle(joints, rng)
        poses.append(joints.poses)
    renderer = Renderer((128, 96), threads=1)
    expected = set()
    for pose in poses:
        joints.poses = pose
        expected.add(renderer.render(scene, view()).color.tobytes())
    assert len(expected) == 4
    seen, stop = [], threading.Event()

    def draw():
        own = Renderer((128, 96), threads=1)
        while not stop.is_set():
            seen.append(own.render(scene, view()).color.tobytes())

    threads = [threading.Thread(target=draw) for _ in range(2)]
    for thread in threads:
        thread.start()
    for turn in range(400):
        joints.poses = poses[turn % 4]
        scene.data.update()
    stop.set()
    for thread in threads:
        thread.join()
    assert len(seen) > 2 and set(seen) <= expected


def flat_scene():
    """A square, moved by one joint and one morph target as soon as a node says so."""
    scene = e3d.Scene(ambient=(1, 1, 1))
    mesh = e3d.Mesh(SQUARE, [[0, 1, 2], [1, 3, 2]])
    node, joint = scene.add(mesh), scene.add(translation=(0.5, 0, 0))
    camera = e3d.PerspectiveCamera(zfar=20), e3d.look_at((0, 0, 6), (0, 0, 0))
    return scene, mesh, node, joint, camera


SQUARE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]])
STEPS = {
    "influences": lambda mesh, node, skin: mesh.set_influences(np.zeros((4, 1), int), [[1.0]] * 4),
    "targets": lambda mesh, node, skin: setattr(
        mesh, "morph_targets", [e3d.motion.MorphTarget(np.tile([0, 0.5, 0], (4, 1)))]
    ),
    "positions": lambda mesh, node, skin: setattr(mesh, "positions", SQUARE * (1, 0.5, 1)),
    "edges": lambda mesh, node, skin: setattr(mesh, "edge_visible", [[1, 0, 0], [0, 1, 1]]),
    "skin": lambda mesh, node, skin: setattr(node, "skin", skin),
    "weights": lambda mesh, node, skin: setattr(node, "morph_weights", [1.0]),
    "no skin": lambda mesh, node, skin: setattr(node, "skin", None),
    "no weights": lambda mesh, node, skin: setattr(node, "morph_weights", None),
    "no influences": lambda mesh, node, skin: mesh.set_influences(None, None),
    "no targets": lambda mesh, node, skin: setattr(mesh, "morph_targets", ()),
    "another mesh and back": lambda mesh, node, skin: (
        setattr(node, "object", None),
        setattr(node, "object", mesh),
    ),
}
END = ("influences", "targets", "positions", "edges", "skin", "weights")


def looked_at(scene, camera, renderer):
    """What pictures and rays say of a scene: the same the second time."""
    frames = [renderer.render(scene, camera, wireframe="overlay", cull="none") for _ in range(2)]
    again = renderer.render(scene, camera, outputs=("depth",), cull="none")
    assert frames[0].color.tobytes() == frames[1].color.tobytes()
    hits = [scene.raycast((x, 0.7, 3), (0, 0, -1)) for x in (0.25, 0.75, 1.25)]
    hits = [hit and hit.position.tolist() for hit in hits]
    return frames[0].color.tobytes(), again.depth.tobytes(), scene.bounds.tolist(), hits


def in_some_order(rng):
    """The steps of the end; joints come before a skin, targets before weights."""
    steps = list(rng.permutation(END))
    for first, then in (("influences", "skin"), ("targets", "weights")):
        if steps.index(first) > steps.index(then):
            a, b = steps.index(first), steps.index(then)
            steps[a], steps[b] = then, first
    return steps


@pytest.mark.parametrize("seed", range(40))
def test_the_order_in_which_a_mesh_is_made_to_bend_changes_nothing(seed):
    rng = np.random.default_rng(seed)
    scene, mesh, node, joint, camera = flat_scene()
    skin, renderer = e3d.motion.Skin([joint], np.eye(4)[None]), Renderer((64, 64))
    for _ in range(12):
        try:
            STEPS[str(rng.choice(list(STEPS)))](mesh, node, skin)
        except e3d.InvalidArgumentError:
            continue  # a skin for a mesh without joints, weights for no targets
        if rng.random() < 0.3:
            looked_at(scene, camera, renderer)
        if rng.random() < 0.3:
            assert np.isfinite(scene.bounds).all()
    for step in ("no skin", "no weights", "no influences", "no targets"):
        STEPS[step](mesh, node, skin)
    for step in in_some_order(rng):
        STEPS[step](mesh, node, skin)
    seen = looked_at(scene, camera, renderer)
    fresh, mesh, node, joint, camera = flat_scene()
    skin = e3d.motion.Skin([joint], np.eye(4)[None])
    for step in END:
        STEPS[step](mesh, node, skin)
    assert seen == looked_at(fresh, camera, Renderer((64, 64)))


def test_meshes_that_are_made_to_bend_after_their_nodes_bend():
    scene, mesh, node, joint, _ = flat_scene()
    STEPS["influences"](mesh, node, None)
    STEPS["targets"](mesh, node, None)
    node.skin, node.morph_weights = e3d.motion.Skin([joint], np.eye(4)[None]), [1.0]
    assert scene.bounds.tolist() == [[0.5, 0.5, 0], [1.5, 1.5, 0]]
    node.morph_weights = None
    assert scene.bounds.tolist() == [[0.5, 0, 0], [1.5, 1, 0]]
    node.morph_weights = [1.0]
    node.object = other = e3d.Mesh(SQUARE, [[0, 1, 2]])
    assert scene.bounds.tolist() == [[0, 0, 0], [1, 1, 0]]
    other.set_influences(np.zeros((4, 1), int), [[1.0]] * 4)
    assert scene.bounds.tolist() == [[0.5, 0, 0], [1.5, 1, 0]]
    other.morph_targets = mesh.morph_targets
    assert scene.bounds.tolist() == [[0.5, 0.5, 0], [1.5, 1.5, 0]]


def test_colliders_of_meshes_that_are_bent_later_are_where_these_are():
    scene, mesh, node, joint, _ = flat_scene()
    STEPS["influences"](mesh, node, None)
    node.collider = e3d.colliders.MeshCollider()
    assert scene.overlap_sphere((1.3, 0.5, 0), 0.1) == ()
    node.skin = e3d.motion.Skin([joint], np.eye(4)[None])
    assert scene.overlap_sphere((1.3, 0.5, 0), 0.1) == (node,)
