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
    assert [filtering(texture()), filtering(texture(anisotropy=4))] == [plain, own]


def floor(**sampling):
    """Return a floor of fine lines that recedes."""
    lines = np.full((64, 64, 3), 255, np.uint8)
    lines[:, ::4] = 0
    mesh = e3d.plane((40.0, 40.0))
    mesh.uvs = mesh.uvs * 10
    mesh.materials = [e3d.Material(texture=e3d.Texture(lines, **sampling))]
    return mesh


CAMERA = e3d.PerspectiveCamera(0.7), e3d.look_at((0, 1.5, 12), (0, 0, 0))


def seen(thing, **options):
    return e3d.render(thing, CAMERA, size=(96, 54), **options).color.tobytes()


def test_looks_read_textures_that_say_nothing_and_leave_them_alone():
    said = {"anisotropy": USUAL_ANISOTROPY, "lod_bias": USUAL_LOD_BIAS}
    mesh = floor()
    image = mesh.materials[0].texture
    before = image.version
    usual = seen(mesh)
    assert usual == seen(floor(**said)) != seen(floor(anisotropy=2))
    assert (image.anisotropy, image.lod_bias, image.version) == (1, 0.0, before)
    assert seen(mesh, look="plain") == seen(floor(anisotropy=1), look="plain") != usual
    assert seen(mesh, look="plain") != seen(floor(**said), look="plain")
    image.anisotropy = 2
    assert seen(mesh) == seen(floor(anisotropy=2)) != usual


def test_scenes_with_light_of_their_own_read_textures_as_they_say(tmp_path):
    scene = e3d.Scene(background=(9, 9, 9))
    scene.add(floor())
    dressed = [seen(thing) for thing in (scene, saved(scene, tmp_path))]
    scene.add(e3d.DirectionalLight((0, -1, 0)))
    lit = [seen(thing) for thing in (scene, saved(scene, tmp_path))]
    assert dressed[0] == dressed[1] and lit[0] == lit[1]
    scene.nodes[0].object = floor(anisotropy=USUAL_ANISOTROPY, lod_bias=USUAL_LOD_BIAS)
    assert seen(scene) != lit[0]


def saved(scene, folder):
    e3d.save_scene(scene, folder / "scene.e3d.json")
    return folder / "scene.e3d.json"


def test_a_view_reads_so_each_scene_that_it_shows():
    settings = Settings({}, look="studio", filtering=Filtering(is_usual=True))
    scenes = [scene_of(texture()) for _ in range(2)]
    view = ViewRenderer(ViewedScene(scenes[0], "first", themed=True), settings, (32, 24))
    for scene in scenes:
        view.show(ViewedScene(scene, "next", themed=True))
        assert view.staging.scene.data.reading(texture()) == (USUAL_ANISOTROPY, USUAL_LOD_BIAS)


def test_points_of_a_usual_size_are_as_large_in_shares_of_the_picture():
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(e3d.Mesh(np.random.default_rng(0).uniform(-1, 1, (50, 3)), points=range(50)))
    pictures = []
    for unit in ("pixels", "picture"):
        view = ViewRenderer(ViewedScene(scene, "dots"), Settings({"size_unit": unit}), (320, 240))
        pictures.append(view.draw(view.view(), ("color",)).color)
    assert (pictures[0] == pictures[1]).all()
    assert (pictures[0][..., 0] > 0).any()
