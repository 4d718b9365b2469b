"""Trees of nodes in arrays, against the same trees in plain Python, to the bit."""

import gc
import math

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d import linalg

MESHES = (e3d.box(), e3d.Mesh(np.zeros((0, 3))), e3d.uv_sphere(0.5, (8, 4)))
INSTANCES = e3d.InstancedMesh(e3d.box(), [[1, 0, 0, 2], [0, -3, 0, 1]])
OBJECTS = (*MESHES, INSTANCES, None, e3d.PointLight())


class PlainNode:
    """What a node should be: found from the root every time, with `linalg`."""

    def __init__(self, obj, parent):
        self.object, self.parent, self.visible = obj, parent, True
        self.pose = np.eye(4)

    def world_pose(self):
        if self.parent is None:
            return self.pose
        return linalg.multiply(self.parent.world_pose(), self.pose)

    def shown(self):
        return self.visible and (self.parent is None or self.parent.shown())

    def is_below(self, other):
        return self is other or (self.parent is not None and self.parent.is_below(other))

    def bounds(self):
        box = None
        if isinstance(self.object, e3d.Mesh) and len(self.object.positions):
            box = self.object.bounds
        elif isinstance(self.object, e3d.InstancedMesh):
            box = self.object.bounds_in_node()
        if box is None or not self.shown():
            return None
        center, half = (box[0] + box[1]) * 0.5, (box[1] - box[0]) * 0.5
        middle, around = self.world_pose()[:3, 3], np.zeros(3)
        for axis in range(3):
            column = self.world_pose()[:3, axis]
            middle = middle + column * center[axis]
            around = around + np.abs(column) * half[axis]
        return np.stack([middle - around, middle + around])


