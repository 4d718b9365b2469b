"""Light set-ups beside a scene.

In: a scene and, each frame, the camera's pose. Out: light nodes beside it, of one set-up
at a time. All set-ups except "sun" move with the camera, so that the subject is never dark; the
scene's own lights, if any, are the first set-up.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from ..base import linalg
from ..choices import LightShadow
from ..model.environments.cove import PROBE
from ..model.materials.linear_colors import linear
from ..model.scene.ambient_lights import AmbientLight, HemisphereLight, LightProbe
from ..model.scene.lights import (
    LIGHTS,
    WHITE_INTENSITY,
    DirectionalLight,
    DirectLight,
    Light,
    PointLight,
)
from ..model.scene.nodes import Node
from ..model.scene.orbiting import home_axes
from ..model.scene.staged_scene import StagedScene
from .look import Look
from .views.viewpoint import Sphere

#: Per set-up: the light's direction, in camera space (or the home frame, if fixed), the linear
#: colour, the intensity as a part of the one that shows white.
SETUPS = {
    "studio": (
        ((-0.50, -0.85, -0.65), (1.0, 0.97, 0.92), 1.2),
        ((0.85, -0.10, -0.50), (0.82, 0.90, 1.0), 0.12),
        ((0.20, -0.60, 0.75), (1.0, 1.0, 1.0), 0.30),
    ),
    "headlight": (((0.0, 0.0, -1.0), (1.0, 1.0, 1.0), 1.0),),
    "sun": (
        ((-0.45, -0.80, -0.40), (1.0, 0.95, 0.85), 1.0),
        ((0.30, 1.0, 0.30), (0.75, 0.85, 1.0), 0.12),
    ),
    "two colours": (
        ((0.85, -0.30, -0.45), (1.0, 0.45, 0.20), 1.0),
        ((-0.85, -0.30, -0.45), (0.20, 0.45, 1.0), 1.0),
    ),
}
FIXED_SETUPS = ("sun",)
OWN_LIGHTS = "scene"
#: The set-up without lights: the renderer lights the scene from the camera.
NO_LIGHTS = "plain"
_UNTURNED = (OWN_LIGHTS, NO_LIGHTS)
#: The set-up whose shadows are hidden behind what casts them.
_SHADOWLESS = "headlight"
#: Texels a side of shadow maps: about as many as the shorter side of the picture has pixels.
_LEAST_MAP, _MOST_MAP = 512, 2048
#: The distance of a map's comparisons, in thousandths of its side: how soft shadows are.
_SOFTNESS = 1.7
_MOST_LAMPS = 4  # each draws six maps
_MAIN = 0.5  # of the brightest: dimmer lights only brighten other lights' shadows
_IN_ENVIRONMENT = 0.6  # factor for set-ups in an environment, which also lights
#: Ambient light from above and from below, where there are no surroundings.
_SKY, _GROUND = linear(0.30, 0.32, 0.36), linear(0.18, 0.17, 0.16)


class Lighting:
    """The lights of a scene: its own, and the set-ups beside it.

    Parameters
    ----------
    staged : StagedScene
        The scene to light.
    up : (3,) sequence of float
        The world's up direction.
    intensity : float
        Factor for the set-ups.
    first : str
        The first set-up of a scene without lights: a key of `SETUPS`, or `NO_LIGHTS`.
    """

    def __init__(
        self, staged: StagedScene, up: ArrayLike, intensity: float = 1.0, first: str = "studio"
    ) -> None:
        own = [
            cast(Light, node.object)
            for node in staged.scene.nodes
            if is_light(node) and node.visible
        ]
        self._staged = staged
        self._lights: dict[str, list[Light]] = {OWN_LIGHTS: own} if own else {}
        self._nodes: list[Node] = []  # of the chosen set-up, beside the scene
        if first == NO_LIGHTS:
            self._lights[NO_LIGHTS] = []
        self._home = np.stack(tuple(home_axes(up)), axis=1)
        intensity *= WHITE_INTENSITY
        for name, lights in SETUPS.items():
            self._lights[name] = [
                DirectionalLight(direction, linear(color), strength * intensity)
                for direction, color, strength in lights
            ]
        self.names = tuple(self._lights)
        self.choose(OWN_LIGHTS if own else first)

    def choose(self, name: str) -> None:
        """Light the scene with one set-up only."""
        self.name = name
        self._turn: np.ndarray | None = None
        self._staged.keep_lights(name == OWN_LIGHTS)
        for node in self._nodes:
            self._staged.beside.remove(node)
        added = [] if name == OWN_LIGHTS else self._lights[name]
        self._nodes = [self._staged.beside.add(light) for light in added]

    def groups(self) -> list[list[Light]]:
        """Return the groups of lights that shine together, one for each set-up."""
        return list(self._lights.values())

    def cast_shadows(self, shadow: LightShadow) -> None:
        """Let the main lights of set-ups cast shadows; the scene's own lights stay as they are."""
        others = (OWN_LIGHTS, _SHADOWLESS)
        switch_shadows(
            [lights for name, lights in self._lights.items() if name not in others], shadow
        )

    def soften(self, size: tuple[int, int]) -> None:
        """Fit the shadow maps of set-ups to a picture of a given size, so that shadows are soft."""
        side = _LEAST_MAP
        while side < min(size) and side < _MOST_MAP:
            side *= 2
        for name, lights in self._lights.items():
            for light in lights:
                if name != OWN_LIGHTS and isinstance(light, DirectionalLight):
                    _soften(light, side)

    @contextmanager
    def without_shadows(self) -> Iterator[None]:
        """Let set-ups cast no shadows for a while."""
        lights = [light for light in map(_direct, self._nodes) if light.shadow != "none"]
        shadows = [light.shadow for light in lights]
        for light in lights:
            light.shadow = "none"
        try:
            yield
        finally:
            for light, shadow in zip(lights, shadows, strict=True):
                light.shadow = shadow

    def main_direction(self) -> np.ndarray | None:
        """Return the direction, (3,), in which the main light travels now; None of other lights."""
        if self.name in _UNTURNED:
            return None
        node = self._nodes[0]
        return linalg.dot(node.pose[:3, :3], _direct(node).direction)

    def follow(self, pose: np.ndarray) -> None:
        """Rotate the set-up with the camera, whose pose is (4, 4)."""
        if self.name in _UNTURNED:
            return
        base = self._base(pose)
        turned = _pose_of(base if self._turn is None else _product(base, self._turn))
        for node in self._nodes:
            node.pose = turned

    def _base(self, pose: np.ndarray) -> np.ndarray:
        """Return the axes that the set-up is relative to: the home frame or the camera's."""
        return self._home if self.name in FIXED_SETUPS else pose[:3, :3]

    def turn(self, pose: np.ndarray, dx: float, dy: float) -> bool:
        """Rotate the set-up to the right and downward, as seen by a camera.

        Returns
        -------
        bool
            Whether it turned: the scene's own lights never do.
        """
        if self.name in _UNTURNED:
            return False
        base = self._base(pose)
        turned = _product(base.T, _product(_seen_turn(pose, dx, dy), base))
        self._turn = turned if self._turn is None else _product(turned, self._turn)
        return True


