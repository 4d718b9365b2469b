"""Diffuse transmission: what of light from behind shows, against plain arithmetic."""

import math

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d

# A surface without any reflection: what shows is what is scattered, and what passes.
MATT = {"metallic": 0.0, "roughness": 1.0, "specular_intensity": 0.0, "two_sided": True}
ALBEDO, PASSING = np.array([0.8, 0.4, 0.2]), np.array([0.2, 0.6, 1.0])
SHEET = {
    **MATT,
    "color": e3d.linear(*ALBEDO),
    "diffuse_transmission": 0.25,
    "diffuse_transmission_color": e3d.linear(*PASSING),
}
BODY = {
    "thickness": 0.5,
    "attenuation_color": e3d.linear(0.5, 0.25, 0.125),
    "attenuation_distance": 0.25,
}
SHADOWS = ("none", "map", "exact")
all_backends = pytest.mark.parametrize("backend", e3d.backends())


def sheet(size=2.0, uvs=False, **material):
    half = size / 2
    corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], np.float32) * half
    places = [(0, 0), (1, 0), (1, 1), (0, 1)] if uvs else None
    mesh = e3d.Mesh(corners, [(0, 1, 2), (0, 2, 3)], uvs=places)
    mesh.materials = [e3d.Material(**{**SHEET, **material})]
    return mesh


def stage(mesh, *lights, scale=1.0, environment=None):
    """A sheet in the plane z = 0, seen from +z."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=e3d.linear(0, 0, 0))
    scene.environment = environment
    scene.add(mesh, scale=scale)
    for light, place in lights:
        scene.add(light, translation=place)
    return scene


def shown(scene, backend="auto", size=(8, 8), eye=(0, 0, 5), **options):
    camera = e3d.OrthographicCamera(0.1), e3d.look_at(eye, (0, 0, 0), (0, 1, 0))
    with Renderer(size, backend=backend) as renderer:
        radiance = renderer.render(scene, camera, outputs=("radiance",), **options).radiance
    return radiance[size[1] // 2, size[0] // 2]


def sun(towards, shadow="none", **given):
    """A sun of π lux, so that a white matt surface that faces it shows 1."""
    return e3d.DirectionalLight(
        -np.asarray(towards, float), intensity=math.pi, shadow=shadow, **given
    ), (0, 0, 0)


@all_backends
@pytest.mark.parametrize("shadow", SHADOWS)
def test_a_sheet_between_suns(backend, shadow):
    """Of the light of both sides, each with the cosine of its angle; on both sides alike."""
    front, back = np.array([0.6, 0, 0.8]), np.array([0, 0.8, -0.6])
    scene = stage(sheet(), sun(front, shadow), sun(back, shadow))
    expected = 0.75 * ALBEDO * 0.8 + 0.25 * PASSING * 0.6
    assert shown(scene, backend) == pytest.approx(expected, rel=2e-5)
    expected = 0.75 * ALBEDO * 0.6 + 0.25 * PASSING * 0.8
    assert shown(scene, backend, eye=(0, 0, -5)) == pytest.approx(expected, rel=2e-5)


@all_backends
@pytest.mark.parametrize("shadow", SHADOWS)
def test_a_lamp_behind(backend, shadow):
    """A point light at (1, 0, -2): 1/d² and the cosine; one beyond its range adds nothing."""
    lamp = e3d.PointLight(intensity=3.0 * math.pi, shadow=shadow), (1, 0, -2)
    far = e3d.PointLight(intensity=3.0 * math.pi, range=0.5, falloff="window"), (0, 0, -2)
    expected = 0.25 * PASSING * 3.0 / 5.0 * (2.0 / math.sqrt(5.0))
    assert shown(stage(sheet(), lamp, far), backend) == pytest.approx(expected, rel=1e-2)


@all_backends
def test_what_the_surface_reflects_does_not_pass(backend):
    """A furnace that is white all around shows 1, whatever part of the light passes."""
    white = {"color": (1.0, 1.0, 1.0), "diffuse_transmission_color": (1.0, 1.0, 1.0)}
    environment = e3d.Environment(np.ones((4, 8, 3), np.float32))
    for roughness in (0.0, 0.5, 1.0):
        for share in (0.25, 1.0):
            look = {"specular_intensity": 1.0, "roughness": roughness, **white}
            scene = stage(sheet(diffuse_transmission=share, **look), environment=environment)
            for eye in ((0, 0, 5), (3, 0, 2)):
                assert shown(scene, backend, eye=eye) == pytest.approx(1.0, abs=0.01)


@all_backends
def test_light_from_all_around_is_that_of_the_other_side(backend):
    """Of a sky that is bright behind the sheet alone."""
    terms = np.zeros((9, 3))
    terms[0], terms[2] = 0.5, -0.25  # less towards +z, more towards -z
    probe = e3d.LightProbe(terms)
    both = [
        shown(stage(sheet(diffuse_transmission=s), (probe, (0, 0, 0))), backend) for s in (0, 1)
    ]
    plain = stage(sheet(diffuse_transmission=0, two_sided=True), (probe, (0, 0, 0)))
    other = shown(plain, backend, eye=(0, 0, -5)) / ALBEDO
    assert both[1] == pytest.approx(other * PASSING, rel=1e-5)
    assert not np.allclose(both[0] / ALBEDO, other)


@all_backends
@pytest.mark.parametrize("shadow", SHADOWS)
@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_bodies_absorb_by_their_thickness(backend, shadow, scale):
    """By Beer's and Lambert's law, over a thickness that the pose scales, on either side."""
    left = np.array([0.5, 0.25, 0.125]) ** (0.5 * scale / 0.25)
    scene = stage(sheet(**BODY), sun((0, 0, -1), shadow), scale=scale)
    assert shown(scene, backend) == pytest.approx(0.25 * PASSING * left, rel=1e-4)
    scene = stage(sheet(**BODY), sun((0, 0, 1), shadow), scale=scale)
    assert shown(scene, backend, eye=(0, 0, -5)) == pytest.approx(0.25 * PASSING * left, rel=1e-4)


@all_backends
def test_transmission_comes_first_and_metal_lets_nothing_pass(backend):
    for look, share in (
        ({"transmission": 0.6}, 0.4),
        ({"metallic": 0.75}, 0.25),
        ({"metallic": 1.0}, 0.0),
    ):
        scene = stage(sheet(**look), sun((0, 0, -1)))
        assert shown(scene, backend) == pytest.approx(0.25 * share * PASSING, rel=1e-4)


@all_backends
def test_textures_multiply(backend):
    """Alpha of one, red, green and blue of the other, of either set of coordinates."""
    alpha = e3d.Texture(np.full((2, 2, 4), (9, 99, 199, 51), np.uint8))
    tint = e3d.Texture(np.full((2, 2, 4), (255, 0, 188, 7), np.uint8), color_space="linear")
    mesh = sheet(
        uvs=True,
        diffuse_transmission=1.0,
        diffuse_transmission_texture=alpha,
        diffuse_transmission_color_texture=tint,
    )
    scene = stage(mesh, sun((0, 0, -1)))
    expected = 0.2 * PASSING * np.array([255, 0, 188]) / 255
    assert shown(scene, backend) == pytest.approx(expected, rel=1e-3)


@all_backends
@pytest.mark.parametrize("kind", ["map", "exact"])
def test_what_hides_a_light_hides_it_from_behind(backend, kind):
    """A plate behind the sheet takes the light of half of it; the sheet's own takes none."""
    mesh = sheet(4.0)
    scene = stage(mesh, sun((0, 0, -1), kind))
    plate = e3d.box((2.0, 4.0, 0.1))
    plate.materials = [e3d.Material(**MATT)]
    scene.add(plate, translation=(-1.0, 0, -1.0))
    camera = e3d.OrthographicCamera(1.0), e3d.look_at((0, 0, 5), (0, 0, 0), (0, 1, 0))
    with Renderer((64, 64), backend=backend) as renderer:
        row = renderer.render(scene, camera, outputs=("radiance",)).radiance[32, :, 0]
    assert (row[:28] == 0).all()
    assert row[36:] == pytest.approx(0.25 * PASSING[0], rel=2e-5)