class Pair:
    """A scene and its plain likeness, changed together."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.scene = e3d.Scene()
        self.plain = {}

    def node(self):
        nodes = list(self.plain)
        return nodes[self.random.integers(len(nodes))] if nodes else None

    def add(self):
        parent = self.node() if self.random.random() < 0.8 else None
        obj = OBJECTS[self.random.integers(len(OBJECTS))]
        self.plain[self.scene.add(obj, parent=parent)] = PlainNode(obj, self.plain.get(parent))

    def remove(self):
        gone = self.node()
        plain = self.plain[gone]
        self.scene.remove(gone)
        self.plain = {n: p for n, p in self.plain.items() if not p.is_below(plain)}

    def reparent(self):
        node, parent = self.node(), self.node()
        if self.plain[parent].is_below(self.plain[node]):
            with pytest.raises(e3d.InvalidArgumentError, match="cycle"):
                node.parent = parent
        else:
            node.parent = parent
            self.plain[node].parent = self.plain[parent]

    def move(self):
        node = self.node()
        offset, rotation, scale = (self.random.normal(size=n) for n in (3, 4, 3))
        how = self.random.integers(4)
        plain = self.plain[node]
        if how == 0:
            plain.pose = linalg.multiply(linalg.compose(offset, rotation, scale), node.pose)
            node.pose = plain.pose
        elif how == 1:
            plain.pose = plain.pose.copy()
            plain.pose[:3, 3] = node.translation = offset
        else:
            _, old_rotation, old_scale = node.translation, node.rotation, node.scale
            if how == 2:
                node.rotation = rotation
                old_rotation = rotation
            else:
                node.scale = scale
                old_scale = scale
            plain.pose = linalg.compose(node.translation, old_rotation, old_scale)

    def hide(self):
        node = self.node()
        node.visible = self.plain[node].visible = not node.visible

    def change(self):
        steps = (self.add, self.add, self.add, self.move, self.move, self.reparent, self.hide)
        steps = (*steps, self.remove) if len(self.plain) > 20 else steps
        (steps[self.random.integers(len(steps))] if self.plain else self.add)()

    def check(self):
        for node, plain in self.plain.items():
            assert node.world_pose.tobytes() == plain.world_pose().tobytes()
            assert node.pose.tobytes() == plain.pose.tobytes()
            assert node.shown == plain.shown()
            bounds = plain.bounds()
            assert (node.bounds is None) == (bounds is None)
            if bounds is not None:
                np.testing.assert_array_equal(node.bounds, bounds)
            above = None if node.parent is None else self.plain[node.parent]
            assert above is plain.parent
            assert {self.plain[child] for child in node.children} == {
                other for other in self.plain.values() if other.parent is plain
            }
        assert list(self.scene.nodes) == list(self.plain)


@pytest.mark.parametrize("seed", range(12))
def test_whatever_is_done_the_tree_is_that_of_plain_python(seed):
    pair = Pair(seed)
    for _ in range(12):
        for _ in range(20):
            pair.change()
        pair.check()


def test_one_at_a_time_or_all_together_gives_the_same_bits():
    random = np.random.default_rng(3)
    scenes = e3d.Scene(), e3d.Scene()
    nodes = [[], []]
    for k in range(300):
        pose = linalg.compose(random.normal(size=3), random.normal(size=4), random.normal(size=3))
        for scene, made in zip(scenes, nodes, strict=True):
            made.append(scene.add(MESHES[0], parent=made[k // 2] if k else None, pose=pose))
            if scene is scenes[0]:
                assert made[-1].world_pose.shape == (4, 4)  # found now, alone
    assert scenes[0].bounds.tobytes() == scenes[1].bounds.tobytes()
    for first, second in zip(*nodes, strict=True):
        assert first.world_pose.tobytes() == second.world_pose.tobytes()
        assert first.bounds.tobytes() == second.bounds.tobytes()


def test_parts_have_the_bits_of_linalg():
    random = np.random.default_rng(4)
    scene = e3d.Scene()
    for k in range(200):
        offset, rotation, scale = (random.normal(size=n) for n in (3, 4, 3))
        scale[random.integers(3)] *= k % 5
        made = scene.add(translation=offset, rotation=rotation, scale=scale)
        assert made.pose.tobytes() == linalg.compose(offset, rotation, scale).tobytes()
        read = scene.add(pose=made.pose)
        for part, expected in zip(
            (read.translation, read.rotation, read.scale), linalg.decompose(made.pose), strict=True
        ):
            assert part.tobytes() == expected.tobytes()


def test_a_chain_is_found_from_either_end():
    scene = e3d.Scene()
    chain = [scene.add()]
    for _ in range(20_000):
        chain.append(scene.add(parent=chain[-1]))
    assert chain[-1].world_pose[0, 3] == 0
    for node in reversed(chain):  # children before their parents
        node.translation = (1, 0, 0)
    scene.add(e3d.box(), parent=chain[-1])
    assert scene.bounds[0, 0] == len(chain) - 0.5
    assert chain[-1].world_pose[0, 3] == len(chain)


def test_only_what_moved_is_found_anew():
    scene = e3d.Scene()
    moved, other = scene.add(), scene.add()
    below, beside = scene.add(parent=moved), scene.add(parent=other)
    kept = [node.world_pose for node in (moved, other, below, beside)]
    moved.translation = (1, 2, 3)
    scene.data.update()
    now = [node.world_pose for node in (moved, other, below, beside)]
    assert [a is b for a, b in zip(kept, now, strict=True)] == [False, True, False, True]


def test_slots_of_removed_nodes_are_given_up():
    scene = e3d.Scene()
    parents = [scene.add(name=f"p{k}", translation=(k, 0, 0)) for k in range(2000)]
    children = [scene.add(MESHES[0], parent=p, translation=(0, 1, 0)) for p in parents]
    gone = parents[5], children[5]
    for parent in parents[:1999]:
        scene.remove(parent)
    last = parents[1999], children[1999]
    assert scene.data.arrays.count == 4000  # whoever holds a node may put it back
    del parent, parents, children
    gc.collect()  # a node and those below it hold each other
    for _ in range(1100):
        scene.remove(scene.add())
    assert scene.data.arrays.count < 2000
    assert scene.nodes == last
    assert [node.id for node in last] == [1999, 3999]
    assert last[1].world_pose[:3, 3].tolist() == [1999, 1, 0]
    assert last[1].parent is last[0]
    assert scene.find("p5") is None
    assert scene.find("p1999") is last[0]
    assert scene.add().id == 5100
    # Handles of what is gone still read and write what they were.
    assert gone[1].world_pose[:3, 3].tolist() == [5, 1, 0]
    gone[0].translation = (7, 0, 0)
    assert gone[1].world_pose[:3, 3].tolist() == [7, 1, 0]
    assert gone[1].bounds is None


def test_removed_objects_are_let_go():
    scene = e3d.Scene()
    mesh = e3d.box()
    node = scene.add(mesh)
    scene.remove(node)
    assert scene.data.objects.objects == [None]
    assert scene.add(e3d.box())._arrays.columns["object"][1] == 0


def test_draws_follow_what_comes_and_goes():
    camera = e3d.OrthographicCamera(2.0), e3d.look_at((0, 0, 5), (0, 0, 0))
    scene = e3d.Scene()
    with Renderer((8, 8), backend="scalar") as renderer:

        def ids():
            frame = renderer.render(scene, camera, outputs=("object_id",))
            return set(np.unique(frame.object_id).tolist()) - {-1}

        nodes = [scene.add(MESHES[0], translation=(k - 1, 0, 0), scale=0.9) for k in range(3)]
        assert ids() == {0, 1, 2}
        nodes[1].visible = False
        assert ids() == {0, 2}
        scene.remove(nodes[0])
        assert ids() == {2}
        nodes.append(scene.add(MESHES[2], parent=nodes[1], translation=(0, 0.9, 0)))
        assert ids() == {2}
        nodes[3].parent = None
        assert ids() == {2, 3}
        nodes[1].visible = True
        assert ids() == {1, 2, 3}


def test_bounds_follow_a_mesh_that_changes():
    scene = e3d.Scene()
    mesh = e3d.box()
    node = scene.add(mesh, translation=(1, 0, 0))
    assert node.bounds.tolist() == [[0.5, -0.5, -0.5], [1.5, 0.5, 0.5]]
    mesh.positions = mesh.positions * 4
    assert node.bounds.tolist() == [[-1, -2, -2], [3, 2, 2]]
    assert scene.bounds.tolist() == node.bounds.tolist()
    node.visible = False
    assert node.bounds is None


def test_reparenting_keeps_the_pose_or_the_place():
    scene = e3d.Scene()
    parent = scene.add(translation=(1, 2, 3), rotation=(0, 0, 1, 1), scale=2)
    node = scene.add(translation=(1, 0, 0))
    node.reparent(parent, keep_world_pose=True)
    np.testing.assert_allclose(node.world_pose[:3, 3], (1, 0, 0), atol=1e-12)
    pose = node.pose
    node.parent = None
    assert node.pose.tobytes() == pose.tobytes()
    assert parent.children == ()
    flat = scene.add(scale=0)
    with pytest.raises(e3d.InvalidArgumentError, match="no inverse"):
        node.reparent(flat, keep_world_pose=True)
    assert node.parent is None
    with pytest.raises(e3d.InvalidArgumentError, match="of this scene"):
        node.parent = e3d.Scene().add()
    scene.remove(node)
    with pytest.raises(e3d.InvalidArgumentError, match="removed"):
        node.parent = None


def test_names_may_change():
    scene = e3d.Scene()
    first, second = scene.add(name="a"), scene.add(name="a")
    assert scene.find("a") is first
    first.name = "b"
    assert scene.find("a") is second
    assert scene.find("b") is first
    scene.remove(second)
    assert scene.find("a") is None
    third = scene.add(name="a")
    assert scene.find("a") is third


@pytest.mark.parametrize("order", ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"])
def test_euler_angles_there_and_back(order):
    random = np.random.default_rng(5)
    second = "XYZ".index(order[1])
    for _ in range(50):
        angles = random.uniform(-3, 3, 3)
        angles[second] *= 0.5
        back = linalg.quaternion_to_euler(linalg.euler_to_quaternion(angles, order), order)
        np.testing.assert_allclose(back, angles, atol=1e-9)
    angles[second] = math.pi / 2
    turn = linalg.euler_to_quaternion(angles, order)
    back = linalg.quaternion_to_euler(turn, order)
    expected = linalg.quaternion_to_matrix(turn)
    again = linalg.quaternion_to_matrix(linalg.euler_to_quaternion(back, order))
    np.testing.assert_allclose(again, expected, atol=1e-7)


def test_euler_angles_of_nodes():
    node = e3d.Scene().add(scale=2)
    node.euler = (0.1, 0.2, 0.3)
    np.testing.assert_allclose(node.euler, (0.1, 0.2, 0.3), atol=1e-15)
    assert node.scale.tolist() == [2, 2, 2]
    with pytest.raises(e3d.InvalidArgumentError, match="euler"):
        node.euler = (1, 2)
    with pytest.raises(e3d.InvalidArgumentError, match="permutation"):
        linalg.quaternion_to_euler((0, 0, 0, 1), "XXZ")
    with pytest.raises(e3d.InvalidArgumentError, match="shape"):
        linalg.quaternion_to_euler([(0, 0, 0, 1)])


def test_static_is_a_promise_not_a_lock():
    scene = e3d.Scene()
    node = scene.add(e3d.box(), static=True)
    assert node.static
    node.translation = (1, 0, 0)
    assert scene.bounds[1, 0] == 1.5
    node.static = False
    assert not node.static


@pytest.mark.parametrize("threads", [2, 3, 8])
def test_threads_change_nothing(threads):
    """Many nodes, some below others, wander until their tree is built again, and more come."""
    rng = np.random.default_rng(5)
    twins = [e3d.Scene(), e3d.Scene()]
    for scene in twins:
        groups = [scene.add() for _ in range(12)]
        for number in range(9000):
            scene.add(MESHES[number % 3], parent=groups[number % 12] if number % 5 else None)
    camera = e3d.PerspectiveCamera(yfov=0.8, znear=0.1, zfar=30.0)
    view = linalg.inverse(e3d.look_at((9, 9, 9), (0, 0, 0)))
    clip_from_world = linalg.multiply(camera.projection((64, 64)), view)
    places = rng.uniform(-5, 5, (9012, 3))
    for step in range(24):
        places += rng.normal(0, 0.1 * step, places.shape)
        rows = []
        for scene, number in zip(twins, (1, threads), strict=True):
            scene.select(scene.nodes[:9012]).translations = places
            if step % 10 == 7:
                for place in places[:20]:
                    scene.add(MESHES[0], translation=place)
            scene.data.update(number)
            arrays = scene.data.arrays
            bits = np.empty((arrays.count + 63) // 64, np.uint64)
            arrays.select(clip_from_world, 1.0, False, bits)
            names = ("world", "bounds", "flags", "world_version")
            rows.append([arrays.columns[name][: arrays.count] for name in names] + [bits])
        for one, many in zip(*rows, strict=True):
            np.testing.assert_array_equal(one, many)
