"""Nodes outside of what a camera shows are left out, and it never shows."""

import math

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d import linalg

BOXES = 100_000


def random_poses(random, count, spread=50.0):
    """Poses of boxes of all sizes and directions, most of them small."""
    poses = np.zeros((count, 3, 4))
    poses[:, :, :3] = random.normal(size=(count, 3, 3))
    poses[:, :, :3] *= np.exp(random.normal(-2, 1.5, size=(count, 1, 1)))
    poses[:, :, 3] = random.normal(0, spread, size=(count, 3))
    return poses.reshape(count, 12)


def cameras(random, count, spread=50.0):
    """clip_from_world of cameras: inside, outside, wide, narrow, without a far plane."""
    for k in range(count):
        eye, target = random.normal(0, spread, (2, 3))
        if k % 4 == 0:
            camera = e3d.OrthographicCamera(math.exp(random.normal(2, 1)), znear=-5, zfar=60)
        elif k % 4 == 1:
            camera = e3d.PerspectiveCamera(random.uniform(0.05, 3), znear=0.01, zfar=math.inf)
        else:
            camera = e3d.PerspectiveCamera(random.uniform(0.2, 2), znear=0.5, zfar=80)
        pose = e3d.look_at(eye, target)
        yield linalg.multiply(camera.projection((640, 360)), linalg.inverse(pose))


def distances_beyond(boxes, clip_from_world):
    """How far each box is outside of the plane that it is farthest out of; and the scale of it."""
    lows, highs = boxes[:, :3], boxes[:, 3:6]
    most, scale = np.full(len(boxes), -np.inf), np.ones(len(boxes))
    for axis in range(3):
        for sign in (1, -1):
            plane = clip_from_world[3] + sign * clip_from_world[axis]
            corner = np.where(plane[:3] >= 0, highs, lows)
            beyond = -(corner @ plane[:3] + plane[3])
            size = np.abs(corner) @ np.abs(plane[:3]) + abs(plane[3])
            size += (np.abs(clip_from_world[3]) + np.abs(clip_from_world[axis])).sum() * boxes[:, 6]
            scale = np.where(beyond > most, size, scale)
            most = np.maximum(most, beyond)
    return most, scale


