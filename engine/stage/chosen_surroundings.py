"""The environment settings that the user chose.

In: plain values. Out: a staged scene with these settings; the scene keeps its own for the rest.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from ..choices import Color
from ..model.environments import cove
from ..model.environments.environment import Environment
from ..model.materials.display_colors import display_color
from ..model.materials.material import Material, states_nothing
from ..model.scene.gradients import Gradient
from ..model.scene.orbiting import home_axes
from ..model.scene.scene import Scene
from ..model.scene.staged_scene import StagedScene
from ..model.scene.surroundings import Background
from ..model.scene.usage import uses_in


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
        Whether the environment is the background; if set, a scene without an environment gets
        `Environment.studio`.
    blur : float or None
    """

    environment: Environment | None = None
    without: bool = False
    rotation: float | None = None
    intensity: float | None = None
    shows: bool = False
    blur: float | None = None

    def put(self, scene: StagedScene, up: ArrayLike | None = None) -> None:
        """Apply the settings to a scene.

        Parameters
        ----------
        scene : StagedScene
        up : (3,) sequence of float, optional
            The world's up direction, if physically based materials of a scene without environment
            reflect the cove. Others only look as if they did, since it takes time to prepare.
        """
        if self.environment is not None or self.without:
            scene.environment = self.environment
        elif (
            up is not None
            and not self.shows
            and scene.scene.environment is None
            and _has_physical(scene.scene)
        ):
            x, y, z = np.asarray(up, np.float64).tolist()
            scene.environment = _cove((x, y, z))
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
    """Return whether a scene shows lit physically based materials that somebody chose."""
    return any(
        isinstance(thing, Material)
        and thing.is_physical
        and not thing.unlit
        and not states_nothing(thing)
        for thing in uses_in([scene])
    )


@functools.lru_cache(maxsize=6)  # as many as there are axes to stand along
def _cove(up: tuple[float, float, float]) -> Environment:
    return Environment(cove.pixels(tuple(home_axes(up))), name="cove")


def fog_color(background: Background) -> tuple[float, ...] | None:
    """Return the colour of a background or of a gradient's middle; None for others."""
    if isinstance(background, Gradient):
        ends = (
            display_color(cast(Color, end), "srgb") for end in (background.top, background.bottom)
        )
        return tuple(round(255 * (top + bottom) / 2) for top, bottom in zip(*ends, strict=True))
    return background if isinstance(background, tuple) else None
