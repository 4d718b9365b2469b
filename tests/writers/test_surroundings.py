"""Fog, gradients and skies in scene files: what is written reads back; what is wrong is named."""

import json

import pytest

import engine3d as e3d

FOG = e3d.Fog(e3d.linear(0.5, 0.25, 0.125), 1.5, 80.0)


@pytest.mark.parametrize("fog", [FOG, e3d.ExponentialFog((200, 190, 180), 0.02), None])
@pytest.mark.parametrize(
    "background", [e3d.Gradient((1, 2, 3), e3d.linear(0.5, 0.2, 0.1)), (9, 8, 7), None]
)
def test_written_and_read(tmp_path, background, fog):
    scene = e3d.Scene(background)
    scene.fog = fog
    e3d.save_scene(scene, tmp_path / "a.e3d.json")
    again = e3d.load_scene(tmp_path / "a.e3d.json")
    assert again.background == background and again.fog == fog


def test_a_sky_is_named_by_its_sun(tmp_path):
    scene = e3d.Scene(e3d.Environment.sky((1, 1, 0), 4.0, sun_disc=False))
    scene.environment = scene.background
    e3d.save_scene(scene, tmp_path / "a.e3d.json")
    assert (tmp_path / "a.e3d.json").stat().st_size < 2000
    assert e3d.load_scene(tmp_path / "a.e3d.json").environment is scene.environment


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("fog", 7, "scene.fog: 7"),
        ("fog", {"color": [1, 1, 1]}, "color, near, far or color, density"),
        ("fog", {"color": [1, 1, 1], "near": 5, "far": 2}, "scene.fog: near must be less"),
        ("fog", {"color": [1, 1, 1], "density": "x"}, "scene.fog: density"),
        ("background", {"top": [1, 1, 1]}, "top, bottom"),
        ("background", {"top": [1, 1, 1], "bottom": 2}, "scene.background: bottom"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, key, value, told):
    path = tmp_path / "a.e3d.json"
    e3d.save_scene(e3d.Scene(), path)
    tree = json.loads(path.read_text("utf-8"))
    tree["scene"][key] = value
    path.write_text(json.dumps(tree), "utf-8")
    with pytest.raises(e3d.FileFormatError, match=told):
        e3d.load_scene(path)


def test_gltf_says_that_fog_is_lost(tmp_path):
    scene = e3d.Scene()
    scene.fog = FOG
    scene.add(e3d.box())
    with pytest.warns(e3d.Engine3DWarning, match="fog"):
        e3d.save_scene(scene, tmp_path / "a.glb")
