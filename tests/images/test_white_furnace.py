"""The white furnace: white surfaces in light that is 1 from everywhere show 1.

A file of the corpus has spheres of seven roughnesses, of metal, half of it, and of none. Other
renderers lose a quarter to two thirds of the light of some.
"""

import numpy as np
import pytest
from plain_picture import render
from shared_corpus import GLTF

import engine3d as e3d

FILE = GLTF / "own" / "WhiteFurnaceGrid.glb"
EXPOSURE = -0.1  # stops: so that more than 1 would be seen
SIZE = 560, 240
LEVELS = [0.0, 1 / 6, 1 / 3, 0.5, 2 / 3, 5 / 6, 1.0]


def white(radiance=1.0):
    return e3d.Environment(np.full((8, 16, 3), radiance, np.float32))


def lit(scene, light):
    scene.background = (0, 0, 0)
    scene.exposure = EXPOSURE
    if light == "ambient":
        scene.ambient = (1.0, 1.0, 1.0)
    else:
        scene.environment = white()
        scene.ambient = (0, 0, 0)
    return scene


def radiance_of(scene):
    """(H, W, 3), linear: to 1/500 of what is shown."""
    camera = scene.add(
        e3d.OrthographicCamera(1.5, znear=0.1, zfar=20), pose=e3d.look_at((0, 0, 10), (0, 0, 0))
    )
    frame = render(scene, camera, size=SIZE, color_space="linear")
    return frame.color[..., :3] / 255 / 2**EXPOSURE


def at(radiance, x, y):
    """The mean of what is shown around a place."""
    scale = SIZE[1] / 3.0
    column, row = round(SIZE[0] / 2 + x * scale), round(SIZE[1] / 2 - y * scale)
    return radiance[row - 3 : row + 3, column - 3 : column + 3].mean(axis=(0, 1))


@pytest.mark.skipif(
    not FILE.is_file(), reason="needs the glTF corpus in ../shared (or ENGINE3D_SHARED)"
)
@pytest.mark.parametrize("light", ["ambient", "environment"])
def test_every_sphere_of_the_furnace_grid_shows_all_light(light):
    radiance = radiance_of(lit(e3d.load_scene(FILE), light))
    middles = [at(radiance, x, y) for y in (1, 0, -1) for x in range(-3, 4)]
    assert np.abs(np.array(middles) - 1).max() < 0.01


@pytest.mark.parametrize("light", ["ambient", "environment"])
@pytest.mark.parametrize("metallic", LEVELS)
def test_white_shows_all_light_at_every_angle(metallic, light):
    scene = lit(e3d.Scene(), light)
    for number, roughness in enumerate(LEVELS):
        ball = e3d.uv_sphere(0.45, (96, 48))
        how = {"metallic": metallic, "roughness": roughness}
        ball.materials = [e3d.Material(color=(1.0, 1.0, 1.0), **how)]
        scene.add(ball, translation=(number - 3, 0, 0))
    radiance = radiance_of(scene)
    scale, places = SIZE[1] / 3.0, (0.0, 0.15, 0.3, 0.4, 0.43)
    for number in range(7):
        for place in places:
            shown = radiance[SIZE[1] // 2, round(SIZE[0] / 2 + (number - 3 + place) * scale)]
            assert np.abs(shown - 1).max() < 0.01, (LEVELS[number], place, shown)
