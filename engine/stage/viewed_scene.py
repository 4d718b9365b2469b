"""A viewed scene: the scene, how it moves, and how it is best looked at.

Models that are opened and demo scenes both arrive here; the window, the turntable and the still
picture take them from here.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InvalidArgumentError
from .scene_bounds import bounding_sphere
from .views.viewpoint import DEFAULT_AZIMUTH, DEFAULT_ELEVATION, Sphere

if TYPE_CHECKING:
    from ..model.motion.player import AnimationPlayer
    from ..model.navigation import Walker
    from ..model.scene.scene import Scene
    from .scalars import ScalarBar

#: Seconds of one turn of a turntable.
TURN_SECONDS = 6.0


class NotInModelError(InvalidArgumentError):
    """An animation or a camera is asked for that a model doesn't have."""


@dataclass
class ViewedScene:
    """A scene to look at.

    Attributes
    ----------
    scene : Scene
        What is drawn.
    title : str
        A name for the window and for files.
    up : str
        A key of `UP_DIRECTIONS`.
    azimuth, elevation : float
        The first view, in radians.
    update : callable or None
        Called with the time in seconds before a frame; moves the scene's nodes. Without it, playing
        turns the camera round the scene.
    period : float
        Seconds after which the animation repeats.
    plays : bool
        Whether it moves from the start.
    player : AnimationPlayer or None
        What plays of the scene's animations.
    focus : (N, 3) ndarray of float64 or None
        Points that the first view shows, in world space; by default all of the scene.
    appearance : dict
        Fields of `Appearance` that this scene wants unless the user says otherwise.
    follow : callable or None
        Called with the camera's position, (3,) float64 in world space, before a frame.
    detail : callable or None
        Called with the camera, its pose and the picture's size before a frame, to choose levels of
        detail.
    walker : callable or None
        Returns the `Walker` on the scene's ground, always the same; without it, walking is flying.
    gaze : (float, float)
        Where the walker looks first: yaw and pitch in radians.
    origin : (float, float, float)
        Where the scene's origin is in the files' coordinates.
    nearest : float
        World units: inside the scene the near plane is not farther than this.
    clearance : callable or None
        Called with the camera's position, (3,) float64 in world space: returns a distance within
        which nothing is, so that the near plane may be as far as that.
    themed : bool
        Whether the background follows the viewer's theme.
    path : str or None
        The file it came from.
    format : str or None
        The file's.
    details : list of str
        What the file holds, line by line, for the metadata overlay.
    warnings : list of str
        What the loader had to pass over.
    unit : str
        Of its coordinates; empty where nobody says.
    bar : ScalarBar or None
        What its colours mean, if they stand for numbers.
    """

    scene: Scene
    title: str
    up: str = "+Y"
    azimuth: float = DEFAULT_AZIMUTH
    elevation: float = DEFAULT_ELEVATION
    update: Callable[[float], None] | None = None
    period: float = TURN_SECONDS
    plays: bool = False
    player: AnimationPlayer | None = None
    focus: np.ndarray | None = None
    appearance: dict[str, Any] = field(default_factory=dict)
    follow: Callable[[np.ndarray], None] | None = None
    detail: Callable[..., object] | None = None
    walker: Callable[[], Walker] | None = None
    gaze: tuple[float, float] = (0.0, 0.0)
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    nearest: float = math.inf
    clearance: Callable[[np.ndarray], float] | None = None
    themed: bool = False
    path: str | None = None
    format: str | None = None
    details: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    unit: str = ""
    bar: ScalarBar | None = None

    @cached_property
    def bounds(self) -> Sphere:
        """The bounding sphere of the scene as it first was, in world space."""
        return bounding_sphere(self.scene)

    def metadata(self) -> list[str]:
        """Return what the file holds, line by line."""
        return [self.title, *self.details]
