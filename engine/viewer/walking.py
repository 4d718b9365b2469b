"""The walking controller on the ground: one walks where the scene lets one, at the height of eyes.

In: a `Walker` of the scene, keys and the mouse as in `fps`. Out: a camera position that is never
in a wall, over water or beside the grid. Steps are climbed smoothly. Y is up.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..navigation import Walker
from .fps import FpsController
from .viewpoint import Sphere, Viewpoint

if TYPE_CHECKING:
    from .view_renderer import ViewRenderer

#: Metres a second.
WALKING_SPEED = 3.5
#: The share of a step's height that the eyes rise in a second, at first.
RISE_A_SECOND = 12.0
_LEVEL = 1e-3


class GroundController(FpsController):
    """A camera that walks on the ground.

    Parameters
    ----------
    view : Viewpoint
        Gives the field of view.
    bounds : Sphere
        The scene's bounds.
    walker : Walker
        Who walks; starts where it stands.
    gaze : (float, float)
        Where to look first: yaw and pitch in radians.
    """

    def __init__(self, view: Viewpoint, bounds: Sphere, walker: Walker, gaze=(0.0, 0.0)):
        self._walker = walker
        super().__init__(view, bounds)
        self.speed = WALKING_SPEED
        self.position = walker.eye
        self.yaw, self.pitch = gaze

    def _move(self, way: tuple[int, int, int], reach: float, seconds: float) -> bool:
        right, _, forward = way
        length = math.sqrt(right * right + forward * forward)
        moved = False
        if length:
            sin_y, cos_y = math.sin(self.yaw), math.cos(self.yaw)
            dx, dz = cos_y * right - sin_y * forward, -sin_y * right - cos_y * forward
            moved = self._walker.move(dx * reach / length, dz * reach / length)
        target = self._walker.eye
        rise = float(target[1] - self.position[1])
        if abs(rise) > _LEVEL:
            target[1] = self.position[1] + rise * min(1.0, RISE_A_SECOND * seconds)
            moved = True
        self.position = np.array(target)
        return moved


def controller(view_renderer: ViewRenderer, view: Viewpoint) -> FpsController:
    """Return what walks in the scene: on its ground, or flying where there is none."""
    viewed = view_renderer.viewed
    if viewed.walker is None:
        return FpsController(view, view_renderer.bounds)
    return GroundController(view, view_renderer.bounds, viewed.walker(), viewed.gaze)
