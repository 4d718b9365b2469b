"""Sun, Earth and Moon, each turning about its parent, among stars.

Distances and sizes are chosen to be seen; the periods are those of nature, a day being two thirds
of a second: a month has 27 turns of the Earth, the scene repeats after one month.
"""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import numpy as np

from ...base import linalg
from ...io.loaders import load_texture
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ...model.primitives import uv_sphere
from ...model.scene.animation import Animator
from ...model.scene.lights import WHITE_INTENSITY, PointLight
from ...model.scene.scene import Scene
from ...stage.viewed_scene import ViewedScene

BACKGROUND = (4, 5, 10)
MONTH = 18.0  # seconds
DAYS = 27
EARTH_ORBIT, MOON_ORBIT = 3.4, 0.95
SUN_RADIUS, EARTH_RADIUS, MOON_RADIUS = 1.0, 0.42, 0.14
EARTH_TILT = 0.41
STARS, STAR_DISTANCE = 900, 60.0
GLOW = (1.0, 0.30, 0.03), (1.0, 0.72, 0.30)  # linear: its darkest and brightest places
GLOWS = 12
CRATERS = 160
MOON_SIZE = 256, 128


def solar() -> ViewedScene:
    """Return the scene."""
    scene = Scene(BACKGROUND, ambient=linear(0.03, 0.03, 0.04))
    scene.add(_stars(), name="stars")
    animator = scene.animator = Animator(scene)
    sun = scene.add(_sun(), name="Sun")
    shine = WHITE_INTENSITY * EARTH_ORBIT**2
    scene.add(PointLight(color=linear(1.0, 0.95, 0.86), intensity=shine), parent=sun)
    year = scene.add(name="year")
    place = scene.add(parent=year, translation=(EARTH_ORBIT, 0, 0))
    axis = scene.add(
        parent=place, rotation=linalg.quaternion_from_axis_angle((0, 0, 1), EARTH_TILT)
    )
    earth = scene.add(_earth(), name="Earth", parent=axis)
    month = scene.add(name="month", parent=place)
    scene.add(_moon(), name="Moon", parent=month, translation=(MOON_ORBIT, 0, 0))
    animator.spin(sun, period=MONTH)
    animator.spin(year, period=MONTH, phase=0.6)  # the real year is 13 times as long
    animator.spin(earth, period=MONTH / DAYS)
    animator.spin(
        month, period=MONTH / 2, phase=0.3
    )  # twice, for the Moon to complete its turn against the year
    animator.seek(0.0)
    reach = EARTH_ORBIT + MOON_ORBIT
    return ViewedScene(
        scene,
        "solar",
        update=animator.seek,
        period=MONTH,
        plays=True,
        azimuth=3.2,  # first shows the day side of the Earth
        elevation=0.45,
        focus=np.array(
            [
                (x, y, z)
                for x in (-reach, reach)
                for y in (-SUN_RADIUS, SUN_RADIUS)
                for z in (-reach, reach)
            ]
        ),
        appearance={"point_size": 2.0},
    )


def _sun() -> Mesh:
    """Return a ball that glows unevenly."""
    ball = uv_sphere(SUN_RADIUS, (128, 64))
    middles = ball.positions[ball.faces].mean(axis=1, dtype=np.float64)
    waves = np.zeros(len(middles))
    for direction in _directions(24, seed=3):
        waves = waves + linalg.sin(9.0 * linalg.dot(middles, direction) + 20.0 * direction[0])
    shade = np.clip((waves * 0.12 + 0.5) * GLOWS, 0, GLOWS - 1)
    glows = np.linspace(*GLOW, GLOWS).tolist()
    ball.materials = [Material(color=linear(glow), unlit=True) for glow in glows]
    ball.material_ids = shade.astype(np.int32)
    return ball


def _earth() -> Mesh:
    ball = uv_sphere(EARTH_RADIUS, (64, 32))
    texture = load_texture(Path(str(files("engine3d.data"))) / "models" / "globe.webp")
    ball.materials = [Material(texture=texture)]
    return ball


def _moon() -> Mesh:
    ball = uv_sphere(MOON_RADIUS, (48, 24))
    ball.materials = [Material(texture=Texture(_craters(), name="moon"))]
    return ball


def _craters() -> np.ndarray:
    """Return grey ground with craters of all sizes, bright at their rims: (H, W, 3) uint8."""
    width, height = MOON_SIZE
    around = 2.0 * np.pi * (np.arange(width) + 0.5) / width
    down = np.pi * (np.arange(height) + 0.5) / height
    ring = linalg.sin(down)[:, np.newaxis]
    up = np.broadcast_to(linalg.cos(down)[:, np.newaxis], (height, width))
    points = np.stack([ring * linalg.cos(around), up, ring * linalg.sin(around)], axis=-1)
    grey = np.full((height, width), 150.0)
    radii = np.random.default_rng(5).uniform(0.02, 0.08, CRATERS) ** 2 * 40
    for direction, radius in zip(_directions(CRATERS, seed=4), radii, strict=True):
        distance = linalg.length(points - direction) / radius
        grey = np.where(distance < 1.0, grey * 0.88, grey)
        grey = np.where(np.abs(distance - 1.0) < 0.18, grey + 14.0, grey)
    return np.repeat(np.clip(grey, 60, 225).astype(np.uint8)[:, :, np.newaxis], 3, axis=2)


def _stars() -> Mesh:
    directions = _directions(STARS, seed=1)
    colors = np.random.default_rng(2).integers(70, 235, (STARS, 1), np.uint8)
    return Mesh(
        directions * STAR_DISTANCE, points=np.arange(STARS), colors=np.repeat(colors, 3, axis=1)
    )


def _directions(count: int, seed: int) -> np.ndarray:
    """Return unit vectors in random order, (count, 3), from points in the unit ball."""
    points = np.random.default_rng(seed).uniform(-1.0, 1.0, (4 * count, 3))
    square = linalg.dot(points, points)
    return linalg.normalize(points[(square < 1.0) & (square > 0.01)][:count])
