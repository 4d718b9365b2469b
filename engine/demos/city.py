"""A city at dusk: street lamps that light what is round the viewer, and cars that drive."""

from __future__ import annotations

import functools
import math

import numpy as np

from ..navigation import NavigationGrid, Walker
from ..primitives import box
from ..scene.lights import DirectionalLight
from ..scene.scene import Scene
from ..viewer.viewed_scene import ViewedScene
from ..worlds import World
from ..worlds import city as make_city
from .city_lights import LIGHTS, PERIOD, Lamps, Traffic
from .skyline import Skyline

TRIANGLES = 500_000
BACKGROUND = (78, 96, 138)
VIEW_RADIUS = 150.0
#: Where one starts to walk, and where one looks: yaw and pitch.
START = (7.2, 62.0)
GAZE = (0.14, 0.02)
#: How far the ground is known around one who walks: the rest is found on the way.
WALK_RADIUS = 160.0
NEAREST = 0.1


def city(triangles: int | None = None) -> ViewedScene:
    """Return a city of about as many triangles, half a million if left out."""
    town = make_city(TRIANGLES if triangles is None else triangles)
    scene = Scene(BACKGROUND, ambient=(0.11, 0.13, 0.20))
    town.add_to(scene)
    scene.add(DirectionalLight((-0.55, -0.55, -0.45), (0.62, 0.66, 0.92), 0.42))
    scene.add(DirectionalLight((0.7, -0.25, 0.5), (1.0, 0.62, 0.45), 0.16))
    lamps = Lamps(scene, town.lamps)
    traffic = Traffic(scene, town, LIGHTS - lamps.count)
    traffic.drive(0.0)
    lamps.follow(np.zeros(3))
    size = (2.0 * VIEW_RADIUS, 40.0, 2.0 * VIEW_RADIUS)
    return ViewedScene(
        scene,
        "city",
        azimuth=math.radians(32.0),
        elevation=math.radians(24.0),
        update=traffic.drive,
        period=PERIOD,
        follow=lamps.follow,
        walker=functools.cache(lambda: _walker(town)),
        gaze=GAZE,
        nearest=NEAREST,
        clearance=Skyline(town.districts).clearance,
        focus=box(size).positions.astype(np.float64) + np.array((-30.0, 10.0, -30.0)),
    )


def _walker(town: World) -> Walker:
    """Who walks in the city: all over it, on the ground near by."""
    boxes = np.stack([mesh.bounds for mesh in town.districts])[:, :, [0, 2]]
    kinds = {"walkable": town.walkable, "ignore": town.foliage}

    def survey(x: float, z: float) -> NavigationGrid:
        middle = np.rint((x, z))  # cells lie the same in all grids
        low, high = middle - WALK_RADIUS, middle + WALK_RADIUS
        near = ((boxes[:, 0] <= high) & (boxes[:, 1] >= low)).all(axis=1)
        meshes = [town.districts[number] for number in np.flatnonzero(near)]
        return NavigationGrid(meshes, bounds=(low, high), **kinds)

    return Walker(survey(*START), *START, survey=survey)
