"""Light as OpenGL's fixed pipeline adds it up at vertices, the way trimesh's viewer sets it up.

In: colours and normals in eye space, and a scene's lights. Out: lit colours.

trimesh hands over the places of lights before it places the camera, and without a fourth component:
so OpenGL takes them for directions, in eye space, that turn with the camera.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

_MOST = 7  # lights
_GLOBAL = 0.2  # OpenGL's own ambient light
_SPECULAR = 0.508273
_SHININESS = 51.2


class Lamp(NamedTuple):
    """A light: the direction towards it, of unit length or 0, and its colour, 0 to 1."""

    direction: NDArray[np.float64]
    color: NDArray[np.float64]


def lamps_of(scene: Any) -> list[Lamp]:
    """Return the lights of a scene: its own, or those that trimesh gives it."""
    found = []
    for light in scene.lights[:_MOST]:
        place = np.asarray(scene.graph.get(light.name)[0], np.float64)[:3, 3]
        length = float(np.sqrt((place * place).sum()))
        color = np.asarray(light.color, np.float64)[:3] / 255.0
        found.append(Lamp(place / length if length else place, color))
    return found


def lit(
    colors: NDArray[np.uint8], normals: NDArray[np.float64], lamps: list[Lamp]
) -> NDArray[np.uint8]:
    """Return colours under lights, (N, 4) uint8.

    Parameters
    ----------
    colors : (N, 4) uint8
    normals : (N, 3) float64
        In eye space.
    """
    length = np.sqrt((normals * normals).sum(1, keepdims=True))
    unit = normals / np.maximum(length, 1e-300)
    base = colors[:, :3] / 255.0
    scattered = np.full_like(base, _GLOBAL)
    mirrored = np.zeros_like(base)
    for lamp in lamps:
        facing = np.maximum((unit * lamp.direction).sum(1), 0.0)
        half = lamp.direction + np.array([0.0, 0.0, 1.0])
        half = half / max(float(np.sqrt((half * half).sum())), 1e-300)
        glance = np.maximum((unit * half).sum(1), 0.0) ** _SHININESS
        scattered += lamp.color * (1.0 + facing[:, None])
        mirrored += _SPECULAR * lamp.color * np.where(facing > 0.0, glance, 0.0)[:, None]
    out = colors.copy()
    out[:, :3] = np.clip(255.0 * (base * scattered + mirrored) + 0.5, 0, 255).astype(np.uint8)
    return out