class OnlyLight:
    """A single light of the user's that replaces all others.

    Parameters
    ----------
    staged : StagedScene
        The scene to light.
    light : DirectionalLight or PointLight
    position : (3,) sequence of float
        A point light's position, in world space.
    """

    def __init__(
        self,
        staged: StagedScene,
        light: DirectionalLight | PointLight,
        position: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> None:
        self.name = "placed light" if isinstance(light, PointLight) else "directed light"
        self.names = (self.name,)
        staged.keep_lights(False)
        self._node = staged.beside.add(light, translation=position)

    def groups(self) -> list[list[Light]]:
        """Return the one light as a group, as `Lighting` does."""
        return [[cast(Light, self._node.object)]]

    def choose(self, name: str) -> None:
        """Do nothing: there is only one set-up."""

    def without_shadows(self) -> nullcontext[None]:
        """Do nothing."""
        return nullcontext()

    def soften(self, size: tuple[int, int]) -> None:
        """Do nothing: only the shadows of set-ups are soft."""

    def main_direction(self) -> np.ndarray | None:
        """Return the direction, (3,), in which a directional light travels, as `Lighting` does."""
        if not isinstance(self._node.object, DirectionalLight):
            return None
        return linalg.dot(self._node.pose[:3, :3], self._node.object.direction)

    def turn(self, pose: np.ndarray, dx: float, dy: float) -> bool:
        """Rotate a directional light as `Lighting.turn` does; return whether it is one."""
        if isinstance(self._node.object, PointLight):
            return False
        turned = _seen_turn(pose, dx, dy)
        self._node.pose = _pose_of(_product(turned, self._node.pose[:3, :3]))
        return True

    def follow(self, pose: np.ndarray) -> None:
        """Do nothing: the light does not follow the camera."""


def switch_shadows(groups: Iterable[list[Light]], shadow: LightShadow) -> None:
    """Switch the shadows of lights on or off.

    Parameters
    ----------
    groups : iterable of list of Light
        Groups of lights that shine together. In a group with more than four point lights, these
        cast none.
    shadow : {"none", "map", "exact"}
        The value of ``shadow`` for the main lights; the others cast none. Ambient lights have no
        shadow.
    """
    for group in groups:
        lights = [light for light in group if isinstance(light, DirectLight)]
        main = _main_lights(lights)
        for light in lights:
            light.shadow = shadow if light in main else "none"


def _main_lights(lights: Sequence[DirectLight]) -> list[DirectLight]:
    lamps: list[DirectLight] = [light for light in lights if isinstance(light, PointLight)]
    far = [light for light in lights if light not in lamps]
    bright = max((light.intensity for light in far), default=0.0)
    main = [light for light in far if light.intensity >= _MAIN * bright]
    return main + (lamps if len(lamps) <= _MOST_LAMPS else [])


def light_in(
    look: Look, staged: StagedScene, up: ArrayLike, first: str, intensity: float = 1.0
) -> tuple[Lighting, AmbientLight | None]:
    """Return the lighting of a scene in a look, and the light from all around that belongs to it.

    Parameters
    ----------
    look, staged, up, first
        As for `Lighting`.
    intensity : float
        Factor for the set-ups, besides the look's own.
    """
    ambient, around = _light_around(look, staged)
    intensity *= look.light_intensity * around
    return Lighting(staged, up, intensity, first), ambient


def _light_around(look: Look, staged: StagedScene) -> tuple[AmbientLight | None, float]:
    """Return the light from all around in a look, and the factor for set-ups beside it.

    None: the look has no lights. If the scene has an environment, that is the light instead.
    """
    is_surrounded = staged.environment is not None
    if look.lights is None:
        return None, _IN_ENVIRONMENT if is_surrounded else 1.0
    if look.environment:
        return LightProbe(PROBE), _IN_ENVIRONMENT
    return HemisphereLight(_SKY, _GROUND), _IN_ENVIRONMENT if is_surrounded else 1.0


def placed_light(
    staged: StagedScene, position: Sequence[float], bounds: Sphere, intensity: float | None = None
) -> OnlyLight:
    """Return the lighting of a scene by one point light.

    Parameters
    ----------
    staged : StagedScene
    position : (3,) sequence of float
        Its position, in world space.
    bounds : Sphere
        The scene's bounds.
    intensity : float or None
        What a white surface that faces the light shows of it at distance 1. By default, it shows
        white at the scene's centre.
    """
    if intensity is None:
        intensity = sum((p - c) * (p - c) for p, c in zip(position, bounds.center, strict=True))
        intensity = intensity if intensity > 0.0 and math.isfinite(intensity) else 1.0
    return OnlyLight(staged, PointLight(intensity=intensity * WHITE_INTENSITY), position)


def _seen_turn(pose: np.ndarray, dx: float, dy: float) -> np.ndarray:
    """Return the world-space rotation that a camera sees as one to the right and downward."""
    across = linalg.quaternion_from_axis_angle(pose[:3, 1], dx)
    down = linalg.quaternion_from_axis_angle(pose[:3, 0], dy)
    return linalg.quaternion_to_matrix(linalg.quaternion_multiply(across, down))[:3, :3]


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.stack([linalg.dot(a, column) for column in b.T], axis=1)


def _direct(node: Node) -> DirectionalLight:
    return cast(DirectionalLight, node.object)


def _soften(light: DirectionalLight, side: int) -> None:
    """Give a light shadow maps with a given side, and their usual softness."""
    if light.shadow == "map" and (light.shadow_map_size, light.shadow_taps) != (side, 5):
        light.shadow_map_size, light.shadow_taps = side, 5
        light.shadow_radius = _SOFTNESS * side / 1000


def _pose_of(rotation: np.ndarray) -> np.ndarray:
    pose = np.eye(4)
    pose[:3, :3] = rotation
    return pose


def is_light(node: Node) -> bool:
    """Return whether a scene's node holds a light."""
    return isinstance(node.object, LIGHTS)
