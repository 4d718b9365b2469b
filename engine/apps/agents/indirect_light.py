"""The light from all sides of a file, which belongs to its scene and to no node.

In: scenes. Out: an `IndirectLight` for each, and one of several.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ...model.environments.environment import Environment
from ...model.materials.linear_colors import LinearColor
from ...model.scene.scene import Scene
from ...stage.open_models import brightest

_NONE = LinearColor((0.0, 0.0, 0.0))


class IndirectLight(NamedTuple):
    """Ambient light, and the environment with what a scene says of it; see `Scene`."""

    ambient: LinearColor = _NONE
    environment: Environment | None = None
    intensity: float = 1.0
    rotation: float = 0.0

    def put(self, scene: Scene, with_ambient: bool) -> None:
        """Give it to a scene, the ambient light perhaps."""
        if with_ambient:
            scene.ambient = self.ambient
        if self.environment is not None:
            scene.environment = self.environment
            scene.environment_intensity = self.intensity
            scene.environment_rotation = self.rotation


def indirect_light_of(scene: Scene) -> IndirectLight:
    """Return the light from all sides of a scene."""
    return IndirectLight(
        brightest([scene.ambient]),
        scene.environment,
        scene.environment_intensity,
        scene.environment_rotation,
    )


def joined(lights: Sequence[IndirectLight]) -> IndirectLight:
    """Return the light of several: the larger ambient light in each channel, not the sum.

    Of environments it is the first one.
    """
    if not lights:
        return IndirectLight()
    first = next((light for light in lights if light.environment is not None), lights[0])
    return first._replace(ambient=brightest([light.ambient for light in lights]))
