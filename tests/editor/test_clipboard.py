"""Nodes are copied as text and pasted, here and in other editors."""

import json

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.clipboard import Clipboard
from engine3d.apps.editor.document import SceneDocument
from engine3d.apps.editor.motion_copies import motions_in
from engine3d.apps.editor.scene_state import SceneState


@pytest.fixture
def document():
    scene = e3d.Scene()
    group = scene.add(name="group", translation=(1, 2, 3), scale=2)
    scene.add(e3d.box(), name="box", parent=group, translation=(1, 0, 0))
    scene.add(e3d.PointLight(intensity=3), name="lamp")
    scene.animator = e3d.Animator(scene)
    scene.animator.orbit(scene.nodes[2], scene.nodes[1], radius=2, period=4)
    return SceneDocument(scene)


def test_what_is_pasted_here_shares_its_mesh(document):
    clipboard, scene = Clipboard(), document.scene
    group, box, lamp = scene.nodes
    text, told = clipboard.copy([box, lamp])
    assert told == [] and json.loads(text)["format"] == "engine3d scene"
    box.object.materials[0].color = (1, 2, 3)
    before = SceneState(scene)
    assert document.do(clipboard.paste(scene, text))
    again, light = document.selection.nodes
    assert again.parent is None and np.array_equal(again.world_pose, box.world_pose)
    assert again.object is box.object and light.object is not lamp.object
    assert motions_in(scene).orbits[1].node is light and motions_in(scene).orbits[1].about is again
    after = SceneState(scene)
    document.undo()
    assert SceneState(scene) == before
    document.redo()
    assert SceneState(scene) == after
    assert document.do(clipboard.paste(scene, text)) and len(scene.nodes) == 7


def test_another_editor_pastes_the_text(document):
    text, _ = Clipboard().copy(document.scene.nodes)
    other = SceneDocument()
    assert other.do(Clipboard().paste(other.scene, text))
    group, box, lamp = other.scene.nodes
    assert [node.name for node in other.selection.nodes] == ["group", "lamp"]
    assert box.parent is group and np.array_equal(
        box.world_pose, document.scene.nodes[1].world_pose
    )
    assert lamp.object.intensity == 3
    other.animator.seek(1.0)
    assert np.allclose(lamp.translation, box.world_pose[:3, 3] + (0, 0, -2))


def test_an_orbit_about_what_is_not_copied_is_left_out(document):
    text, _ = Clipboard().copy([document.scene.nodes[2]])
    assert "orbits" not in text


def test_a_mesh_of_a_file_is_copied_by_its_name(tmp_path):
    e3d.save_mesh(e3d.icosphere(1, 4), tmp_path / "ball.obj")
    scene = e3d.Scene()
    scene.add(e3d.load_mesh(tmp_path / "ball.obj"))
    text, _ = Clipboard().copy(scene.nodes)
    assert len(text) < 1000 and "ball.obj" in text
    other = e3d.Scene()
    Clipboard().paste(other, text).do()
    assert np.array_equal(other.nodes[0].object.positions, scene.nodes[0].object.positions)


@pytest.mark.parametrize("text", ["", "hello", "{}", "[]", '{"format": "engine3d scene"', "\ud800"])
def test_other_text_is_no_node(text):
    with pytest.raises(e3d.FileFormatError):
        Clipboard().paste(e3d.Scene(), text)


def test_undo_and_redo_say_what(document):
    assert (document.undo_label, document.redo_label) == ("Undo", "Redo")
    clipboard = Clipboard()
    text, _ = clipboard.copy([document.scene.nodes[1]])
    document.do(clipboard.paste(document.scene, text))
    assert document.undo_label == "Undo paste 'box'"
    document.undo()
    assert (document.undo_label, document.redo_label) == ("Undo", "Redo paste 'box'")
    document.prompt.push("scene.ambient = 0.25, 0.25, 0.25; " + "a = 1; " * 20)
    assert document.undo_label.startswith("Undo Python: scene.ambient = 0.25")
    assert len(document.undo_label) <= 60 and document.undo_label.endswith("…")
