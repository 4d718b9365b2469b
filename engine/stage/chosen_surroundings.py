"""The surroundings that the user asked for: an environment, and whether it shows.

In: plain values. Out: a staged scene that has them; what was left open stays as the scene has it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from ..choices import Color
from ..model.environments.environment import Environment
from ..model.materials.display_colors import display_color
from ..model.materials.material import Material
from ..model.scene.gradients import Gradient
from ..model.scene.scene import Scene
from ..model.scene.staged_scene import StagedScene
from ..model.scene.surroundings import Background
from ..model.scene.usage import uses_in

_USUAL_INTENSITY = 0.5  # of the environment that scenes get by themselves, beside their lights


@dataclass
class Surroundings:
    """None leaves a value to the scene.

    Attributes
    ----------
    environment : Environment or None
    without : bool
        The scene is to have no environment.
    rotation : float or None
        Radians.
    intensity : float or None
    shows : bool
        Whether the environment is the background; a scene without any then gets the studio, as do
        scenes of physically based materials, whose metals would have nothing to mirror.
    blur : float or None
    """

    environment: Environment | None = None
    without: bool = False
    rotation: float | None = None
    intensity: float | None = None
    shows: bool = False
    blur: float | None = None

    def put(self, scene: StagedScene) -> None:
        """Draw a scene in them."""
        if self.environment is not None or self.without:
            scene.environment = self.environment
        elif scene.environment is None and _has_physical(scene.scene):
            scene.environment = Environment.studio()
            scene.environment_intensity = _USUAL_INTENSITY
        if self.rotation is not None:
            scene.environment_rotation = self.rotation
        if self.intensity is not None:
            scene.environment_intensity = self.intensity
        if self.blur is not None:
            scene.background_blur = self.blur
        if self.shows:
            scene.environment = scene.environment or Environment.studio()
            scene.background = scene.environment


def _has_physical(scene: Scene) -> bool:
    """Return whether a scene shows physically based materials that are lit."""
    return any(
        isinstance(thing, Material) and thing.is_physical and not thing.unlit
        for thing in uses_in([scene])
    )


def fog_color(background: Background) -> tuple[float, ...] | None:
    """Return the colour of a background, or of a gradient's middle; None where it has no one."""
    if isinstance(background, Gradient):
        ends = (
            display_color(cast(Color, end), "srgb") for end in (background.top, background.bottom)
        )
        return tuple(round(255 * (top + bottom) / 2) for top, bottom in zip(*ends, strict=True))
    return background if isinstance(background, tuple) else None
