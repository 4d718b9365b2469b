"""One unit of light: a white matt wall shows the same, whatever its material is."""

import math

import numpy as np
import pytest

import engine3d as e3d

SIZE = (24, 24)
CASES = 12  # of each kind of light
PLAIN = e3d.Material()
PHYSICAL = e3d.Material(metallic=0.0, roughness=1.0, specular_intensity=0.0)


def wall(material, turned, light, **around):
    """A white wall around the origin, its light, and all the rest that shines."""
    scene = e3d.Scene(background=(0, 0, 0), ambient=(0, 0, 0))
    for name, value in around.items():
        setattr(scene, name, value)
    mesh = e3d.primitives.quad((-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0))
    mesh.materials = [material]
    scene.add(mesh, rotation=turned)
    if light is not None:
        scene.add(light, pose=e3d.look_at((0.4, -0.3, 1.6), (0.1, 0, 0)))
    return scene


def shown(scene, backend="auto"):
    camera = e3d.PerspectiveCamera(0.4), e3d.look_at((0, 0, 4), (0, 0, 0))
    with e3d.Renderer(SIZE, look="plain", backend=backend) as renderer:
        return renderer.render(scene, camera).color[..., :3].astype(int)


def some(rng):
    return {"color": tuple(rng.uniform(0, 1, 3)), "intensity": float(rng.uniform(0.5, 4.0))}


def picture(rng):
    return e3d.Environment(rng.uniform(0, 1.2, (8, 16, 3)).astype(np.float32))


def lit(**light):
    return {"light": e3d.DirectionalLight(**light)}


#: By the name of what shines, a function of a random generator.
SHINING = {
    "directional": lambda rng: lit(direction=(*rng.uniform(-0.6, 0.6, 2), -1), **some(rng)),
    "shadows": lambda rng: lit(shadow=["map", "exact"][rng.integers(2)], **some(rng)),
    "point": lambda rng: {"light": e3d.PointLight(**some(rng))},
    "window": lambda rng: {"light": e3d.PointLight(range=5.0, falloff="window", **some(rng))},
    "gltf": lambda rng: {"light": e3d.PointLight(range=5.0, falloff="gltf", **some(rng))},
    "spot": lambda rng: {"light": e3d.SpotLight(range=9.0, inner_cone_angle=0.1, **some(rng))},
    "hemisphere": lambda rng: {"light": e3d.HemisphereLight(*rng.uniform(0, 1, (2, 3)).tolist())},
    "probe": lambda rng: {"light": e3d.LightProbe(rng.uniform(-0.2, 0.5, (9, 3)))},
    "ambient": lambda rng: {"light": None, "ambient": tuple(rng.uniform(0, 1, 3))},
    "headlight": lambda rng: {"light": None},
    "environment": lambda rng: {"light": None, "environment": picture(rng)},
    "all": lambda rng: {
        "environment": picture(rng),
        "environment_rotation": 1.0,
        "ambient": (0.1, 0.2, 0.3),
        **lit(**some(rng)),
    },
}


@pytest.mark.parametrize("kind", SHINING)
def test_a_white_matt_wall_shows_the_same_by_any_material(kind):
    """Within the rounding of a code, where a physical one rounds its terms in another order."""
    rng = np.random.default_rng(list(SHINING).index(kind))
    seen = []
    for case in range(CASES):
        turned = e3d.linalg.quaternion_from_axis_angle(rng.normal(size=3), rng.uniform(0, 0.6))
        how = {"turned": turned, **SHINING[kind](rng)}
        plain = shown(wall(PLAIN, **how))
        assert np.abs(plain - shown(wall(PHYSICAL, **how))).max() <= 1
        seen.append(plain)
        if case == 0:
            for material in (PLAIN, PHYSICAL):
                scene = wall(material, **how)
                drawn = [shown(scene, backend) for backend in e3d.backends()]
                assert all((picture == drawn[0]).all() for picture in drawn)
    assert np.max(seen) > 60


@pytest.mark.parametrize("material", [PLAIN, PHYSICAL])
def test_the_intensity_is_pi_for_white(material):
    facing = (0.0, 0.0, 0.0, 1.0)
    for light in (e3d.DirectionalLight(), e3d.PointLight(), e3d.SpotLight()):
        assert light.intensity == math.pi
        scene = wall(material, facing, None)
        scene.add(light, translation=(0, 0, 1))
        assert shown(scene)[11:13, 11:13].min() >= 254


def test_half_the_light_is_half_as_bright():
    with e3d.Renderer(SIZE, color_space="linear") as renderer:
        scene = wall(PLAIN, (0, 0, 0, 1), None)
        scene.add(e3d.DirectionalLight(intensity=math.pi / 2))
        camera = e3d.OrthographicCamera(1.0), e3d.look_at((0, 0, 4), (0, 0, 0))
        assert (renderer.render(scene, camera).color[..., :3] == 128).all()


def test_a_highlight_takes_the_same_unit():
    shiny = e3d.Material(color=(0, 0, 0), specular=(0.5, 0.5, 0.5), shininess=1.0)
    scene = wall(shiny, (0, 0, 0, 1), None)
    scene.add(e3d.DirectionalLight())
    camera = e3d.OrthographicCamera(1.0), e3d.look_at((0, 0, 4), (0, 0, 0))
    with e3d.Renderer(SIZE, color_space="linear") as renderer:
        assert np.abs(renderer.render(scene, camera).color[..., :3].astype(int) - 128).max() <= 1
