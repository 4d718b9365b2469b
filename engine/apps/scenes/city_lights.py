"""The lights of the city: street lamps around the viewer, and moving cars.

Lamps are lit as far as the viewer can see them: from the street those of the next blocks, from
above all. They fade towards the farthest, so that none visibly switches on or off. Cars carry more
lights if there are few lamps.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ...base import linalg
from ...extras.worlds import World
from ...extras.worlds.furniture import CARS, car
from ...extras.worlds.plan import PITCH
from ...model.materials.linear_colors import linear
from ...model.scene.lights import WHITE_INTENSITY, PointLight
from ...model.scene.scene import Scene


def _shining(color: tuple[float, float, float], intensity: float, reach: float) -> dict[str, Any]:
    """Return the keyword arguments of a `PointLight` with a limited range.

    An intensity of 1 shows white close by.
    """
    strength = intensity * WHITE_INTENSITY
    return {"color": color, "intensity": strength, "range": reach, "falloff": "window"}


#: Minimum number of lights: at least one for each car, the others for lamps.
LIGHTS = 256
CARS_AT_LEAST = 40
#: Maximum number of lit lamps.
MOST_LAMPS = 472
LAMP = _shining(linear(1.0, 0.74, 0.42), 1.5, 17.0)
#: Radius of lit lamps around a walker, and its growth per metre of height.
REACH, REACH_OF_HEIGHT = 205.0, 4.0
#: The fraction of the radius in which lamps fade.
FADE = 0.25
_HEADLIGHT = _shining(linear(0.95, 0.95, 1.0), 1.2, 14.0)
_TAIL_LIGHT = _shining(linear(1.0, 0.08, 0.05), 0.5, 5.0)
_TAXI_SIGN = _shining(linear(1.0, 0.82, 0.35), 0.4, 5.0)
#: A car's lights, in the order of adding, and their positions on it.
_CAR_LIGHTS = (
    (_HEADLIGHT, (0.0, 1.0, 3.4)),
    (_TAIL_LIGHT, (0.6, 0.7, -2.6)),
    (_TAIL_LIGHT, (-0.6, 0.7, -2.6)),
    (_TAXI_SIGN, (0.0, 1.7, -0.2)),
)
#: Seconds after which the cars repeat.
PERIOD = 60.0
#: Maximum distance that a car drives before it restarts, in metres.
DRIVE = 600.0
#: The driven streets along Z, counted from the middle, and the lane's offset.
STREETS = (-3, -2, -1, 0, 1)
LANE = 2.4


class Lamps:
    """Lights that are moved to the lamps around the viewer.

    Parameters
    ----------
    scene : Scene
    lamps : (N, 3) ndarray of float64
        Where lamps are.

    Attributes
    ----------
    count : int
        How many lights there are; those that are dark are hidden.
    """

    def __init__(self, scene: Scene, lamps: np.ndarray) -> None:
        self.count = min(MOST_LAMPS, len(lamps))
        self._lamps = lamps
        self._nodes = [scene.add(PointLight(**LAMP)) for _ in range(self.count)]
        self._shining: list[int] = []

    def follow(self, eye: np.ndarray) -> None:
        """Light the lamps around ``eye``, fading towards the dark ones."""
        # horizontal distance: all lamps are equally high
        offsets = (self._lamps - eye) * (1.0, 0.0, 1.0)
        distances = np.sqrt(linalg.dot(offsets, offsets))
        dark = REACH + REACH_OF_HEIGHT * max(float(eye[1]), 0.0)
        order = np.argsort(distances, kind="stable")
        if self.count < len(self._lamps):
            dark = min(dark, float(distances[order[self.count]]))
        # In the lamps' own order, so that the result depends only on the eye, not on its path.
        nearest = np.sort(order[: self.count])
        shining = nearest.tolist()
        if shining != self._shining:
            self._shining = shining
            for node, lamp in zip(self._nodes, shining, strict=True):
                node.translation = self._lamps[lamp]
        for node, strength in zip(self._nodes, _strengths(distances[nearest], dark), strict=True):
            node.visible = strength > 0.0
            node.object.intensity = strength


def _strengths(distances: np.ndarray, dark: float) -> list[float]:
    """Return intensities that fade smoothly to 0 at the distance of the first dark lamp."""
    share = np.clip((dark - distances) / (FADE * dark), 0.0, 1.0)
    return (LAMP["intensity"] * share * share * (3.0 - 2.0 * share)).tolist()


class Traffic:
    """Cars that drive along the streets with their lights.

    Parameters
    ----------
    scene : Scene
    town : World
    lights : int
        How many lights they carry.
    """

    def __init__(self, scene: Scene, town: World, lights: int) -> None:
        x, _, z = town.lamps.T
        self._length = max(min(DRIVE, float(z.max() - z.min())) - 20.0, PITCH)
        streets = [PITCH * number for number in STREETS]
        self._streets = [street for street in streets if x.min() < street + PITCH / 2 < x.max()]
        meshes = [car(name, town.materials) for name in CARS]
        count = max(CARS_AT_LEAST, -(-lights // len(_CAR_LIGHTS)))
        self._cars = [scene.add(meshes[number % len(meshes)]) for number in range(count)]
        for number in range(lights):
            light, place = _CAR_LIGHTS[number // count]
            scene.add(PointLight(**light), parent=self._cars[number % count], translation=place)

    def drive(self, time: float) -> None:
        """Move each car to its place at a time; right-hand traffic on streets along Z."""
        for number, node in enumerate(self._cars):
            street = self._streets[number // 2 % len(self._streets)]
            way = 1.0 if number % 2 else -1.0
            start = number * 0.618 % 1.0
            laps = 1 + number % 2
            along = ((start + laps * time / PERIOD) % 1.0 - 0.5) * self._length
            node.pose = _pose(street - LANE * way, along * way, way)


def _pose(x: float, z: float, way: float) -> np.ndarray:
    """Return a car's pose: facing +Z, or turned round."""
    return np.array(
        [[way, 0.0, 0.0, x], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, way, z], [0.0, 0.0, 0.0, 1.0]]
    )
