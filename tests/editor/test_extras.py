"""What materials carry along is undone to the bit, however deep it lies and whoever changed it."""

import math

import numpy as np
import pytest

import engine3d as e3d
from engine3d.apps.editor.scene_state import SceneState
from engine3d.apps.editor.value_commands import SetValues
from engine3d.io.writing.scene_saving import scene_text

FIRST = {"b": 1, "a": {"list": [1, {"deep": 0.0}]}, "t": (1, [2])}
CHANGES = {
    "a key": lambda extras: extras.update(c=3),
    "a key gone": lambda extras: extras.pop("b"),
    "their order": lambda extras: extras.update(b=extras.pop("b")),
    "a list": lambda extras: extras["a"]["list"].append(2),
    "a dict in a list": lambda extras: extras["a"]["list"][1].update(deep=1.0),
    "a list in a tuple": lambda extras: extras["t"][1].append(3),
    "a sign": lambda extras: extras["a"]["list"][1].update(deep=-0.0),
    "a type": lambda extras: extras.update(b=True),
    "no number": lambda extras: extras.update(b=math.nan),
}


@pytest.fixture
def scene(tmp_path):
    """A scene of a mesh from a file, which is named in the scene's file while it is as it came."""
    e3d.Mesh(np.eye(3), [[0, 1, 2]], materials=[e3d.Material(name="red")]).save(tmp_path / "a.obj")
    scene = e3d.Scene()
    scene.add(e3d.load_mesh(tmp_path / "a.obj"), name="a")
    own = e3d.box()
    own.materials[0].extras = FIRST
    scene.add(own, name="own")
    return scene


@pytest.mark.filterwarnings("ignore::engine3d.Engine3DWarning")
@pytest.mark.parametrize("change", CHANGES)
def test_changes_in_place_are_written_and_undone(scene, tmp_path, change):
    material = scene.find("own").object.materials[0]
    state, before = SceneState(scene), scene_text(scene, str(tmp_path))
    CHANGES[change](material.extras)
    assert SceneState(scene) != state
    assert scene_text(scene, str(tmp_path)) != before
    state.put()
    assert SceneState(scene) == state
    assert scene_text(scene, str(tmp_path)) == before


def test_extras_of_what_came_from_a_file(scene, tmp_path):
    material = scene.find("a").object.materials[0]
    state, before = SceneState(scene), scene_text(scene, str(tmp_path))
    material.extras["key"] = [1]
    assert b'"key":[1]' in scene_text(scene, str(tmp_path))[0]
    state.put()
    assert scene_text(scene, str(tmp_path)) == before


@pytest.mark.parametrize("change", CHANGES)
def test_a_command_keeps_what_was_there(scene, tmp_path, change):
    material = scene.find("own").object.materials[0]
    before = scene_text(scene, str(tmp_path))
    given = {"new": [1]}
    command = SetValues([material], {"extras": given})
    command.do()
    done = scene_text(scene, str(tmp_path))
    given["new"].append(2)
    material.extras["new"].append(3)
    command.undo()
    assert scene_text(scene, str(tmp_path)) == before
    command.do()
    assert scene_text(scene, str(tmp_path)) == done


def test_extras_belong_to_one_material():
    material = e3d.Material(extras=FIRST)
    assert material.extras == FIRST
    material.extras["a"]["list"].append(2)
    assert FIRST["a"]["list"] == [1, {"deep": 0.0}]
