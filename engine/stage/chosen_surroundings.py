"""The environment settings that the user chose.

In: plain values. Out: a staged scene with these settings; the scene keeps its own for the rest.
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

_USUAL_INTENSITY = 0.5  # of the automatic environment, beside a scene's own lights


@dataclass
class Surroundings:
    """The user's environment settings; None leaves a value to the scene.

    Attributes
    ----------
    environment : Environment or None
    without : bool
        Whether to remove the environment.
    rotation : float or None
        Radians.
    intensity : float or None
    shows : bool
        Whether the environment is the background; if set, a scene without an environment gets the
        studio. So do scenes with physically based materials, so that metals have something to
        reflect.
    blur : float or None
    """

    environment: Environment | None = None
    without: bool = False
    rotation: float | None = None
    intensity: float | None = None
    shows: bool = False
    blur: float | None = None

    def put(self, scene: StagedScene, automatic: bool = True) -> None:
        """Apply the settings to a scene.

        Parameters
        ----------
        scene : StagedScene
        automatic : bool
            Whether physically based materials get an environment to reflect.
        """
        if self.environment is not None or self.without:
            scene.environment = self.environment
        elif automatic and scene.environment is None and _has_physical(scene.scene):
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
    """Return whether a scene shows lit physically based materials."""
    return any(
        isinstance(thing, Material) and thing.is_physical and not thing.unlit
        for thing in uses_in([scene])
    )


def fog_color(background: Background) -> tuple[float, ...] | None:
    """Return the colour of a background or of a gradient's middle; None for others."""
    if isinstance(background, Gradient):
        ends = (
            display_color(cast(Color, end), "srgb") for end in (background.top, background.bottom)
        )
        return tuple(round(255 * (top + bottom) / 2) for top, bottom in zip(*ends, strict=True))
    return background if isinstance(background, tuple) else None
