"""Hemisphere lights and light probes: their arguments, and what they add, against integrals."""

import numpy as np
import pytest
from plain_picture import Renderer

import engine3d as e3d
from engine3d import linalg

CAMERA = (e3d.OrthographicCamera(0.6), e3d.look_at((0, 0, 3), (0, 0, 0)))


def shown(lights, material=None, color_space="linear", **scene_options):
    """Normals of a ball, and what it shows: linear floats from 8 bits."""
    scene = e3d.Scene(**{"ambient": (0, 0, 0), **scene_options})
    ball = e3d.uv_sphere(0.5, (64, 32))
    ball.materials = [material or e3d.Material()]
    scene.add(ball)
    for light, pose in lights:
        scene.add(light, pose=pose)
    with Renderer((64, 64), color_space=color_space) as renderer:
        frame = renderer.render(scene, CAMERA, outputs=("color", "world_normal", "object_id"))
    inside = frame.object_id >= 0
    return frame.world_normal[inside].astype(float), frame.color[inside][:, :3] / 255.0


def harmonics(d):
    """Real spherical harmonics of degrees 0, 1 and 2 along directions, in three.js's order."""
    x, y, z = d.T
    return np.stack(
        [
            np.full(len(d), 0.28209479177),
            *(0.48860251190 * axis for axis in (y, z, x)),
            *(1.09254843059 * p for p in (x * y, y * z)),
            0.31539156525 * (3 * z * z - 1),
            1.09254843059 * x * z,
            0.54627421529 * (x * x - y * y),
        ]
    )


def irradiance(normals, coefficients, count=20_000):
    """Irradiance / pi by a sum over directions that are spread evenly."""
    k = np.arange(count) + 0.5
    up, angle = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    side = np.sqrt(1 - up * up)
    d = np.stack([side * np.cos(angle), side * np.sin(angle), up], axis=1)
    radiance = harmonics(d).T @ coefficients
    return np.maximum(normals @ d.T, 0) @ radiance * 4 / count


@pytest.mark.parametrize("physical", [False, True])
def test_a_hemisphere_light_blends_from_ground_to_sky(physical):
    material = e3d.Material(metallic=0.0, roughness=1.0, specular_intensity=0.0)
    sky, ground = np.array([0.2, 0.5, 0.9]), np.array([0.6, 0.3, 0.1])
    light = e3d.HemisphereLight(sky, ground, 0.9)
    normals, color = shown([(light, None)], material if physical else None)
    share = (normals[:, 1:2] + 1) / 2
    expected = 0.9 * (sky * share + ground * (1 - share))
    assert np.abs(color - expected).max() < (0.02 if physical else 0.0025)


def test_its_node_turns_it():
    light = e3d.HemisphereLight((1, 1, 1), (0, 0, 0))
    pose = linalg.rotation_z(np.pi / 2) @ np.diag([3.0, 0.2, 1.0, 1.0])
    normals, color = shown([(light, pose)])
    assert np.abs(color[:, 0] - (1 - normals[:, 0]) / 2).max() < 0.0025


def test_any_number_add_up_with_ambient():
    up, down = (
        e3d.HemisphereLight(e3d.linear(0.5, 0, 0), (0, 0, 0)),
        e3d.HemisphereLight((0, 0, 0), e3d.linear(0.5, 0, 0)),
    )
    _, color = shown([(up, None), (down, None)], ambient=e3d.linear(0.25, 0.1, 0.0))
    assert np.abs(color - (0.75, 0.1, 0.0)).max() < 0.0025


def test_eight_bit_colours_are_decoded():
    light = e3d.HemisphereLight((188, 188, 188), (188, 188, 188))
    assert np.abs(shown([(light, None)], color_space="srgb")[1] * 255 - 188).max() <= 1


def test_a_probe_is_the_integral_of_its_radiance():
    random = np.random.default_rng(3)
    numbers = random.normal(0, 0.12, (9, 3))
    numbers[0] = 1.4
    normals, color = shown([(e3d.LightProbe(numbers), None)])
    assert np.abs(color - irradiance(normals, numbers).clip(0, 1)).max() < 0.004


