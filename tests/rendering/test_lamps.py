"""A lamp's own ball, which glows, keeps none of its light back: by maps and by exact shadows."""

import numpy as np
import pytest
from plain_picture import Renderer, render

import engine3d as e3d
from engine3d.apps.scenes import load_demo
from engine3d.stage.stage_settings import Settings
from engine3d.stage.view_renderer import ViewRenderer

SIZE = (64, 48)
GLOW = e3d.Material(color=(0, 0, 0), emissive=e3d.linear(1.0, 0.8, 0.4))
SHADOWS = ["map", "exact"]


def glowing(material=GLOW, center=(0.0, 0.0, 0.0)):
    ball = e3d.icosphere(0.3, 2)
    ball.positions = ball.positions + np.array(center)
    ball.materials = [material]
    return ball


def light_of(shadow):
    return e3d.PointLight(intensity=0.6 * np.pi, shadow=shadow, shadow_map_size=64)


def child(scene, shadow, material):
    lamp = scene.add(light_of(shadow), translation=(0.2, 1.0, 0.1))
    return scene.add(glowing(material), parent=lamp)


def parent(scene, shadow, material):
    ball = scene.add(glowing(material), translation=(0.2, 1.0, 0.1))
    scene.add(light_of(shadow), parent=scene.add(parent=ball, name="turn"))
    return ball


def same_place(scene, shadow, material):
    scene.add(light_of(shadow), translation=(0.2, 1.0, 0.1))
    return scene.add(glowing(material), translation=(0.2, 1.0, 0.1))


def elsewhere(scene, shadow, material):
    scene.add(light_of(shadow), translation=(0.2, 1.0, 0.1))
    return scene.add(glowing(material, (0.2, 1.0, 0.1)))


def spot(scene, shadow, material):
    light = e3d.SpotLight(intensity=0.8 * np.pi, shadow=shadow, shadow_map_size=64)
    turned = e3d.linalg.quaternion_from_axis_angle((1, 0, 0), -np.pi / 2)
    lamp = scene.add(light, translation=(0.2, 1.0, 0.1), rotation=turned)
    return scene.add(glowing(material), parent=lamp)


def instances(scene, shadow, material):
    lamp = scene.add(light_of(shadow), translation=(0.2, 1.0, 0.1))
    balls = e3d.InstancedMesh(glowing(material), np.eye(4)[np.newaxis])
    return scene.add(balls, parent=lamp)


LAMPS = [child, parent, same_place, elsewhere, spot, instances]


def room(lamp, shadow, material=GLOW):
    """A floor with a box, and a lamp over it: a scene, and the node of the lamp's ball."""
    scene = e3d.Scene(ambient=e3d.linear(0.02, 0.02, 0.02))
    scene.add(e3d.plane((6.0, 6.0), 2))
    scene.add(e3d.box((0.4, 0.4, 0.4)), translation=(0.9, 0.2, 0.3))
    return scene, lamp(scene, shadow, material)


def camera():
    eye = e3d.look_at((2.5, 2.5, 3.0), (0.2, 0.4, 0.0), (0, 1, 0))
    return e3d.PerspectiveCamera(0.9, znear=0.1, zfar=50.0), eye


def drawn(scene, **options):
    # Where backs are culled, light comes out of a ball by its map.
    return render(scene, camera(), size=SIZE, cull="none", **options).color


@pytest.mark.parametrize("shadow", SHADOWS)
@pytest.mark.parametrize("lamp", LAMPS)
def test_a_ball_that_glows_lets_its_light_pass(lamp, shadow):
    scene, ball = room(lamp, shadow)
    lit = drawn(scene)
    ball.cast_shadows = False
    assert (drawn(scene) == lit).all()
    dark, _ = room(lamp, shadow, e3d.Material(color=(0, 0, 0)))
    assert drawn(dark).mean() < 0.97 * lit.mean()  # what does not glow keeps it in


