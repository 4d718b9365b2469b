"""The option --shadow, of pictures and of what the viewer shows."""

import numpy as np
from PIL import Image

import engine3d as e3d
from engine3d.apps.cli import main
from engine3d.model.scene.ambient_lights import HemisphereLight
from engine3d.model.scene.lights import DirectionalLight, PointLight
from engine3d.stage.lighting import switch_shadows

SUN = ["--light-direction=-0.5,-1,-0.6"]


def picture(tmp_path, *options):
    path = tmp_path / "out.png"
    arguments = ["--scene", "shapes", "--size", "96x64", *options, "-o", str(path)]
    assert main(["render", *arguments]) == 0
    with Image.open(path) as image:
        return np.asarray(image.convert("L")).astype(int)


def test_maps_darken_what_lies_behind(tmp_path):
    lit, none = picture(tmp_path, *SUN), picture(tmp_path, *SUN, "--shadow", "none")
    shadowed = picture(tmp_path, *SUN, "--shadow", "map")
    assert (lit == none).all()
    assert (shadowed <= lit).all()
    assert (shadowed < lit - 40).sum() > 30


def test_none_takes_the_shadows_of_a_file_away(tmp_path):
    scene = e3d.Scene(ambient=e3d.linear(0.2, 0.2, 0.2))
    scene.add(e3d.plane((4.0, 4.0)))
    scene.add(e3d.box(0.5), translation=(0, 1, 0))
    scene.add(e3d.DirectionalLight((0.2, -1, 0.1), shadow="map"))
    e3d.save_scene(scene, tmp_path / "scene.e3d")
    pictures = []
    for options in ([], ["--shadow", "none"]):
        path = tmp_path / "out.png"
        arguments = [str(tmp_path / "scene.e3d"), "--size", "64x48", *options]
        assert main(["render", *arguments, "-o", str(path)]) == 0
        with Image.open(path) as image:
            pictures.append(np.asarray(image.convert("L")).astype(int))
    assert (pictures[0] <= pictures[1]).all() and (pictures[0] < pictures[1]).any()


def test_other_kinds_are_refused(capsys, tmp_path):
    arguments = ["--scene", "cube", "--shadow", "soft", "-o", str(tmp_path / "a.png")]
    assert main(["render", *arguments]) != 0
    assert "--shadow" in capsys.readouterr().err


def test_only_main_lights_cast():
    key, fill = DirectionalLight(intensity=1.0), DirectionalLight(intensity=0.2, shadow="map")
    lamps = [PointLight(shadow="map") for _ in range(5)]
    few = [PointLight() for _ in range(2)]
    switch_shadows([[key, fill, *lamps], few], "map")
    assert [light.shadow for light in (key, fill)] == ["map", "none"]
    assert {lamp.shadow for lamp in lamps} == {"none"}
    assert {lamp.shadow for lamp in few} == {"map"}


def test_light_from_all_around_is_left_alone():
    sky, sun = HemisphereLight(intensity=9.0), DirectionalLight()
    switch_shadows([[sky, sun]], "map")
    assert sun.shadow == "map"
