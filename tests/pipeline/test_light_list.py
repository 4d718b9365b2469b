"""A renderer that goes on drawing sees lights as one that has just been made does."""

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d

CAMERA = (e3d.PerspectiveCamera(yfov=0.9), e3d.look_at((0, 0, 4), (0, 0, 0)))


def lit_scene():
    """A ball, a group of two lamps, and a sun that no group holds."""
    scene = e3d.Scene(ambient=(0, 0, 0))
    scene.add(e3d.icosphere(1.0, 2))
    group = scene.add()
    lamps = [
        scene.add(e3d.PointLight(e3d.linear(1, 0.5, 0.2), 3.0), parent=group, translation=(x, 2, 1))
        for x in (-2, 2)
    ]
    sun = scene.add(e3d.DirectionalLight((0, -1, -1), e3d.linear(0.2, 0.3, 0.5)))
    return scene, group, lamps, sun


def remove_many(scene):
    """So many that the scene packs its arrays."""
    for node in [scene.add() for _ in range(3000)]:
        scene.remove(node)


CHANGES = {
    "move a lamp": lambda scene, group, lamps, sun: setattr(lamps[1], "translation", (0, 2, 2)),
    "move their group": lambda scene, group, lamps, sun: setattr(group, "translation", (1, 0, 0)),
    "turn the sun": lambda scene, group, lamps, sun: setattr(sun, "euler", (0.5, 0.4, 0.0)),
    "hide a lamp": lambda scene, group, lamps, sun: setattr(lamps[0], "visible", False),
    "hide the group": lambda scene, group, lamps, sun: setattr(group, "visible", False),
    "show it": lambda scene, group, lamps, sun: setattr(group, "visible", True),
    "colour a lamp": lambda scene, group, lamps, sun: setattr(lamps[1].object, "color", (0, 1, 0)),
    "bend the sun": lambda scene, group, lamps, sun: setattr(sun.object, "direction", (1, -1, 0)),
    "pack": lambda scene, group, lamps, sun: remove_many(scene),
    "add a lamp": lambda scene, group, lamps, sun: scene.add(e3d.PointLight(), parent=lamps[1]),
    "remove a lamp": lambda scene, group, lamps, sun: scene.remove(lamps[1]),
    "remove the sun": lambda scene, group, lamps, sun: scene.remove(sun),
    "remove all": lambda scene, group, lamps, sun: scene.remove(group),
}


def test_as_a_new_renderer_sees_them():
    scene, *nodes = lit_scene()
    before = None
    with Renderer((48, 32), threads=1) as renderer:
        for name, change in CHANGES.items():
            renderer.render(scene, CAMERA)
            change(scene, *nodes)
            frame = renderer.render(scene, CAMERA).color
            with Renderer((48, 32), threads=1) as other:
                np.testing.assert_array_equal(frame, other.render(scene, CAMERA).color, name)
            if name != "pack":
                assert before is None or (frame != before).any(), f"{name}: nothing changed"
            before = frame.copy()


def test_after_an_error():
    """A lamp that cannot be drawn stops every frame until it can, and then all is as it is now."""
    scene, group, lamps, _ = lit_scene()
    with Renderer((48, 32), threads=1) as renderer:
        renderer.render(scene, CAMERA)
        lamps[0].object.falloff = "window"
        for _ in range(2):
            with pytest.raises(e3d.InvalidArgumentError, match="needs a finite range"):
                renderer.render(scene, CAMERA)
        group.translation = (0.5, 0, 0)
        lamps[0].object.range = 6.0
        frame = renderer.render(scene, CAMERA).color
    with Renderer((48, 32), threads=1) as other:
        np.testing.assert_array_equal(frame, other.render(scene, CAMERA).color)
