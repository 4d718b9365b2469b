"""What of a scene's surroundings the user asked for: its environment, and whether that shows.

In: plain values. Out: a scene that has them; what was left open stays as the scene has it.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..environments.environment import Environment
from ..scene.scene import Scene


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
        Whether the environment is the background; a scene without any then gets the studio.
    blur : float or None
    """

    environment: Environment | None = None
    without: bool = False
    rotation: float | None = None
    intensity: float | None = None
    shows: bool = False
    blur: float | None = None

    def put(self, scene: Scene) -> None:
        """Give them to a scene."""
        if self.environment is not None or self.without:
            scene.environment = self.environment
        if self.rotation is not None:
            scene.environment_rotation = self.rotation
        if self.intensity is not None:
            scene.environment_intensity = self.intensity
        if self.blur is not None:
            scene.background_blur = self.blur
        if self.shows:
            scene.environment = scene.environment or Environment.studio()
            scene.background = scene.environment
