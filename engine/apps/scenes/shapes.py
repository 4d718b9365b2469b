"""A lit sphere and box on a plane, and three coloured lights that circle above them.

Small glowing spheres mark the lights.
"""

from __future__ import annotations

import math

import numpy as np

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.primitives import box, icosphere, plane, uv_sphere
from ...model.scene.lights import WHITE_INTENSITY, DirectionalLight, PointLight
from ...model.scene.scene import Scene
from ...stage.viewed_scene import ViewedScene

BACKGROUND = (14, 16, 22)
PERIOD = 10.0
LIGHT_COLORS = tuple(map(linear, ((1.0, 0.32, 0.18), (0.25, 1.0, 0.38), (0.30, 0.42, 1.0))))
LIGHT_INTENSITY = 3.4 * WHITE_INTENSITY
LIGHT_RADIUS = 1.9
LIGHT_HEIGHT = 1.5
BULB_RADIUS = 0.05
FLOOR_SIZE = 9.0
FLOOR_SQUARES = 18


def shapes(subdivisions: int | None = None) -> ViewedScene:
    """Return the scene.

    Parameters
    ----------
    subdivisions : int, optional
        Into how many parts the sphere's height and the edges of the box and of the floor are cut;
        by default 32 and 1.
    """
    parts = subdivisions or 1
    scene = Scene(BACKGROUND, ambient=linear(0.04, 0.04, 0.05))
    scene.add(floor(FLOOR_SIZE, FLOOR_SQUARES, segments=parts), name="floor")
    bands = subdivisions or 32
    ball = uv_sphere(0.6, (max(2 * bands, 3), max(bands, 2)))
    ball.materials = [glossy(linear(0.9, 0.9, 0.9), 90.0)]
    scene.add(ball, name="sphere", translation=(-0.75, 0.6, 0.15))
    cube = _cut_box(parts)
    cube.materials = [glossy(linear(0.85, 0.82, 0.75), 40.0)]
    turned = linalg.quaternion_from_axis_angle((0, 1, 0), math.radians(28.0))
    scene.add(cube, name="box", translation=(0.8, 0.5, -0.1), rotation=turned)
    scene.add(DirectionalLight((-0.3, -1.0, -0.5), intensity=0.12 * WHITE_INTENSITY))
    lights = [_bulb(scene, color) for color in LIGHT_COLORS]

    def update(time: float) -> None:
        for index, node in enumerate(lights):
            angle = 2 * math.pi * (time / PERIOD + index / len(lights))
            node.translation = (
                LIGHT_RADIUS * math.cos(angle),
                LIGHT_HEIGHT + 0.25 * math.sin(2 * angle),
                LIGHT_RADIUS * math.sin(angle),
            )

    update(0.0)
    return ViewedScene(
        scene,
        "shapes",
        update=update,
        period=PERIOD,
        plays=True,
        azimuth=0.35,
        focus=box((2.9, 1.7, 2.0)).positions + np.array((0.0, 0.75, 0.0)),
    )


def glossy(color, shininess: float) -> Material:
    """Return a material with a white highlight."""
    return Material(color=color, specular=linear(0.5, 0.5, 0.5), shininess=shininess)


def _cut_box(segments: int) -> Mesh:
    """Return a cube with edges of 1, each of its faces cut into squares."""
    if segments == 1:
        return box()
    top = plane(1.0, segments)
    top.positions = top.positions + np.float32((0.0, 0.5, 0.0))
    quarters = [((1, 0, 0), 0), ((1, 0, 0), 1), ((1, 0, 0), 2), ((1, 0, 0), 3)]
    quarters += [((0, 0, 1), 1), ((0, 0, 1), 3)]
    turns = [linalg.quaternion_from_axis_angle(axis, k * math.pi / 2) for axis, k in quarters]
    return Mesh.concatenate([top] * 6, poses=[((0, 0, 0), turn, 1.0) for turn in turns])


def floor(
    size: float, squares: int, dark=(62, 66, 74), light=(118, 122, 130), segments: int = 1
) -> Mesh:
    """Return a square floor at y = 0 with a checkerboard of ``squares`` per side (sRGB colours)."""
    mesh = plane((size, size), segments)
    board = np.array([[dark, light], [light, dark]], dtype=np.uint8)
    mesh.uvs = mesh.uvs * (squares / 2)
    texture = Texture(np.kron(board, np.ones((32, 32, 1), dtype=np.uint8)), name="checkerboard")
    mesh.materials = [Material(texture=texture, specular=linear(0.12, 0.12, 0.12), shininess=24.0)]
    return mesh


def _bulb(scene: Scene, color):
    """Add a point light with a glowing sphere; return the node that moves both."""
    node = scene.add(PointLight(color=color, intensity=LIGHT_INTENSITY))
    bulb = icosphere(BULB_RADIUS, 2)
    bulb.materials = [Material(color=color, unlit=True)]  # it glows in every mode
    scene.add(bulb, parent=node)
    return node