@all_backends
@pytest.mark.parametrize("kind", ["map", "exact"])
def test_a_body_is_lit_where_light_enters_it(backend, kind):
    """A box half a unit thick: its own back does not hide the light; a plate behind does."""
    box = e3d.box((2.0, 2.0, 0.5))
    box.materials = [e3d.Material(**{**SHEET, "thickness": 0.5})]
    scene = stage(box, sun((0, 0, -1), kind))
    assert shown(scene, backend) == pytest.approx(0.25 * PASSING, rel=2e-5)
    scene.add(sheet(2.0, diffuse_transmission=0.0), translation=(0, 0, -1))
    assert (shown(scene, backend) == 0).all()
    thin = stage(box, sun((0, 0, -1), kind))
    box.materials[0].thickness = 0.0
    assert (shown(thin, backend) == 0).all()


def test_off_is_off():
    """Without the share, its colour and textures change no byte."""
    scene = stage(sheet(uvs=True, diffuse_transmission=0.0), sun((0.6, 0, 0.8)), sun((0, 0, -1)))
    before = shown(scene)
    material = scene.nodes[0].object.materials[0]
    material.diffuse_transmission_color = (1, 2, 3)
    material.diffuse_transmission_texture = e3d.Texture(np.zeros((2, 2, 4), np.uint8))
    assert (shown(scene) == before).all()
