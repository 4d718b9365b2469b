"""A scene for viewing: the scene, its motion, and its preferred view.

Both opened models and demo scenes become viewed scenes; the window, the turntable and still
pictures draw them.
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
    from .coloring import Coloring, ScalarBar

#: Seconds per turn of a turntable.
TURN_SECONDS = 6.0


class NotInModelError(InvalidArgumentError):
    """Raised if a model lacks the requested animation or camera."""


@dataclass
class ViewedScene:
    """A scene for viewing, with its first view, motion and metadata.

    Attributes
    ----------
    scene : Scene
        The scene to draw.
    title : str
        A name for the window and for files.
    up : str
        A key of `UP_DIRECTIONS`.
    azimuth, elevation : float
        The first view, in radians.
    may_turn : bool
        Whether the first view may be from another quarter, if it would show one flat side alone.
    update : callable or None
        Called before a frame with the time in seconds, to move the scene's nodes. Without it,
        playing turns the camera around the scene.
    period : float
        Seconds after which the animation repeats.
    plays : bool
        Whether it plays from the start.
    player : AnimationPlayer or None
        The player of the scene's animations.
    focus : (N, 3) ndarray of float64 or None
        Points to frame in the first view, in world space; by default the whole scene.
    swept : (N, 3) ndarray of float64 or None
        Points that bound the scene at all times of its clips, in world space; for scenes whose
        clips play. The first view shows them all.
    appearance : dict
        Fields of `Appearance` that the scene sets unless the user overrides them.
    follow : callable or None
        Called with the camera's position, (3,) float64 in world space, before a frame.
    detail : callable or None
        Called with the camera, its pose and the picture's size before a frame, to choose levels of
        detail.
    walker : callable or None
        Returns the `Walker` on the scene's ground, always the same one; without it, walking means
        flying.
    gaze : (float, float)
        The walker's first view direction: yaw and pitch in radians.
    origin : (float, float, float)
        The scene's origin in the files' coordinates.
    nearest : float
        World units: the maximum near distance inside the scene.
    clearance : callable or None
        Called with the camera's position, (3,) float64 in world space; returns the radius of the
        free space around it, which the near plane may use.
    themed : bool
        Whether it wears a look, whose background may follow the viewer's theme.
    is_scene : bool
        Whether it is a program's scene, perhaps from a scene file. A look leaves its background
        alone, unless that is the one of new scenes. With light of its own, it gets no other light,
        and its textures are read as they say.
    path : str or None
        The file it came from.
    format : str or None
        The file's format.
    details : list of str
        The file's contents, line by line, for the metadata overlay.
    warnings : list of str
        The loader's warnings.
    unit : str
        Unit of its coordinates; empty if unknown.
    bar : ScalarBar or None
        The colour bar, if its colours represent numbers.
    coloring : Coloring or None
        How its meshes show numbers, unless they are coloured by them already.
    model_edges : bool
        Whether visible edges of its meshes are those of a model of CAD, which looks draw thin.
    """

    scene: Scene
    title: str
    up: str = "+Y"
    azimuth: float = DEFAULT_AZIMUTH
    elevation: float = DEFAULT_ELEVATION
    may_turn: bool = False
    update: Callable[[float], None] | None = None
    period: float = TURN_SECONDS
    plays: bool = False
    player: AnimationPlayer | None = None
    focus: np.ndarray | None = None
    swept: np.ndarray | None = None
    appearance: dict[str, Any] = field(default_factory=dict)
    follow: Callable[[np.ndarray], None] | None = None
    detail: Callable[..., object] | None = None
    walker: Callable[[], Walker] | None = None
    gaze: tuple[float, float] = (0.0, 0.0)
    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    nearest: float = math.inf
    clearance: Callable[[np.ndarray], float] | None = None
    themed: bool = False
    is_scene: bool = False
    path: str | None = None
    format: str | None = None
    details: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    unit: str = ""
    bar: ScalarBar | None = None
    coloring: Coloring | None = None
    model_edges: bool = False

    @cached_property
    def bounds(self) -> Sphere:
        """The bounding sphere of the scene in its first pose, in world space."""
        return bounding_sphere(self.scene)

    @property
    def places(self) -> np.ndarray | None:
        """Points that bound the moving scene, (N, 3) in world space; None if it is to be seen."""
        return self.focus if self.swept is None else self.swept

    @property
    def shows_numbers(self) -> bool:
        """Whether colours stand for numbers."""
        return self.bar is not None or self.coloring is not None

    def forget_bounds(self) -> None:
        """Measure the bounds anew when they are used next."""
        self.__dict__.pop("bounds", None)

    def metadata(self) -> list[str]:
        """Return the file's contents, line by line."""
        return [self.title, *self.details]