@pytest.mark.parametrize("shadow", SHADOWS)
def test_an_unlit_ball_lets_the_light_below_it_in_the_tree_pass(shadow):
    unlit = e3d.Material(color=(1.0, 0.8, 0.5), unlit=True)
    scene, ball = room(child, shadow, unlit)
    lit = drawn(scene)
    ball.cast_shadows = False
    assert (drawn(scene) == lit).all()
    scene, ball = room(same_place, shadow, unlit)
    shut = drawn(scene)
    ball.cast_shadows = False
    assert (drawn(scene) != shut).any()  # a room that was scanned with its light is no lamp


def test_lamps_of_the_built_in_scene_let_their_light_pass():
    pictures = []
    for shadow in ("none", "exact"):
        viewed = load_demo("shapes")
        settings = Settings({}, shadow=shadow)
        with ViewRenderer(viewed, settings, (120, 68)) as renderer:
            pictures.append(renderer.draw(renderer.view(), 0.0).color)
    # What hides no light from itself is as bright as without shadows: here most of the picture.
    darker = pictures[1].astype(int).sum(axis=2) < 0.7 * pictures[0].astype(int).sum(axis=2)
    seen = (pictures[0][..., :3] > 30).any(axis=2)
    assert (darker & seen).sum() < 0.1 * seen.sum()


@pytest.mark.parametrize("shadow", SHADOWS)
@pytest.mark.parametrize("lamp", LAMPS)
def test_it_keeps_the_light_of_others_back(lamp, shadow):
    scene, ball = room(lamp, shadow)
    scene.add(e3d.PointLight(intensity=3.0 * np.pi, shadow=shadow), translation=(0.3, 3.0, 0.2))
    lit = drawn(scene)
    ball.cast_shadows = False
    assert (drawn(scene) != lit).any()


def test_all_backends_let_it_pass_alike():
    scene, _ = room(child, "exact")
    scene.add(glowing(), translation=(-0.8, 0.5, 0.4))  # of a mesh that is drawn more often
    scene.add(e3d.PointLight(intensity=2.0 * np.pi, shadow="exact"), translation=(-0.8, 0.5, 0.4))
    scene.add(e3d.DirectionalLight((-1, -2, -1), intensity=0.4 * np.pi, shadow="exact"))
    first = drawn(scene, backend="scalar")
    for backend in e3d.backends():
        assert (drawn(scene, backend=backend) == first).all(), backend


@pytest.mark.parametrize("shadow", SHADOWS)
def test_a_renderer_that_drew_before_follows_what_glows_and_where(shadow):
    material = e3d.Material(color=(0, 0, 0))
    scene, ball = room(same_place, shadow, material)
    with Renderer(SIZE) as renderer:

        def check():
            kept = renderer.render(scene, camera(), cull="none").color
            assert (kept == drawn(scene)).all()
            return kept.copy()

        dark = check()
        material.emissive = (1.0, 1.0, 1.0)
        assert check().mean() > 1.2 * dark.mean()
        ball.translation = (0.2, 0.8, 0.1)  # the light is beside the middle half, and shut in
        shut = check()
        light = next(node for node in scene.nodes if isinstance(node.object, e3d.PointLight))
        light.reparent(ball)
        assert check().mean() > shut.mean()
        material.emissive = (0.0, 0.0, 0.0)
        check()


def test_a_model_that_glows_in_places_keeps_back_the_light_that_happens_to_be_in_it():
    """As one whose texture of emission is dark nearly everywhere."""
    dark = e3d.Texture(np.zeros((2, 2, 3), np.uint8))
    places = e3d.Material(emissive=(1, 1, 1), emissive_texture=dark, metallic=0.0)
    scene, ball = room(same_place, "exact", places)
    shut = drawn(scene)
    ball.cast_shadows = False
    assert drawn(scene).mean() > shut.mean()


@pytest.mark.parametrize("backend", e3d.backends())
def test_in_mode_unlit_a_lamp_shows_how_it_glows(backend):
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(glowing())
    look = (e3d.PerspectiveCamera(0.5), e3d.look_at((0, 0, 3), (0, 0, 0), (0, 1, 0)))
    color = render(scene, look, size=(9, 9), mode="unlit", backend=backend).color
    assert tuple(color[4, 4, :3]) == tuple(
        render(scene, look, size=(9, 9), backend=backend).color[4, 4, :3]
    )
    assert color[4, 4, 0] == 255