def test_a_probe_is_turned_by_its_node():
    random = np.random.default_rng(5)
    numbers = random.normal(0, 0.12, (9, 3))
    numbers[0] = 1.4
    turn = linalg.rotation_x(0.7) @ linalg.rotation_y(-1.2)
    normals, color = shown([(e3d.LightProbe(numbers, 0.5), turn)])
    expected = 0.5 * irradiance(normals @ turn[:3, :3], numbers)
    assert np.abs(color - expected.clip(0, 1)).max() < 0.004


def test_light_is_never_less_than_none():
    numbers = np.zeros((9, 3))
    numbers[1] = 2.0
    normals, color = shown([(e3d.LightProbe(numbers), None)])
    assert (color[normals[:, 1] < -0.05] == 0).all() and (color[normals[:, 1] > 0.1] > 0).all()


def test_metals_mirror_it():
    metal = e3d.Material(metallic=1.0, roughness=0.05)
    light = e3d.HemisphereLight((1, 1, 1), (0, 0, 0))
    normals, color = shown([(light, None)], metal)
    mirrored = 2 * normals * normals[:, 2:3] - (0, 0, 1)
    expected = (mirrored[:, 1] + 1) / 2
    facing = normals[:, 2] > 0.3
    assert np.abs(color[:, 0] - expected)[facing].max() < 0.03


def test_hidden_ones_add_nothing_and_changes_show():
    scene = e3d.Scene(ambient=(0, 0, 0))
    scene.add(e3d.uv_sphere(0.5))
    light = e3d.HemisphereLight((1, 1, 1), (1, 1, 1), 0.5)
    node = scene.add(light)
    with Renderer((16, 16), color_space="linear") as renderer:

        def middle():
            return int(renderer.render(scene, CAMERA).color[8, 8, 0])

        assert middle() == 128
        light.intensity = 0.25
        assert middle() == 64
        node.visible = False
        assert middle() == 0  # no headlight: the scene has a light
        node.visible = True
        assert middle() == 64
        scene.remove(node)
        assert middle() >= 254  # the headlight
        assert renderer.render(scene, CAMERA).stats["lights"] == 1


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: e3d.HemisphereLight(intensity=-1), "intensity"),
        (lambda: e3d.HemisphereLight(sky_color=(1, 2)), "sky_color"),
        (lambda: e3d.LightProbe(np.ones((8, 3))), "coefficients must have shape"),
        (lambda: e3d.LightProbe(np.full((9, 3), np.nan)), "coefficients"),
        (lambda: e3d.LightProbe(np.ones((9, 3)), -1), "intensity"),
    ],
)
def test_wrong_arguments_are_refused(make, message):
    with pytest.raises(e3d.InvalidArgumentError, match=message):
        make()


def test_lights_have_no_place():
    with pytest.raises(TypeError, match=r"scene.add\(light, translation"):
        e3d.LightProbe(np.ones((9, 3)), position=(0, 0, 0))


def test_scene_files_keep_them(tmp_path):
    scene = e3d.Scene()
    numbers = np.arange(27.0).reshape(9, 3) / 9
    scene.add(e3d.LightProbe(numbers, 0.5), name="probe")
    scene.add(e3d.HemisphereLight(e3d.linear(0.1, 0.2, 0.3), (10, 20, 30), 2.0), name="sky")
    path = tmp_path / "scene.json"
    e3d.save_scene(scene, path)
    back = e3d.load_scene(path)
    probe, sky = back.find("probe").object, back.find("sky").object
    assert np.array_equal(probe.coefficients, numbers) and probe.intensity == 0.5
    assert (sky.sky_color, sky.ground_color, sky.intensity) == (
        e3d.linear(0.1, 0.2, 0.3),
        (10, 20, 30),
        2.0,
    )
