"""A kept renderer sees each change of a dressed scene, and looks without visiting all of it."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.scene import scene_changes
from engine3d.model.scene.scene_changes import SceneChanges
from engine3d.stage import ground_shadow

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
