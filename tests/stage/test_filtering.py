"""What textures are given by the command line, and what they keep."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.stage.filtering import USUAL_ANISOTROPY, USUAL_LOD_BIAS, Filtering
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer
from engine3d.stage.viewed_scene import ViewedScene


def scene_of(*textures):
    scene = e3d.Scene()
    for texture in textures:
        box = e3d.box()
        box.materials = [e3d.Material(texture=texture, normal_texture=textures[0])]
        scene.add(box)
    return scene


def texture(**sampling):
    return e3d.Texture(np.zeros((2, 2, 3), np.uint8), **sampling)


@pytest.mark.parametrize(
    ("filtering", "plain", "own"),
    [
        (Filtering(), (1, 0.0), (4, 0.0)),
        (Filtering(is_usual=True), (USUAL_ANISOTROPY, USUAL_LOD_BIAS), (4, 0.0)),
        (Filtering(1, is_usual=True), (1, USUAL_LOD_BIAS), (1, 0.0)),
        (Filtering(16, -1.0, is_usual=True), (16, -1.0), (16, -1.0)),
        (Filtering(lod_bias=0.5), (1, 0.5), (4, 0.5)),
    ],
)
def test_who_says_something_keeps_it(filtering, plain, own):
    textures = texture(), texture(anisotropy=4)
    filtering.put(scene_of(*textures))
    assert [(one.anisotropy, one.lod_bias) for one in textures] == [plain, own]


def test_a_view_gives_them_to_each_scene_that_it_shows():
    first, second = texture(), texture()
    settings = Settings({}, filtering=Filtering(is_usual=True))
    view = ViewRenderer(ViewedScene(scene_of(first), "first"), settings, (32, 24))
    assert (first.anisotropy, second.anisotropy) == (USUAL_ANISOTROPY, 1)
    view.show(ViewedScene(scene_of(second), "second"))
    assert second.anisotropy == USUAL_ANISOTROPY


def test_points_of_a_usual_size_are_as_large_in_shares_of_the_picture():
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(e3d.Mesh(np.random.default_rng(0).uniform(-1, 1, (50, 3)), points=range(50)))
    pictures = []
    for unit in ("pixels", "picture"):
        view = ViewRenderer(ViewedScene(scene, "dots"), Settings({"size_unit": unit}), (320, 240))
        pictures.append(view.draw(view.view(), ("color",)).color)
    assert (pictures[0] == pictures[1]).all()
    assert (pictures[0][..., 0] > 0).any()
