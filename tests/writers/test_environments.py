"""Scenes with environments, written and read again; the editor's undoing of their changes."""

import json
import shutil

import numpy as np
import pytest
from loaders.seeds import HDR

import engine3d as e3d
from engine3d.apps.editor.scene_state import SceneState


def scene_in(environment):
    scene = e3d.Scene()
    scene.add(e3d.box())
    scene.environment = scene.background = environment
    scene.environment_rotation, scene.environment_intensity = 0.5, 2.0
    scene.background_blur = 0.25
    return scene


def written(scene, folder):
    path = folder / "a.e3d.json"
    e3d.save_scene(scene, path)
    return json.loads(path.read_text()), e3d.load_scene(path)


@pytest.fixture
def light(tmp_path):
    (tmp_path / "maps").mkdir()
    path = tmp_path / "maps" / "light.hdr"
    path.write_bytes(HDR)
    return e3d.Environment.load(path)


def check(scene, again):
    assert again.environment is again.background and not again.warnings
    assert np.array_equal(again.environment.pixels, scene.environment.pixels)
    assert again.environment.name == scene.environment.name
    for name in ("environment_rotation", "environment_intensity", "background_blur"):
        assert getattr(again, name) == getattr(scene, name)


def test_a_file_is_named_by_its_path(tmp_path, light):
    scene = scene_in(light)
    tree, again = written(scene, tmp_path)
    assert tree["environments"] == [{"file": "maps/light.hdr"}]
    assert tree["scene"]["environment"] == 0
    assert tree["scene"]["background"] == {"environment": 0}
    check(scene, again)
    assert again.environment.path == light.path


def test_a_built_in_one_is_named(tmp_path):
    scene = scene_in(e3d.Environment.sky())
    tree, again = written(scene, tmp_path)
    assert tree["environments"] == [{"built_in": "sky"}]
    check(scene, again)
    assert again.environment is e3d.Environment.sky()


def test_others_are_a_part_of_the_file(tmp_path, light):
    pixels = np.random.default_rng(0).random((3, 5, 3))
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    for environment in (e3d.Environment(pixels, name="noise"), light):
        scene = scene_in(environment)
        tree, again = written(scene, elsewhere)
        assert tree["environments"][0]["pixels"]["type"] == "float32"
        check(scene, again)


def test_scenes_without_one_say_nothing_of_it(tmp_path):
    tree, again = written(e3d.Scene(), tmp_path)
    assert set(tree["scene"]) == {"background", "ambient"} and "environments" not in tree
    assert again.environment is None and again.background == (0, 0, 0)


def test_a_missing_file_is_a_warning(tmp_path, light):
    written(scene_in(light), tmp_path)
    shutil.rmtree(tmp_path / "maps")
    again = e3d.load_scene(tmp_path / "a.e3d.json")
    assert again.environment is None and again.background == (0, 0, 0)
    assert any("maps/light.hdr" in warning for warning in again.warnings)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"environments": [{"built_in": "moon"}]}, "studio, sky, hall"),
        ({"environments": [{}]}, r"environments\[0\]: 'pixels' is missing"),
        ({"scene": {"environment": 1}}, "scene.environment: 1 is not the number of one of 0"),
        ({"scene": {"background": {"environment": "x"}}}, "scene.background.environment"),
        ({"scene": {"background_blur": 2}}, "scene.background_blur: background_blur must be"),
    ],
)
def test_what_is_wrong_names_its_place(tmp_path, change, told):
    tree = {"format": "engine3d scene", "version": 1, "nodes": [{}], **change}
    path = tmp_path / "a.e3d.json"
    path.write_text(json.dumps(tree))
    with pytest.raises(e3d.FileFormatError, match=told):
        e3d.load_scene(path)


def test_undone(light):
    scene = scene_in(light)
    before = SceneState(scene)
    scene.environment, scene.background = e3d.Environment.hall(), (1, 2, 3)
    scene.environment_rotation = scene.background_blur = 0.0
    assert SceneState(scene) != before
    before.put()
    assert scene.environment is light and scene.background is light
    assert scene.environment_rotation == 0.5 and scene.background_blur == 0.25
    assert SceneState(scene) == before
