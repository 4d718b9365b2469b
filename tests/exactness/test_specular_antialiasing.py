"""Section 26 of docs/exactness: lobes that are as wide as the normals within a pixel ask for.

The truth is the light of a picture eight times as large without it, in which texels are larger than
pixels, averaged.
"""

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d

SIDE = 48
TIMES = 8


def bumps(side=512, seed=2):
    """A normal map of small bumps, whose mean normal is straight up."""
    height = np.random.default_rng(seed).normal(size=(side, side))
    for _ in range(2):
        height = sum(np.roll(height, shift, axis) for axis in (0, 1) for shift in (-1, 0, 1)) / 6
    dy, dx = np.gradient(height)
    normal = np.stack([-3 * dx, 3 * dy, np.ones_like(dx)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    pixels = np.full((side, side, 4), 255, np.uint8)
    pixels[..., :3] = np.rint(127.5 * normal + 127.5)
    return e3d.Texture(pixels, filter="trilinear")


def shiny(roughness=0.2, **options):
    return e3d.Material(color=(1, 1, 1), metallic=1.0, roughness=roughness, **options)


def bumpy(roughness=0.2):
    mesh = e3d.plane(2.0)
    mesh.materials = [shiny(roughness, normal_texture=bumps())]
    return mesh


def ball(roughness=0.2):
    mesh = e3d.icosphere(0.5, 4)
    mesh.materials = [shiny(roughness)]
    return mesh


def lit(mesh, distance, tilt=0.0, turn=0.0):
    """A plane faces the camera and the light, if it isn't tilted."""
    scene = e3d.Scene(background=(0, 0, 0))
    scene.add(mesh, euler=(np.pi / 2 - tilt, turn, 0))
    scene.add(e3d.DirectionalLight((-0.3, -0.3, -1), intensity=1.0))
    return scene, (e3d.PerspectiveCamera(0.5), e3d.look_at((0, 0, distance), (0, 0, 0)))


def light(scene, camera, on, side=SIDE):
    with Renderer((side, side)) as renderer:
        outputs = ("color", "radiance")
        frame = renderer.render(scene, camera, outputs=outputs, specular_antialiasing=on)
    return frame.radiance[..., 0].astype(np.float64)


def color(scene, camera, on):
    with Renderer((SIDE, SIDE)) as renderer:
        return renderer.render(scene, camera, specular_antialiasing=on).color


@pytest.mark.parametrize("roughness", [0.2, 0.3, 0.5])
def test_bumps_that_are_finer_than_pixels_show_their_mean(roughness):
    scene, camera = lit(bumpy(roughness), 4.0, 0.3)
    large = light(scene, camera, False, SIDE * TIMES)
    truth = large.reshape(SIDE, TIMES, SIDE, TIMES).mean(axis=(1, 3))
    with_, without = (light(scene, camera, on) for on in (True, False))
    assert abs(with_.mean() / truth.mean() - 1) < 0.05
    assert abs(without.mean() / truth.mean() - 1) > 0.4
    assert np.square(with_ - truth).mean() < 0.1 * np.square(without - truth).mean()


def test_a_curved_mesh_flickers_less():
    """The light of a far ball hardly depends on where pixels lie."""
    sums = {True: [], False: []}
    for shift in np.linspace(0.0, 0.2, 9):  # up to a pixel
        scene, (camera, pose) = lit(ball(), 20.0)
        pose = pose.copy()
        pose[0, 3] += shift
        for on, found in sums.items():
            found.append(light(scene, (camera, pose), on).sum())
    spread = {on: np.std(found) / np.mean(found) for on, found in sums.items()}
    assert spread[True] < 0.4 * spread[False]


@pytest.mark.parametrize("distance", [5.0, 8.0])
def test_what_is_dark_beside_a_highlight_stays_dark(distance):
    """R217: a wider lobe doesn't have the tails of a rougher one, which show from afar."""
    scene, camera = lit(ball(), distance)
    large = light(scene, camera, False, SIDE * TIMES)
    truth = large.reshape(SIDE, TIMES, SIDE, TIMES).mean(axis=(1, 3))
    shown = {on: np.minimum(light(scene, camera, on), 1.0) for on in (True, False)}
    error = {on: np.square(one - np.minimum(truth, 1.0)).mean() for on, one in shown.items()}
    assert error[True] < 0.3 * error[False]


def test_the_curvature_under_a_normal_map_does_not_count():
    """R193: the map of a mesh that was baked takes it back."""
    flat = e3d.Texture(np.full((4, 4, 4), (128, 128, 255, 255), np.uint8))
    mesh = e3d.uv_sphere(0.5)
    pictures = {}
    for texture in (None, flat):
        mesh.materials = [shiny(normal_texture=texture)]
        scene, camera = lit(mesh, 8.0)
        pictures[texture] = [light(scene, camera, on) for on in (True, False)]
    assert np.array_equal(*pictures[flat])
    assert not np.array_equal(*pictures[None])


def test_flat_faces_and_level_0_of_a_normal_map_are_as_they_are():
    """No normal differs within a pixel of them, by R191 and R192."""
    near = bumpy()
    near.uvs = near.uvs * np.float32(0.02)
    flat = e3d.icosphere(0.3, 1)
    flat.materials = [shiny(flat_shading=True)]
    for mesh in (near, flat):
        scene, camera = lit(mesh, 2.5)
        assert light(scene, camera, True).any()
        assert np.array_equal(light(scene, camera, True), light(scene, camera, False))


def test_a_flat_normal_map_changes_nothing_from_afar():
    """R192: normals that are too short by rounding are no spread."""
    pixels = np.full((256, 256, 4), (128, 128, 252, 255), np.uint8)
    mesh = e3d.plane(2.0)
    mesh.materials = [shiny(normal_texture=e3d.Texture(pixels, filter="trilinear"))]
    scene, camera = lit(mesh, 12.0, 0.2)
    assert light(scene, camera, True).any()
    assert np.array_equal(light(scene, camera, True), light(scene, camera, False))


def test_only_colours_change():
    scene, camera = lit(bumpy(), 8.0)
    outputs = ("metallic_roughness", "world_normal", "albedo")
    with Renderer((SIDE, SIDE)) as renderer:
        first, second = (
            renderer.render(scene, camera, outputs=outputs, specular_antialiasing=on)
            for on in (True, False)
        )
        for name in outputs:
            assert np.array_equal(getattr(first, name), getattr(second, name))


def test_all_backends_agree():
    pictures = []
    for backend in ("scalar", *e3d.backends()):
        scene, camera = lit(bumpy(), 5.0, 0.6, 0.3)
        ball_ = ball()
        ball_.materials = [shiny(clearcoat=1.0, clearcoat_normal_texture=bumps(64, 3))]
        scene.add(ball_, translation=(0, 0, 0.6))
        with Renderer((SIDE, SIDE), backend=backend) as renderer:
            pictures.append(renderer.render(scene, camera).color)
    assert all(np.array_equal(pictures[0], other) for other in pictures[1:])
