"""A city with sun and sky, and cars that drive; at dusk, with street lamps and lit windows."""

from __future__ import annotations

import functools
import math

import numpy as np

from ...extras.worlds import World
from ...extras.worlds import city as make_city
from ...model.materials.linear_colors import linear
from ...model.navigation import NavigationGrid, Walker
from ...model.primitives import box
from ...model.scene.lights import WHITE_INTENSITY, DirectionalLight
from ...model.scene.scene import Scene
from ...stage.viewed_scene import ViewedScene
from .city_lights import CARS_AT_LEAST, LIGHTS, PERIOD, Lamps, Traffic
from .city_sky import DAY, DUSK, sky
from .skyline import Skyline

TRIANGLES = 500_000
VIEW_RADIUS = 150.0
#: Anything higher counts as a tower, whose top the first view must show.
TOWER = 60.0
#: Directions of the sun's light, by day and at dusk.
SUN, LOW_SUN = (-0.55, -0.62, -0.42), (0.70, -0.20, 0.50)
#: Texels per side of the sun's shadow maps: few enough for 30 frames a second while walking.
SUN_MAPS = 512
#: Brightness factor of lit windows at dusk.
LIT = 2.4
#: The start of a walk, and the first view direction: yaw and pitch.
START = (7.2, 62.0)
GAZE = (0.14, 0.02)
#: Radius of the known ground around a walker; the rest is found on the way.
WALK_RADIUS = 160.0
NEAREST = 0.1


def city(triangles: int | None = None, *, dusk: bool = False) -> ViewedScene:
    """Return a city of about as many triangles; by default half a million.

    Parameters
    ----------
    triangles : int, optional
    dusk : bool
        Whether the sun is about to set, and lamps and windows shine.
    """
    town = make_city(TRIANGLES if triangles is None else triangles)
    scene = Scene()
    town.add_to(scene)
    (_dusk if dusk else _day)(scene, town)
    lamps = Lamps(scene, town.lamps if dusk else town.lamps[:0])
    traffic = Traffic(scene, town, max(CARS_AT_LEAST, LIGHTS - lamps.count) if dusk else 0)
    traffic.drive(0.0)
    lamps.follow(np.zeros(3))
    return ViewedScene(
        scene,
        "city",
        azimuth=math.radians(32.0),
        elevation=math.radians(24.0),
        update=traffic.drive,
        period=PERIOD,
        follow=lamps.follow if dusk else None,
        walker=functools.cache(lambda: _walker(town)),
        gaze=GAZE,
        nearest=NEAREST,
        clearance=Skyline(town.districts).clearance,
        focus=_focus(town),
    )


def _day(scene: Scene, town: World) -> None:
    """Light a city by day: with the sun and the sky."""
    scene.background = sky(DAY, np.negative(SUN))
    scene.ambient = linear(0.30, 0.36, 0.46)
    scene.add(_sun(SUN, linear(1.0, 0.93, 0.80), 0.85 * WHITE_INTENSITY), name="sun")


def _dusk(scene: Scene, town: World) -> None:
    """Light a city at dusk: with the low sun and blue sky, and brighter lit windows."""
    scene.background = sky(DUSK, np.negative(LOW_SUN))
    scene.ambient = linear(0.11, 0.13, 0.20)
    scene.add(
        DirectionalLight((-0.55, -0.55, -0.45), linear(0.62, 0.66, 0.92), 0.36 * WHITE_INTENSITY),
        name="sky",
    )
    scene.add(_sun(LOW_SUN, linear(1.0, 0.55, 0.34), 0.30 * WHITE_INTENSITY), name="sun")
    for material in town.materials:
        if material.name.endswith("lit"):
            material.emissive = linear([LIT * component for component in material.emissive])


def _sun(direction: tuple, color: tuple, intensity: float) -> DirectionalLight:
    return DirectionalLight(
        direction, color, intensity, shadow="map", shadow_map_size=SUN_MAPS, shadow_cascades=4
    )


def _focus(town: World) -> np.ndarray:
    """Return the points of the first view: the city centre, and the tops of towers."""
    size = (2.0 * VIEW_RADIUS, 40.0, 2.0 * VIEW_RADIUS)
    middle = box(size).positions.astype(np.float64) + np.array((-30.0, 10.0, -30.0))
    tops = [mesh.positions[mesh.positions[:, 1].argmax()] for mesh in town.districts]
    towers = [top.astype(np.float64) for top in tops if top[1] > TOWER and _is_near(top)]
    return np.concatenate([middle, *(tower[np.newaxis] for tower in towers)])


def _is_near(point: np.ndarray) -> bool:
    return bool(max(abs(point[0]), abs(point[2])) < 3.0 * VIEW_RADIUS)


def _walker(town: World) -> Walker:
    """Return a walker for the whole city, on the ground nearby."""
    boxes = np.stack([mesh.bounds for mesh in town.districts])[:, :, [0, 2]]
    kinds = {"walkable": town.walkable, "ignore": town.foliage}

    def survey(x: float, z: float) -> NavigationGrid:
        middle = np.rint((x, z))  # aligns the cells of all grids
        low, high = middle - WALK_RADIUS, middle + WALK_RADIUS
        near = ((boxes[:, 0] <= high) & (boxes[:, 1] >= low)).all(axis=1)
        meshes = [town.districts[number] for number in np.flatnonzero(near)]
        return NavigationGrid(meshes, bounds=(low, high), **kinds)

    return Walker(survey(*START), *START, survey=survey)
