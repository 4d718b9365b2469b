"""Scenes to start from are whole: they have light, a camera, and are saved and opened again."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.new_things.starts import STARTS
from engine3d.model.scene.lights import LIGHTS


@pytest.mark.parametrize("start", STARTS, ids=lambda start: start.title)
def test_a_start_is_lit_seen_and_saved(start, tmp_path, recwarn):
    scene = start.make()
    assert any(isinstance(node.object, LIGHTS) for node in scene.nodes)
    camera = scene.find("camera")
    if start.is_seen_through:
        frame = e3d.render(scene, camera, size=(96, 54), outputs=("color", "object_id"))
        assert (frame.object_id >= 0).mean() > 0.05
        assert 10 < frame.color[..., :3].mean() < 235
    scene.save(tmp_path / "start.e3d.json")
    again = e3d.load_scene(tmp_path / "start.e3d.json")
    assert [node.name for node in again.nodes] == [node.name for node in scene.nodes]
    poses = [scene.select(scene.nodes).world_poses, again.select(again.nodes).world_poses]
    assert np.array_equal(*poses)
    assert not recwarn.list
    assert start.make() is not scene


def test_the_solar_system_turns():
    scene = next(start for start in STARTS if "Solar" in start.title).make()
    earth = scene.find("Earth")
    before = earth.world_pose
    scene.animator.advance(1.0)
    assert not np.allclose(earth.world_pose, before)
