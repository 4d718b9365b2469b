"""What models stand in by default: soft light, a shadow on the ground, a background."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.viewer.settings import Settings
from engine3d.viewer.stage import theme_for
from engine3d.viewer.theme import DARK, LIGHT
from engine3d.viewer.view_renderer import ViewRenderer
from engine3d.viewer.viewed_scene import ViewedScene

SIZE = (120, 90)


def staged(color=(0.2, 0.2, 0.2), settings=None, **options):
    scene = e3d.Scene(ambient=(0.1, 0.2, 0.3))
    box = e3d.box()
    box.materials = [e3d.Material(color=color)]
    scene.add(box, name="box")
    settings = Settings({}, look="studio") if settings is None else settings
    return scene, ViewRenderer(ViewedScene(scene, "box", themed=True), settings, SIZE, **options)


def shadow_of(scene):
    return next((node for node in scene.nodes if node.name == "shadow"), None)


def test_a_model_casts_a_shadow_on_the_ground():
    scene, renderer = staged()
    with renderer:
        view = renderer.view()
        shown = renderer.draw(view).color.astype(int)
        shadow_of(scene).visible = False
        bare = renderer.renderer.render(scene, (renderer._camera(view), view.pose())).color
        shadow = shadow_of(scene).object
    alpha = shadow.materials[0].texture.pixels[..., 3]
    middle = len(alpha) // 2
    assert alpha[middle, middle] > 100 and alpha[0].max() == 0 == alpha[:, -1].max()
    corner = [tuple(picture[-1, 0]) for picture in (shown, bare.astype(int))]
    assert corner[0] == corner[1]  # where no shadow is, the background is as it was
    low = float(shadow.positions[:, 1].max())
    assert low == pytest.approx(-0.5)  # under the box


def test_the_shadow_is_none_of_the_models_parts():
    scene, renderer = staged()
    with renderer:
        renderer.draw(renderer.view())
        assert shadow_of(scene) is not None
        assert [entry.name for entry in renderer.visibility().objects()] == ["box"]


@pytest.mark.parametrize("change", [{"mode": "normal"}, {"wireframe": "overlay"}])
def test_it_shows_in_pictures_of_faces_alone(change):
    scene, renderer = staged()
    with renderer:
        view = renderer.view()
        renderer.draw(view)
        assert shadow_of(scene).visible
        for name, value in change.items():
            setattr(renderer.appearance, name, value)
        renderer.draw(view)
        assert not shadow_of(scene).visible


def test_a_transparent_picture_has_none():
    scene, renderer = staged(transparent=True)
    with renderer:
        renderer.draw(renderer.view())
    assert shadow_of(scene) is None and scene.background is None


def test_the_scene_is_left_as_it_was():
    scene, renderer = staged()
    before = len(list(scene.nodes)), scene.ambient
    with renderer:
        renderer.draw(renderer.view())
        renderer.leave_scene()
    assert [node.name for node in scene.nodes] == ["box"]
    assert before[0] > 1 and scene.ambient == (0.1, 0.2, 0.3)


@pytest.mark.parametrize(("color", "theme"), [((0.05,) * 3, LIGHT), ((1.0,) * 3, DARK)])
def test_the_background_is_one_that_the_model_stands_out_from(color, theme):
    scene, renderer = staged(color)
    with renderer:
        renderer.draw(renderer.view())
        assert renderer.theme is theme and scene.background == theme.gradient
        renderer.theme = DARK if theme is LIGHT else LIGHT  # the user's word stands
        renderer.draw(renderer.view())
        assert renderer.theme is not theme


def test_where_nothing_shows_the_first_theme_is_taken():
    assert theme_for(np.zeros((8, 8, 4), np.uint8)) is LIGHT


def test_scenes_of_their_own_and_the_plain_look_have_no_stage():
    scene, renderer = staged(settings=Settings({}))
    with renderer:
        renderer.draw(renderer.view())
    assert shadow_of(scene) is None and scene.background == DARK.background
