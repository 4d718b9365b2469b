"""A kept renderer sees each change of a dressed scene, and looks without visiting all of it."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.scene import scene_changes
from engine3d.model.scene.scene_changes import SceneChanges
from engine3d.stage.ground import ground_shadow
from engine3d.stage.staging import Staging

SIZE = (64, 48)


def scene():
    made = e3d.Scene()
    image = e3d.Texture(np.full((4, 4, 3), 90, np.uint8))
    ball = e3d.uv_sphere(0.5, (12, 6))
    ball.materials = [e3d.Material(texture=image)]
    made.add(ball, name="ball")
    poses = np.array([(2, 0, 0, 1), (3, 0, 0, 0.5)], np.float32)
    made.add(e3d.InstancedMesh(e3d.box(), poses), name="boxes")
    hole = e3d.plane((1.0, 1.0))
    leaf = np.zeros((4, 4, 4), np.uint8)
    leaf[:2] = 255
    hole.materials = [e3d.Material(texture=e3d.Texture(leaf), alpha_mode="mask")]
    made.add(hole, name="leaf", translation=(0, 1.5, 0))
    return made


def ball(made):
    return made.find("ball").object


def set_pixels(made):
    ball(made).materials[0].texture.pixels = np.full((4, 4, 3), 200, np.uint8)


def grow_hole(made):
    texture = made.find("leaf").object.materials[0].texture
    texture.pixels = np.zeros((4, 4, 4), np.uint8)


def move_instances(made):
    made.find("boxes").object.poses = np.array([(2, 1, 0, 1)], np.float32)


CHANGES = {
    "a node moves": lambda made: setattr(made.find("ball"), "translation", (0, 1, 0)),
    "a node hides": lambda made: setattr(made.find("ball"), "visible", False),
    "a node comes": lambda made: made.add(e3d.torus()),
    "a node goes": lambda made: made.remove(made.find("ball")),
    "a node holds another mesh": lambda made: setattr(made.find("ball"), "object", e3d.torus()),
    "a mesh bends": lambda made: setattr(ball(made), "positions", ball(made).positions * (1, 2, 1)),
    "a colour": lambda made: setattr(ball(made).materials[0], "color", (200, 0, 0)),
    "another material": lambda made: setattr(ball(made), "materials", [e3d.Material()]),
    "a texture": set_pixels,
    "a hole": grow_hole,
    "instances move": move_instances,
    "a background": lambda made: setattr(made, "background", (1, 2, 3)),
    "light": lambda made: made.add(e3d.PointLight(), translation=(0, 3, 3)),
}


@pytest.mark.parametrize("name", CHANGES)
def test_each_change_shows(name):
    made = scene()
    with e3d.Renderer(SIZE) as kept:
        before = kept.render(made).color.copy()
        CHANGES[name](made)
        after = kept.render(made).color.copy()
    assert not np.array_equal(before, after)
    assert np.array_equal(after, e3d.render(made, size=SIZE).color)


@pytest.mark.parametrize("name", CHANGES)
def test_each_change_is_noticed_once_it_was_made(name):
    made = scene()
    changes = SceneChanges(made)
    assert not changes.any and not changes.any
    CHANGES[name](made)
    assert changes.any and changes.any
    assert not SceneChanges(made).any


def moving_scene():
    """Return a scene with a group, a deformed mesh, points, and all that `scene` has."""
    made = scene()
    group = made.add(name="group", translation=(0, 0.5, 0))
    joint = made.add(name="joint", parent=group)
    pole = e3d.cylinder(0.2, 2.0, 8)
    weights = np.tile(np.float32([1, 0, 0, 0]), (len(pole.positions), 1))
    joints = np.zeros(weights.shape, np.uint16)
    pole = e3d.Mesh(pole.positions, pole.faces, joints=joints, weights=weights)
    made.add(pole, name="pole", translation=(-2, 0, 0)).skin = e3d.motion.Skin([joint])
    dots = e3d.Mesh(np.eye(3, dtype=np.float32), points=np.arange(3))
    made.add(dots, name="dots", parent=group)
    return made


def turn(node, random):
    node.rotation = random.normal(size=4)


def sink(node, random):
    node.translation = random.uniform(-3, 1, 3)


def swell(node, random):
    node.scale = random.uniform(0.3, 2.0, 3)


def hide(node, random):
    node.visible = not node.visible


def bear(node, random):
    node.scene.add(e3d.box(), parent=node, translation=random.uniform(-2, 2, 3))


def leave(node, random):
    if not node.name:
        node.scene.remove(node)


def move_away(node, random):
    if node.name != "group":
        node.parent = None if node.parent else node.scene.find("group")


def dye(node, random):
    ball(node.scene).materials[0].color = random.integers(0, 255, 3)


def stretch(node, random):
    ball(node.scene).positions = ball(node.scene).positions * random.uniform(0.8, 1.2)


def paper(node, random):
    node.scene.background = (0, 0, 0) if random.random() < 0.6 else (9, 90, 200)


def strew(node, random):
    poses = random.uniform(0.2, 2.0, (random.integers(1, 4), 4))
    colors = random.integers(0, 255, (len(poses), 3), np.uint8)
    node.scene.find("boxes").object.replace(poses, colors)


MOVES = (turn, sink, sink, swell, hide, strew)
OTHERS = (bear, leave, move_away, dye, stretch, paper)


@pytest.mark.parametrize("seed", range(4))
def test_a_kept_renderer_draws_what_a_new_one_does(seed):
    random, made = np.random.default_rng(seed), moving_scene()
    names = ("color", "object_id", "depth")
    with e3d.Renderer(SIZE) as kept:
        for _ in range(10):
            for _ in range(random.integers(1, 4)):
                changes = OTHERS if random.random() < 0.2 else MOVES
                changes[random.integers(len(changes))](random.choice(list(made.nodes)), random)
            camera = None
            if random.random() < 0.5:
                camera = e3d.frame_scene(made, direction=random.normal(size=3))
            old = kept.render(made, camera, outputs=names)
            with e3d.Renderer(SIZE) as fresh:
                new = fresh.render(made, camera, outputs=names)
            for name in names:
                assert np.array_equal(getattr(old, name), getattr(new, name), equal_nan=True)


def test_a_scene_whose_nodes_move_is_not_staged_again(monkeypatch):
    made, stagings = moving_scene(), []
    build = Staging.__init__
    monkeypatch.setattr(Staging, "__init__", lambda *given: stagings.append(given) or build(*given))
    random = np.random.default_rng(3)
    with e3d.Renderer(SIZE) as kept:
        for move in (turn, sink, swell, hide, hide):
            move(made.find("group"), random)
            sink(made.find("joint"), random)
            kept.render(made)
        assert len(stagings) == 1
        bear(made.find("group"), random)
        kept.render(made)
    assert len(stagings) == 2


@pytest.mark.parametrize("name", CHANGES)
def test_only_moves_are_taken(name):
    made = scene()
    changes = SceneChanges(made)
    CHANGES[name](made)
    is_move = name in ("a node moves", "a node hides", "instances move")
    assert changes.take_moves() == is_move
    assert changes.any == (not is_move)


def test_a_still_scene_is_not_visited(monkeypatch):
    made, visits = scene(), []
    for module, name in ((scene_changes, "uses_in"), (ground_shadow, "textures_of")):
        visit = getattr(module, name)
        monkeypatch.setattr(
            module, name, lambda *things, visit=visit: visits.append(1) or visit(*things)
        )
    cameras = [e3d.frame_scene(made, direction=(k, -1, -2)) for k in range(4)]
    with e3d.Renderer(SIZE) as kept:
        for camera in cameras[:2]:
            kept.render(made, camera)
        first = len(visits)
        for camera in cameras:
            kept.render(made, camera)
    assert len(visits) == first > 0
