"""Whatever is done is undone to the bit, and done again to the bit."""

import warnings

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.node_commands import (
    AddNodes,
    DeleteNodes,
    DuplicateNodes,
    GroupNodes,
    JoinNodes,
    MoveNodes,
    Reparent,
    in_world,
)
from engine3d.apps.editor.scene_state import SceneState
from engine3d.apps.editor.value_commands import SetValues
from engine3d.io.writing.scene_saving import scene_text

RENDERER = e3d.Renderer((48, 36))
VIEW = e3d.PerspectiveCamera(1.2), e3d.look_at((0, 0, 9), (0, 0, 0))


def picture(scene):
    return RENDERER.render(scene, VIEW, outputs=("color", "object_id"))


def snapshot(scene):
    frame = picture(scene)
    pictures = frame.color.tobytes(), frame.object_id.tobytes()
    return SceneState(scene), *pictures, scene_text(scene, "/")


def small_scene():
    scene = e3d.Scene(background=(20, 30, 40))
    red = e3d.Material(color=(200, 30, 20), name="red")
    group = scene.add(name="group", scale=0.8)
    ball = e3d.uv_sphere(0.6, (8, 5))
    ball.materials = [red]
    scene.add(ball, parent=group, translation=(-1, 0, 0), name="ball")
    scene.add(e3d.box(0.9), parent=group, translation=(1, 0, 0), name="cube")
    scene.add(e3d.PointLight(intensity=9.0), translation=(2, 3, 4), name="lamp")
    scene.add(e3d.PerspectiveCamera(), translation=(0, 0, 5), name="eye")
    scene.add(e3d.InstancedMesh(e3d.box(0.3), [(0, 1.5, 0, 1), (0, -1.5, 0, 1)]), name="crowd")
    return scene


