"""What models without physically based materials are made of in a look."""

import numpy as np
import pytest

import engine3d as e3d
from engine3d.model.materials.material import imply
from engine3d.stage.finish import CLAY, ROUGHNESS, StudioFinish

SIZE = (96, 72)
CLEAR = StudioFinish(reflects=True, sheen=0.0, colors=True)


def ball(**material):
    mesh = e3d.uv_sphere(0.5, (32, 16))
    mesh.materials = [e3d.Material(**material)]
    return mesh


def shown(thing, **options):
    frame = e3d.render(thing, size=SIZE, outputs=("color", "object_id"), **options)
    return frame.color[frame.object_id == 0][:, :3].astype(float)


def test_materials_become_dielectrics_and_stay_as_they_are():
    plain = e3d.Material(color="red")
    made = CLEAR(plain, False)
    assert (made.metallic, made.roughness, made.color) == (0.0, ROUGHNESS, (255, 0, 0))
    assert plain.metallic is None and not plain.is_physical
    shiny = CLEAR(e3d.Material(color="red", specular=(0.5, 0.5, 0.5), shininess=30.0), False)
    assert shiny.roughness == pytest.approx((2 / 32) ** 0.25)
    for kept in (e3d.Material(unlit=True), e3d.Material(metallic=1.0, roughness=0.2)):
        assert CLEAR(kept, False) is kept


def test_what_states_nothing_is_grey_unless_colours_tint_it():
    assert CLEAR(e3d.Material(), False).color == CLAY
    assert CLEAR(e3d.Material(name="steel", two_sided=True), False).color == CLAY
    assert CLEAR(e3d.Material(), True).color == (1, 1, 1)
    for stated in ({"color": "white"}, {"color": (1, 1, 1)}, {"roughness": 0.5}):
        assert CLEAR(e3d.Material(**stated), False).color != CLAY
    assigned = e3d.Material()
    assigned.color = "white"
    assert CLEAR(assigned, False).color == (255, 255, 255)


def test_the_material_of_gltf_files_without_one_is_grey():
    material = e3d.Material(color=(1.0, 1.0, 1.0), metallic=1.0, roughness=1.0)
    imply(material)
    made = CLEAR(material, False)
    assert (made.color, made.metallic, made.roughness) == (CLAY, 0.0, ROUGHNESS)


def test_the_sheen_is_light_besides_what_a_material_emits():
    sheen = StudioFinish(reflects=True, sheen=0.02, colors=True)
    made = sheen(e3d.Material(color="red", emissive=e3d.linear(0.1, 0.2, 0.3)), False)
    np.testing.assert_allclose(made.emissive, (0.12, 0.22, 0.32))


def test_grey_white_and_points():
    grey, white = shown(ball()).mean(0), shown(ball(color="white")).mean(0)
    assert grey.max() < 200 < white.min() and grey[0] > grey[2]
    same = [shown(thing) for thing in (ball(), e3d.uv_sphere(0.5, (32, 16)))]
    assert np.array_equal(*same)
    tinted = e3d.uv_sphere(0.5, (32, 16))
    tinted.colors = np.full((len(tinted.positions), 3), 255, np.uint8)
    np.testing.assert_allclose(shown(tinted).mean(0), white, atol=2)
    points = e3d.render(np.eye(3), size=SIZE, point_size=9).color
    assert (points == 255).all(-1).any()


def test_a_model_of_one_material_shows_form():
    lit = np.sort(shown(ball()).mean(1))
    assert lit[-20] > 1.6 * lit[20]  # display values: three times the light


def test_dark_colours_do_not_turn_black():
    dark = shown(ball(color=(0.12, 0.12, 0.12))).mean(1)
    bare = e3d.Look.studio(environment=False)
    crushed = shown(ball(color=(0.12, 0.12, 0.12)), look=bare).mean(1)
    assert dark.mean() > 20 > crushed.mean()


def test_metals_are_not_dark():
    silver = shown(ball(color=(0.9, 0.9, 0.9), metallic=1.0, roughness=0.1)).mean(1)
    assert silver.mean() > 110 and silver.max() > 230


def test_colours_that_stand_for_numbers_get_no_sheen():
    mesh = e3d.uv_sphere(0.5, (32, 16))
    numbers = np.zeros(len(mesh.positions))
    numbers[0] = 1.0
    look = {look: shown(mesh, color_by=numbers, look=look).min(0) for look in ("studio",)}
    assert (look["studio"] < 60).any()  # dark violet keeps its green at nearly nothing


def test_scenes_with_light_of_their_own_keep_their_materials():
    scene = e3d.Scene()
    scene.add(ball())
    scene.add(e3d.DirectionalLight((0, 0, -1)))
    camera = e3d.OrthographicCamera(0.6), e3d.look_at((0, 0, 3), (0, 0, 0))
    assert e3d.render(scene, camera, size=SIZE).color.max() == 255


@pytest.mark.parametrize("kind", ["obj", "e3d.json"])
@pytest.mark.parametrize("stated", [True, False])
def test_files_hold_whether_white_is_stated(kind, stated, tmp_path):
    path = tmp_path / f"ball.{kind}"
    mesh = ball(color="white") if stated else ball()
    if kind == "obj":
        mesh.save(path)
    else:
        scene = e3d.Scene()
        scene.add(mesh)
        e3d.save_scene(scene, path)
    assert np.array_equal(e3d.render(path, size=SIZE).color, e3d.render(mesh, size=SIZE).color)
    named = e3d.uv_sphere(0.5, (32, 16))
    named.materials = [e3d.Material(name="a", **({"color": "white"} if stated else {}))]
    named.save(tmp_path / "named.obj")
    found = e3d.load_mesh(tmp_path / "named.obj").materials[0]
    assert (CLEAR(found, False).color == CLAY) is not stated
