"""A city at dusk: street lamps that light what is round the viewer, and cars that drive.

Of the many lamps only the nearest shine: a fixed number of lights moves along with the viewer.
"""

from __future__ import annotations

import functools
import math

import numpy as np

from .. import linalg
from ..display.subject import Subject
from ..lights import DirectionalLight, PointLight
from ..navigation import NavigationGrid, Walker
from ..primitives import box
from ..scene import Scene
from ..worlds import World
from ..worlds import city as make_city
from ..worlds.furniture import CARS, car
from ..worlds.plan import PITCH

TRIANGLES = 500_000
BACKGROUND = (78, 96, 138)
PERIOD = 60.0
#: Lights that shine at a time: one for each car, the others for lamps.
LIGHTS = 256
CAR_LIGHTS = 40
LAMP = {"color": (1.0, 0.74, 0.42), "intensity": 1.5, "range": 17.0, "falloff": "window"}
HEADLIGHT = {"color": (0.95, 0.95, 1.0), "intensity": 1.2, "range": 14.0, "falloff": "window"}
#: Metres of street that a car drives before it starts again, at most.
DRIVE = 600.0
#: The streets along Z that they drive on, counted from the middle, and how far beside its middle.
STREETS = (-3, -2, -1, 0, 1)
LANE = 2.4
VIEW_RADIUS = 150.0
#: Where one starts to walk, and where one looks: yaw and pitch.
START = (7.2, 62.0)
GAZE = (0.14, 0.02)
#: How far the ground is known around one who walks: the rest is found on the way.
WALK_RADIUS = 160.0
NEAREST = 0.1


def city(triangles: int | None = None) -> Subject:
    """Return a city of about as many triangles, half a million if left out."""
    town = make_city(TRIANGLES if triangles is None else triangles)
    scene = Scene(BACKGROUND, ambient=(0.11, 0.13, 0.20))
    town.add_to(scene)
    scene.add(DirectionalLight((-0.55, -0.55, -0.45), (0.62, 0.66, 0.92), 0.42))
    scene.add(DirectionalLight((0.7, -0.25, 0.5), (1.0, 0.62, 0.45), 0.16))
    lamps = _Lamps(scene, town.lamps, LIGHTS - CAR_LIGHTS)
    traffic = _Traffic(scene, town)
    traffic.drive(0.0)
    lamps.follow(np.zeros(3))
    size = (2.0 * VIEW_RADIUS, 40.0, 2.0 * VIEW_RADIUS)
    return Subject(
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


class _Lamps:
    """A fixed number of lights, put to the lamps that are nearest to the viewer."""

    def __init__(self, scene: Scene, lamps: np.ndarray, count: int) -> None:
        self._lamps = lamps
        self._nodes = [scene.add(PointLight(**LAMP)) for _ in range(min(count, len(lamps)))]
        self._shining: list[int] = []

    def follow(self, eye: np.ndarray) -> None:
        """Let the lamps nearest to ``eye`` shine."""
        offsets = self._lamps - eye
        order = np.argsort(linalg.dot(offsets, offsets), kind="stable")
        # In the lamps' own order: what shines is a function of the eye alone, not of its way there.
        shining = np.sort(order[: len(self._nodes)]).tolist()
        if shining != self._shining:
            self._shining = shining
            for node, lamp in zip(self._nodes, shining, strict=True):
                node.translation = self._lamps[lamp]


class _Traffic:
    """Cars that drive along the streets, each with a light before it."""

    def __init__(self, scene: Scene, town: World) -> None:
        x, _, z = town.lamps.T
        self._length = max(min(DRIVE, float(z.max() - z.min())) - 20.0, PITCH)
        streets = [PITCH * number for number in STREETS]
        self._streets = [street for street in streets if x.min() < street + PITCH / 2 < x.max()]
        meshes = [car(name, town.materials) for name in CARS]
        self._cars = []
        for number in range(CAR_LIGHTS):
            node = scene.add(meshes[number % len(meshes)])
            scene.add(PointLight(**HEADLIGHT), parent=node, translation=(0.0, 1.0, 3.4))
            self._cars.append(node)

    def drive(self, time: float) -> None:
        """Put each car where it is at a time; right-hand traffic on streets along Z."""
        for number, node in enumerate(self._cars):
            street = self._streets[number // 2 % len(self._streets)]
            way = 1.0 if number % 2 else -1.0
            start = number * 0.618 % 1.0
            laps = 1 + number % 2
            along = ((start + laps * time / PERIOD) % 1.0 - 0.5) * self._length
            node.pose = _pose(street - LANE * way, along * way, way)


def _pose(x: float, z: float, way: float) -> np.ndarray:
    """A car's pose: its front to +Z, or turned round."""
    return np.array(
        [[way, 0.0, 0.0, x], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, way, z], [0.0, 0.0, 0.0, 1.0]]
    )