class Monkey:
    """Does anything that an editor can do, at random."""

    def __init__(self, document, seed):
        self.document, self.scene = document, document.scene
        self.random = np.random.default_rng(seed)

    def some_nodes(self):
        nodes = self.scene.nodes
        count = min(int(self.random.integers(1, 4)), len(nodes))
        return [nodes[k] for k in self.random.choice(len(nodes), count, replace=False)]

    def one(self, things):
        return things[int(self.random.integers(len(things)))]

    def materials(self):
        meshes = [n.object for n in self.scene.nodes if isinstance(n.object, e3d.Mesh)]
        return [material for mesh in meshes for material in mesh.materials]

    def add(self):
        obj = self.one([e3d.box(0.5), e3d.DirectionalLight(), None, e3d.OrthographicCamera(2)])
        place, parent = self.random.uniform(-2, 2, 3), self.one([None, *self.scene.nodes])
        return AddNodes(
            self.scene,
            lambda scene: scene.add(
                scene.add(obj, parent=parent, translation=place, name="new") and None, parent=parent
            ),
            "Add",
        )

    def delete(self):
        return DeleteNodes(self.scene, self.some_nodes()[:1])

    def duplicate(self):
        return DuplicateNodes(self.scene, self.some_nodes()[:1])

    def reparent(self):
        keeps = self.random.random() < 0.5
        parent = self.one([None, *self.scene.nodes])
        before = self.one([None, *(parent.children if parent else ())])
        return Reparent(self.scene, self.some_nodes(), parent, before=before, keep_world_pose=keeps)

    def group(self):
        return GroupNodes(self.scene, self.some_nodes())

    def join(self):
        meshes = [node for node in self.scene.nodes if isinstance(node.object, e3d.Mesh)]
        return JoinNodes(self.scene, meshes[:2]) if meshes else self.add()

    def move(self):
        offset = self.random.normal(size=3)
        how = self.one([
            in_world(e3d.linalg.translation(offset)),
            in_world(e3d.linalg.rotation_axis(offset, 0.3)),
            lambda s: setattr(s, "scales", self.random.uniform(0.5, 1.2)),
            lambda s: setattr(s, "rotations", self.random.normal(size=4)),
            lambda s: setattr(s, "translations", offset),
            lambda s: setattr(s, "scales", (0, 1, 1)),
        ])  # fmt: skip
        return MoveNodes(self.scene, self.some_nodes(), how)

    def set_node(self):
        values = self.one([
            {"name": f"n{self.random.integers(99)}"},
            {"visible": False},
            {"visible": True},
            {"static": True},
            {"collider": e3d.colliders.SphereCollider(0.4)},
            {"collider": e3d.colliders.BoxCollider()},
            {"collider": None},
            {"object": None},
            {"object": e3d.icosphere(0.4, 1)},
        ])  # fmt: skip
        return SetValues(self.some_nodes(), values)

    def set_thing(self):
        color = self.random.uniform(0, 1, 3)
        objects = [node.object for node in self.scene.nodes]
        lights = [o for o in objects if isinstance(o, e3d.PointLight)]
        cameras = [o for o in objects if isinstance(o, e3d.PerspectiveCamera)]
        texture = e3d.Texture(self.random.integers(0, 255, (4, 4, 3), np.uint8))
        choices = [([self.scene], {"background": color}), ([self.scene], {"ambient": color})]
        if self.materials():
            material = [self.one(self.materials())]
            choices += [(material, {"color": color}), (material, {"texture": texture})]
            choices += [(material, {"flat_shading": True, "shininess": 5.0})]
        if lights:
            choices += [([self.one(lights)], {"range": 9.0, "falloff": "window"})]
            choices += [([self.one(lights)], {"range": float("inf")})]  # may not go together
        if cameras:
            choices += [([self.one(cameras)], {"znear": self.random.uniform(0.1, 150)})]
        return SetValues(*self.one(choices))

    def run_python(self):
        self.document.prompt.push(
            self.one([
                "n = scene.nodes[-1]; scene.remove(n)",
                "scene.add(e3d.box(0.2), parent=scene.nodes[0])",
                "scene.nodes[0].translation += 0.25",
                "scene.nodes[-1].reparent(None)",
                "a = scene.add(); scene.nodes[-2].reparent(a); scene.remove(a)",
                "scene.ambient = 0.3, 0.2, 0.1",
                "for n in scene.nodes:\n    if isinstance(n.object, e3d.Mesh):\n"
                "        n.object.positions = n.object.positions * 1.01\n",
                "1 / 0",
            ])
        )  # fmt: skip

    def act(self):
        if len(self.scene.nodes) < 3:
            self.document.do(self.add())
        elif self.random.random() < 0.06:
            self.run_python()
        else:
            steps = (self.add, self.duplicate, self.reparent, self.group, self.move, self.move)
            steps = (
                *steps,
                self.join,
                self.set_node,
                self.set_node,
                self.set_thing,
                self.set_thing,
            )
            steps = (*steps, *(self.delete,) * (1 + len(self.scene.nodes) // 8))
            self.document.do(self.one(steps)(), drag=self.one([None, "drag"]))


@pytest.mark.parametrize("seed", range(5))
def test_all_is_undone_and_done_again_to_the_bit(seed):
    document = SceneDocument(small_scene())
    history, monkey = document.history, Monkey(document, seed)
    snapshots = {0: snapshot(document.scene)}
    for _ in range(200):
        monkey.act()
    count = history.position
    assert count > 100
    end = snapshot(document.scene)
    for position in reversed(range(count)):
        assert document.undo()
        if position % 20 == 1:
            snapshots[position] = snapshot(document.scene)
    assert not document.undo()
    assert snapshot(document.scene) == snapshots[0]
    for position in range(1, count + 1):
        assert document.redo()
        if position in snapshots:
            assert snapshot(document.scene) == snapshots[position]
    assert not document.redo()
    assert snapshot(document.scene) == end
    assert len({state[1] for state in snapshots.values()}) > 3
    kinds = {type(step).__name__ for step in history.steps}
    assert {"AddNodes", "DeleteNodes", "MoveNodes", "Reparent", "SetValues", "PythonStep"} <= kinds
    assert not any("history was cleared" in entry.text for entry in document.console.entries)


@pytest.mark.parametrize("how", ["reparent", "group"])
def test_a_step_done_again_at_another_time_gives_the_same_places(how):
    document = SceneDocument(small_scene())
    scene, animator = document.scene, document.animator
    ball, lamp = map(scene.find, ("ball", "lamp"))
    animator.spin([lamp, scene.find("group")], period=4.0)
    animator.seek(0.7)
    nodes = [ball, lamp]
    document.do(GroupNodes(scene, nodes) if how == "group" else Reparent(scene, [ball], lamp))
    animator.seek(0.0)
    after = scene_text(scene, "/")
    document.undo()
    document.redo()
    animator.seek(0.0)
    assert scene_text(scene, "/") == after


def test_a_drag_is_one_step():
    document = SceneDocument(small_scene())
    ball = document.scene.find("ball")
    for _ in range(30):
        step = in_world(e3d.linalg.translation((0.1, 0, 0)))
        document.do(MoveNodes(document.scene, [ball], step), drag=1)
    assert ball.translation[0] > 2 and document.history.position == 1
    document.do(MoveNodes(document.scene, [ball], in_world(np.eye(4))), drag=2)
    for value in (0.1, 0.2, 0.3):
        document.do(SetValues(ball.object.materials, {"color": (value, 0, 0)}), drag=3)
    assert document.history.position == 3
    assert [e.level for e in document.console.entries].count("action") == 3
    document.undo()
    assert ball.object.materials[0].color == (200, 30, 20)
    document.undo(), document.undo()
    assert ball.translation.tolist() == [-1, 0, 0]
    document.redo()
    assert ball.translation[0] > 2


def test_what_fails_changes_nothing_and_says_so():
    document = SceneDocument(small_scene())
    scene = document.scene
    ball, group, lamp = map(scene.find, ("ball", "group", "lamp"))
    before = snapshot(scene)

    def half_an_addition(scene):
        scene.add(e3d.box(), parent=group)
        scene.add("a box")

    def half_a_move(selection):
        selection.translations = 5
        selection.scales = "large"

    failing = [
        Reparent(scene, [lamp, group], ball),
        SetValues([ball, lamp], {"collider": e3d.colliders.BoxCollider()}),
        SetValues([lamp.object], {"color": (1, 0, 0), "falloff": "window"}),
        SetValues([scene.find("eye").object], {"znear": 500.0}),
        AddNodes(scene, half_an_addition, "Add half"),
        MoveNodes(scene, [ball, lamp], half_a_move),
    ]
    for command in failing:
        assert not document.do(command)
        assert snapshot(scene) == before, command.label
    assert document.history.position == 0 and not document.is_modified
    errors = [e.text for e in document.console.entries if e.level == "error"]
    assert len(errors) == len(failing)
    assert all(e.startswith(c.label) for e, c in zip(errors, failing, strict=True))


def test_the_modified_flag_follows_what_is_undone():
    document = SceneDocument(small_scene())
    history, scene = document.history, document.scene

    def step():
        document.do(SetValues([scene], {"ambient": e3d.linear(0.5, 0.5, 0.5)}), drag="one")

    assert not document.is_modified
    step()
    assert document.is_modified
    document.undo()
    assert not document.is_modified
    step()
    history.mark_saved()
    assert not document.is_modified
    step()  # not merged into what was saved
    assert document.is_modified and history.position == 2
    document.undo()
    assert not document.is_modified
    document.undo()
    assert document.is_modified
    step()  # what was saved cannot be reached any more
    document.undo()
    assert document.is_modified
    history.mark_saved()
    history.clear()
    assert not document.is_modified
    step()
    history.clear()
    assert document.is_modified


def test_reparenting_and_grouping_leave_all_where_it_is():
    document = SceneDocument(small_scene())
    scene = document.scene
    ball, lamp = scene.find("ball"), scene.find("lamp")
    places = [node.world_pose for node in (ball, lamp)]
    document.do(GroupNodes(scene, [ball, lamp], "both"))
    assert document.selection.active is ball.parent is lamp.parent
    assert ball.parent.name == "both" and ball.parent.parent is scene.find("group")
    document.do(Reparent(scene, [ball], None))
    for node, place in zip((ball, lamp), places, strict=True):
        np.testing.assert_allclose(node.world_pose, place, atol=1e-12)


def test_moving_a_parent_and_its_child_moves_the_child_once():
    document = SceneDocument(small_scene())
    scene = document.scene
    ball, group = scene.find("ball"), scene.find("group")
    before = ball.world_pose[:3, 3]
    document.do(MoveNodes(scene, [ball, group], in_world(e3d.linalg.translation((0, 2, 0)))))
    assert (ball.world_pose[:3, 3] - before).tolist() == [0, 2, 0]


def test_lights_that_are_copied_are_lights_of_their_own():
    document = SceneDocument(small_scene())
    scene = document.scene
    document.do(DuplicateNodes(scene, [scene.find("lamp"), scene.find("group")]))
    lamp, group = document.selection.nodes
    assert lamp.object is not scene.find("lamp").object
    assert lamp.object.intensity == 9
    assert [child.name for child in group.children] == ["ball", "cube"]
    assert group.children[0].object is scene.find("ball").object


def test_warnings_become_entries():
    document = SceneDocument()

    def add(scene):
        warnings.warn("a texture\nis missing", e3d.Engine3DWarning, stacklevel=1)
        scene.add(name="x")

    document.do(AddNodes(document.scene, add, "Add x"))
    assert [(e.level, e.text) for e in document.console.entries] == [
        ("warning", "a texture"),
        ("warning", "is missing"),
        ("action", "Add x"),
    ]


def bent_scene():
    """A skinned node and its joints below one node, and a morph target."""
    scene = e3d.Scene()
    root = scene.add(name="root")
    joints = [scene.add(parent=root), scene.add(parent=root, translation=(1, 0, 0))]
    target = e3d.motion.MorphTarget(np.ones((3, 3)))
    mesh = e3d.Mesh(
        np.eye(3),
        [[0, 1, 2]],
        joints=[[0, 1]] * 3,
        weights=[[0.5, 0.5]] * 3,
        morph_targets=[target],
    )
    node = scene.add(mesh, parent=root, name="bent")
    node.skin = e3d.motion.Skin(joints)
    node.morph_weights = [0.25]
    return scene, root, node


def test_copies_are_bent_by_the_copies_of_their_joints():
    scene, root, node = bent_scene()
    document = SceneDocument(scene)
    document.do(DuplicateNodes(scene, [root]))
    twin_root = scene.nodes[len(scene.nodes) // 2]
    *joints, twin = twin_root.children
    assert list(twin.skin.joints) == joints and twin.skin is not node.skin
    assert twin.skin.inverse_binds.tobytes() == node.skin.inverse_binds.tobytes()
    assert twin.morph_weights.tolist() == [0.25]
    document.do(DuplicateNodes(scene, [node]))
    assert scene.nodes[-1].skin.joints == node.skin.joints


def test_a_state_holds_how_nodes_are_bent():
    scene, _, node = bent_scene()
    skin, state = node.skin, SceneState(scene)
    node.skin, node.morph_weights = None, [0.5]
    assert state != SceneState(scene)
    state.put()
    assert node.skin is skin and node.morph_weights.tolist() == [0.25]
    assert state == SceneState(scene)


@pytest.mark.parametrize(
    "values",
    [
        {"euler": (0.5, 0.25, -0.125)},
        {"scale": (2.0, 1.0, 1.0)},
        {"rotation": (0.0, 0.0, 0.0, 1.0)},
        {"pose": np.eye(4)},
        {"translation": (1.0, 2.0, 3.0)},
    ],
)
def test_undo_restores_places_to_the_bit(values):
    scene, rng = e3d.Scene(), np.random.default_rng(7)
    turned = scene.add(e3d.box(), rotation=(0.1, 0.2, 0.3, np.sqrt(0.86)), scale=(1.1, 0.7, 0.9))
    sheared = scene.add(e3d.box())
    pose = np.eye(4)
    pose[:3] = rng.normal(size=(3, 4))
    sheared.pose = pose
    document = SceneDocument(scene)
    before = [(node.pose.tobytes(), node.rotation, node.scale) for node in (turned, sheared)]
    assert document.do(SetValues([turned, sheared], values))
    document.undo()
    after = [(node.pose.tobytes(), node.rotation, node.scale) for node in (turned, sheared)]
    assert [str(row) for row in after] == [str(row) for row in before]