def selected(arrays, clip_from_world, flat):
    """Which slots may show, and how many boxes were tested."""
    bits = np.zeros((arrays.count + 63) // 64, np.uint64)
    tested = arrays.select(clip_from_world, 1.0, flat, bits)
    bits = np.unpackbits(bits.view(np.uint8), bitorder="little")[: arrays.count]
    return bits.astype(bool), tested


def check(scene, random, count=12):
    """Everything that shows is selected, and nothing that is farther out than rounding can be."""
    scene.data.update()
    arrays = scene.data.arrays
    boxes = arrays.columns["bounds"][: arrays.count]
    some = 0
    for clip_from_world in cameras(random, count):
        there = boxes[:, 0] <= boxes[:, 3]
        found, tested = selected(arrays, clip_from_world, flat=False)
        one_by_one, boxes_there = selected(arrays, clip_from_world, flat=True)
        assert np.array_equal(found, one_by_one)
        assert boxes_there == there.sum()  # each once; a tree has a third as many branches
        assert tested <= 1.5 * boxes_there + 16
        beyond, scale = distances_beyond(np.where(there[:, np.newaxis], boxes, 0), clip_from_world)
        assert not (there & (beyond <= 0) & ~found).any()
        assert not (found & (~there | (beyond > 1e-5 * scale))).any()
        some += found.sum()
    assert some > 0


def scatter(scene, nodes, random, share=1.0):
    moved = random.permutation(len(nodes))[: int(share * len(nodes))]
    for k, pose in zip(moved.tolist(), random_poses(random, len(moved)), strict=True):
        nodes[k].pose = np.vstack([pose.reshape(3, 4), (0, 0, 0, 1)])


def test_a_hundred_thousand_boxes_against_brute_force():
    random = np.random.default_rng(1)
    scene = e3d.Scene()
    mesh = e3d.box()
    nodes = [scene.add(mesh) for _ in range(BOXES)]
    arrays = scene.data.arrays
    arrays.columns["pose"][:BOXES] = random_poses(random, BOXES)
    check(scene, random, 60)
    scatter(scene, nodes, random, 0.01)  # the boxes above what moved are renewed
    check(scene, random)
    arrays.columns["pose"][:BOXES] = random_poses(random, BOXES)
    for node in nodes:
        node.visible = node.id % 3 > 0
    check(scene, random)


def test_a_scene_that_changes_all_the_time_against_brute_force():
    random = np.random.default_rng(2)
    scene = e3d.Scene()
    mesh, wide = e3d.box(), e3d.InstancedMesh(e3d.box(), random.normal(size=(5, 4)))
    nodes = []
    for step in range(40):
        parent = nodes[step] if len(nodes) > step else None
        nodes += [scene.add(wide if k % 9 == 0 else mesh, parent=parent) for k in range(30)]
        scatter(scene, nodes, random, random.choice([0.01, 0.2, 1.0]))
        for node in random.choice(nodes, 5, replace=False):
            if node.scene is scene:
                scene.remove(node)
        nodes = [node for node in nodes if node.scene is scene]
        nodes[random.integers(len(nodes))].visible ^= True
        if step % 7 == 3:
            wide.poses = random.normal(size=(3, 4, 4)) * [[1], [1], [1], [0]] + np.diag(
                [0, 0, 0, 1]
            )
        check(scene, random, 4)


def small_things(random):
    """A scene around the edges of what a camera shows: faces, lines and points, near and far."""
    scene = e3d.Scene()
    line = e3d.Mesh([(0, 0, 0), (1, 1, 0)], lines=[(0, 1)], points=[0])
    offset = e3d.Mesh(e3d.box().positions + np.float32(1e4), e3d.box().faces)
    meshes = (e3d.box(), line, e3d.primitives.quad(), e3d.Mesh(np.zeros((1, 3)), points=[0]))
    for k in range(400):
        x, y = random.uniform(-1.5, 1.5, 2)
        place = (x, y, random.uniform(-1.4, 1.4))
        turn, size = random.normal(size=4), math.exp(random.uniform(-5, -1))
        node = scene.add(meshes[k % 4], translation=place, rotation=turn, scale=size)
        if k % 10 == 0:
            pose = node.pose.copy()
            pose[:3, 3] -= pose[:3, :3] @ np.full(3, 1e4)  # far from its own origin: rounding shows
            scene.add(offset, pose=pose)
    return scene


@pytest.mark.parametrize(
    "options",
    [
        {"mode": "unlit"},
        {"mode": "overdraw"},
        {"wireframe": "overlay", "line_width": 40, "point_size": 60},
        {"wireframe": "only", "line_width": 7, "hidden_lines": True},
        {"hidden_surfaces": "painter", "cull": "none", "line_width": 25, "point_size": 9},
    ],
)
@pytest.mark.parametrize("perspective", [True, False])
def test_pictures_are_those_without_culling(options, perspective):
    scene = small_things(np.random.default_rng(3))
    if perspective:
        camera = (
            e3d.PerspectiveCamera(0.9, znear=1.9, zfar=3.0),
            e3d.look_at((0, 0, 2.9), (0, 0, 0)),
        )
    else:
        camera = e3d.OrthographicCamera(1.0, znear=-1.0, zfar=1.0), np.eye(4)
    outputs = ("color", "object_id", "face_id", "ndc_depth")
    pictures, draws = [], []
    for culling in ("tree", "frustum", "none"):
        with Renderer((90, 70)) as renderer:
            frame = renderer.render(scene, camera, outputs=outputs, culling=culling, **options)
        pictures.append([getattr(frame, name).tobytes() for name in outputs])
        draws.append(frame.stats["nodes_in_frustum"])
        assert frame.stats["nodes"] == len(scene.nodes)
    assert pictures[0] == pictures[1] == pictures[2]
    assert draws[0] == draws[1] < draws[2] == len(scene.nodes)


def test_nodes_beyond_all_numbers_are_drawn_or_not_but_lose_no_others():
    scene = e3d.Scene()
    huge = scene.add(scale=1e200)
    scene.add(e3d.box(), parent=scene.add(parent=huge, scale=1e200))  # not finite in the world
    scene.add(e3d.box(), translation=(1e300, 0, 0))
    seen = scene.add(e3d.box())
    camera = e3d.PerspectiveCamera(), e3d.look_at((0, 0, 3), (0, 0, 0))
    frame = render(scene, camera, size=(8, 8), outputs=("object_id",))
    assert seen.id in frame.object_id


def many_instances(random, kind):
    """More instances than are worth a tree, in a node that is turned and moved."""
    places = random.uniform(-6, 6, (3000, 4))
    places[:, 3] = random.uniform(0.01, 0.2, 3000)
    places[5, 0] = np.nan
    if kind == "matrices":
        turns = linalg.quaternion_to_matrix(random.normal(size=(3000, 4)))
        poses = turns * places[:, 3, np.newaxis, np.newaxis]
        poses[:, :3, 3], poses[:, 3] = places[:, :3], (0, 0, 0, 1)
    else:
        poses = places
    colors = random.integers(50, 255, (3000, 3), np.uint8)
    mesh = e3d.box()
    if kind == "lines":
        mesh = e3d.Mesh([(0, 0, 0), (1, 1, 0)], lines=[(0, 1)], points=[0])
        colors = colors / 255.0
    return e3d.InstancedMesh(mesh, poses, colors=colors)


@pytest.mark.parametrize("backend", ["scalar", "auto"])
@pytest.mark.parametrize("kind", ["matrices", "offsets", "lines"])
def test_instances_that_do_not_show_are_left_out(kind, backend):
    random = np.random.default_rng(8)
    scene = e3d.Scene()
    scene.add(e3d.uv_sphere(0.3))
    instances = many_instances(random, kind)
    scene.add(instances, rotation=(0.3, 0.1, 0.5, 0.8), translation=(0.2, 0, 0), scale=(1, 2, -0.5))
    scene.add(e3d.box((0.1, 3, 0.1)))
    outputs = ("color", "object_id", "instance_id", "face_id", "ndc_depth")
    with Renderer((60, 40), backend=backend) as renderer:
        for k in range(8):
            eye = (3 * math.sin(k), 1, 3 * math.cos(k))
            camera = e3d.PerspectiveCamera(0.7, znear=0.1, zfar=4), e3d.look_at(eye, (0, k, 0))
            pictures, drawn, tested = [], [], []
            for culling in ("tree", "frustum", "none"):
                frame = renderer.render(
                    scene, camera, outputs=outputs, culling=culling, line_width=9, point_size=12
                )
                pictures.append([getattr(frame, name).tobytes() for name in outputs])
                drawn.append(frame.stats["instances_in_frustum"])
                tested.append(frame.stats["boxes_tested"])
            assert pictures[0] == pictures[1] == pictures[2]
            assert frame.instance_id.max() > 0
            if k == 4:  # what changes is looked at anew
                instances.poses = instances.poses[::-1]
        assert drawn[0] == drawn[1] < 1500
        assert drawn[2] == 3002
        assert tested[0] < 1500
        assert tested[1] == 3 + 2999  # nodes and instances, but for the one that is nowhere
        assert tested[2] == 0


def test_boxes_tested_tell_the_tree_from_testing_one_by_one():
    """Of ten thousand nodes in a row, of which a camera sees a few; lights have no boxes."""
    scene = e3d.Scene()
    mesh = e3d.box(0.5)
    nodes = [scene.add(mesh, translation=(x, 0, 0)) for x in range(10_000)]
    scene.add(e3d.PointLight(), translation=(0, 3, 0))
    view = e3d.PerspectiveCamera(0.5, znear=0.1, zfar=20), e3d.look_at((7000, 0, 9), (7000, 0, 0))
    counts = {}
    with Renderer((60, 40)) as renderer:
        for culling in ("none", "frustum", "tree", "all"):
            counts[culling] = renderer.render(scene, view, culling=culling).stats
            again = renderer.render(scene, view, culling=culling).stats  # where nothing changed
            assert again["boxes_tested"] == counts[culling]["boxes_tested"]
        nodes[0].visible = False
        assert renderer.render(scene, view, culling="frustum").stats["boxes_tested"] == 9_999
    assert counts["none"]["boxes_tested"] == 0
    assert counts["frustum"]["boxes_tested"] == 10_000
    assert counts["tree"]["boxes_tested"] == counts["all"]["boxes_tested"] < 100
    assert counts["none"]["nodes_in_frustum"] == 10_000
    for culling in ("frustum", "tree", "all"):
        assert 3 < counts[culling]["nodes_in_frustum"] < 20
        assert counts[culling]["nodes_in_frustum"] == counts["tree"]["nodes_in_frustum"]
