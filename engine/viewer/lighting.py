"""Lights that the viewer adds to a scene, in set-ups to choose from.

In: a scene and, each frame, the camera's pose. Out: light nodes of which one set-up is visible.
The set-ups but "sun" move with the camera, so that what is looked at is never dark; the scene's own
lights, if it has any, are the first set-up.
"""

from __future__ import annotations

import math

import numpy as np

from ..scene.lights import DirectionalLight, PointLight
from ..scene.orbiting import home_axes
from .viewpoint import Sphere

#: Per set-up: the way the light travels, in camera space (or the home frame, if fixed), the linear
#: colour, the intensity.
SETUPS = {
    "studio": (
        ((-0.50, -0.60, -0.80), (1.0, 0.97, 0.92), 0.74),
        ((0.85, -0.10, -0.50), (0.82, 0.90, 1.0), 0.30),
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


class Lighting:
    """The lights of a scene: its own, and the set-ups added here.

    Parameters
    ----------
    scene : Scene
        The scene to light; light nodes are added to it.
    up : (3,) sequence of float
        The world's up direction.
    intensity : float
        Factor on the set-ups' intensities.
    """

    def __init__(self, scene, up, intensity: float = 1.0):
        own = [node for node in scene.nodes if is_light(node) and node.visible]
        self._scene = scene
        self._nodes = {OWN_LIGHTS: own} if own else {}
        self._home = np.stack(home_axes(up), axis=1)
        for name, lights in SETUPS.items():
            self._nodes[name] = [
                scene.add(DirectionalLight(direction, color, strength * intensity))
                for direction, color, strength in lights
            ]
        self.names = tuple(self._nodes)
        self.choose(self.names[0])

    def choose(self, name: str) -> None:
        """Light the scene with one set-up and no other."""
        self.name = name
        for setup, nodes in self._nodes.items():
            for node in nodes:
                node.visible = setup == name

    def leave(self) -> None:
        """Light the scene with its own lights again, and take away all others."""
        self.choose(self.names[0])
        for name, nodes in self._nodes.items():
            for node in nodes if name != OWN_LIGHTS else ():
                self._scene.remove(node)

    def follow(self, pose: np.ndarray) -> None:
        """Turn the set-up with the camera, whose pose is (4, 4)."""
        if self.name == OWN_LIGHTS:
            return
        rotation = np.eye(4)
        rotation[:3, :3] = self._home if self.name in FIXED_SETUPS else pose[:3, :3]
        for node in self._nodes[self.name]:
            node.pose = rotation


class PlacedLight:
    """One point light at a place of the user's, instead of every other light.

    Parameters
    ----------
    scene : Scene
        The scene to light.
    position : (3,) sequence of float
        Where, in world space.
    bounds : Sphere
        The scene's bounds.
    intensity : float or None
        I of E = I/d²; None lights the middle of the scene with E = 1.
    """

    names = ("placed light",)
    name = "placed light"

    def __init__(self, scene, position, bounds: Sphere, intensity: float | None = None):
        self._scene = scene
        self._hidden = [node for node in scene.nodes if is_light(node) and node.visible]
        for node in self._hidden:
            node.visible = False
        if intensity is None:
            intensity = sum((p - c) * (p - c) for p, c in zip(position, bounds.center, strict=True))
            intensity = intensity if intensity > 0.0 and math.isfinite(intensity) else 1.0
        light = PointLight(color=(1.0, 1.0, 1.0), intensity=intensity)
        self._node = scene.add(light, translation=position)

    def leave(self) -> None:
        """Light the scene with its own lights again."""
        self._scene.remove(self._node)
        for node in self._hidden:
            node.visible = True

    def choose(self, name: str) -> None:
        """Do nothing: there is one set-up."""

    def follow(self, pose: np.ndarray) -> None:
        """Do nothing: the light stays where it was put."""


def is_light(node) -> bool:
    """Return whether a scene's node holds a light."""
    return isinstance(node.object, (DirectionalLight, PointLight))
