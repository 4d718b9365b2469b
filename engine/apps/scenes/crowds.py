"""Large crowds: instanced spheres, levels of detail, and distinct parcels of land.

Each shows one way to draw many: one mesh at many poses, the coarsest mesh that nobody can tell from
the finest, and different meshes that stand still, joined block by block.
"""

from __future__ import annotations

import numpy as np

from ...base import linalg
from ...extras.lod import DetailedInstances
from ...model.geometry.mesh import Mesh
from ...model.materials.linear_colors import linear
from ...model.materials.material import Material
from ...model.primitives import box, icosphere
from ...model.scene.lights import DirectionalLight
from ...model.scene.scene import Scene
from ...stage.viewed_scene import ViewedScene
from .workloads import make

BACKGROUND = (26, 31, 38)
SUN_DIRECTION, SUN_COLOR = (-0.4, -0.7, -0.6), linear(0.8, 0.8, 0.8)
AMBIENT = linear(0.2, 0.2, 0.2)
#: Balls with levels of detail: count per side, spacing, subdivisions of each level, and its colour.
BALLS_SIDE, BALLS_APART = 60, 3.0
LEVELS = (5, 4, 3, 2, 1)
LEVEL_COLORS = ((235, 90, 80), (240, 170, 70), (230, 220, 90), (110, 200, 110), (100, 150, 235))
#: The points of the first view: the nearest balls in front.
NEAR_BALLS = (14.0, 2.0, 8.0)
#: Parcels of land: count per side, spacing, and maximum size.
PARCELS_SIDE, PARCELS_APART, PARCEL = 40, 12.0, 11.0
#: Parcels per side of a block.
BLOCK_SIDE = 8
PARCEL_COLORS = {"grass": (96, 128, 74), "wall": (200, 190, 170), "roof": (150, 70, 52)}
#: A parcel in its own units: land, walls and a roof with eaves, in outward-facing quads.
LAND = np.array([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)]) / 2
WALLS = np.array([(x, y, z) for y in (0, 1) for x, z in LAND[:, [0, 2]]])
ROOF = np.array([*((1.1 * x, 1, 1.1 * z) for x, z in LAND[:, [0, 2]]), (0, 1.5, 0)])
#: The fraction of parcels with a house.
BUILT = 0.8
LAND_FACES = [(0, 1, 2), (0, 2, 3)]
_SIDES = [(k, (k + 1) % 4) for k in range(4)]
WALL_FACES = [face for k, n in _SIDES for face in ((k, n, k + 4), (n, n + 4, k + 4))]
ROOF_FACES = [(k, n, 4) for k, n in _SIDES]


def spheres() -> ViewedScene:
    """Return 39,304 spheres: 34 a side of a cube, one mesh at as many poses."""
    return ViewedScene(make("spheres").scene, "spheres", elevation=0.5, azimuth=0.65)


def lod() -> ViewedScene:
    """Return 3,600 balls, coloured by the level of detail in which each is drawn."""
    places = (np.arange(BALLS_SIDE) - (BALLS_SIDE - 1) / 2) * BALLS_APART
    x, z = (part.ravel() for part in np.meshgrid(places, places))
    poses = np.column_stack([x, np.zeros_like(x), z, np.ones_like(x)]).astype(np.float32)
    levels = [_ball(*level) for level in zip(LEVELS, LEVEL_COLORS, strict=True)]
    balls = DetailedInstances(levels, poses)
    scene = _scene()
    balls.add_to(scene, name="balls")
    focus = box(NEAR_BALLS).positions + np.float32([0, 0, places[-1] - NEAR_BALLS[2] / 2])
    return ViewedScene(scene, "lod", azimuth=0.1, elevation=0.2, focus=focus, detail=balls.update)


def _ball(subdivisions: int, color) -> tuple[Mesh, float]:
    """Return a ball, and its faces' deviation from the finest one's."""
    mesh = icosphere(1.0, subdivisions)
    mesh.materials = [Material(color=color, name=f"{len(mesh.faces)} triangles")]
    middles = mesh.positions[mesh.faces].mean(axis=1, dtype=np.float64)
    finest = subdivisions == LEVELS[0]
    return mesh, 0.0 if finest else 1.0 - float(linalg.length(middles).min())


def parcels() -> ViewedScene:
    """Return 1,600 parcels of land, none like another, with one house or none.

    Those of a block are one mesh: they stand still, and one mesh is drawn faster than many small
    ones. Blocks that no camera shows are still left out.
    """
    random = np.random.default_rng(7)
    scene = _scene()
    materials = [Material(color=color, name=name) for name, color in PARCEL_COLORS.items()]
    middle = (PARCELS_SIDE - 1) / 2
    blocks: dict[tuple[int, int], list] = {}
    for number in range(PARCELS_SIDE**2):
        row, column = divmod(number, PARCELS_SIDE)
        place = ((column - middle) * PARCELS_APART, 0.0, (row - middle) * PARCELS_APART)
        block = blocks.setdefault((row // BLOCK_SIDE, column // BLOCK_SIDE), [])
        block.append((_parcel(random, materials), (place, (0.0, 0.0, 0.0, 1.0), 1.0)))
    for (row, column), block in blocks.items():
        meshes, poses = zip(*block, strict=True)
        mesh = Mesh.concatenate(meshes, poses=poses)
        scene.add(mesh, name=f"block {row + 1}.{column + 1}", static=True)
    return ViewedScene(scene, "parcels", elevation=0.5, nearest=0.2)


def _parcel(random, materials) -> Mesh:
    """Return a unique piece of land, with its house if any."""
    across, along = random.uniform(0.8, 1.0, 2) * PARCEL
    parts = [(LAND * (across, 1, along), LAND_FACES)]
    if random.random() < BUILT:
        size = random.uniform((3, 2.5, 3), (7, 9, 7))
        parts += [(WALLS * size, WALL_FACES), (ROOF * size, ROOF_FACES)]
    firsts = np.cumsum([0, *(len(corners) for corners, _ in parts)])
    faces = [np.array(part) + first for (_, part), first in zip(parts, firsts, strict=False)]
    return Mesh(
        np.concatenate([corners for corners, _ in parts]),
        np.concatenate(faces),
        materials=materials,
        material_ids=np.repeat(np.arange(len(parts)), [len(part) for part in faces]),
    )


def _scene() -> Scene:
    scene = Scene(BACKGROUND, ambient=AMBIENT)
    scene.add(DirectionalLight(SUN_DIRECTION, SUN_COLOR))
    return scene
