"""The ground controller: walks at eye height where the scene is walkable.

In: a `Walker` of the scene, keys and the mouse as in `fps`. Out: a camera position that is never in
a wall, over water or outside the grid. Steps are climbed smoothly. The walker has its own space, in
which Y is up.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ...base import linalg
from ...model.navigation import NavigationGrid
from ..headless import seconds_a_frame
from .fps import FpsController
from .viewpoint import Sphere, Viewpoint
from .walkable_ground import Ground, find_ground

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..view_renderer import ViewRenderer

#: Seconds of a turn where the way ends.
_TURN_SECONDS = 0.3
#: Metres per second.
WALKING_SPEED = 3.5
#: The fraction of a step's height that the eyes rise per second, at first.
RISE_A_SECOND = 12.0
#: Metres too small to notice.
LEVEL = 1e-3


class GroundController(FpsController):
    """A camera that walks on the ground.

    Parameters
    ----------
    view : Viewpoint
        Gives the field of view.
    bounds : Sphere
        The scene's bounds.
    ground : Ground
        The ground and its walker, whose position is the start.
    gaze : (float, float)
        The first view direction: yaw and pitch in radians.
    """

    def __init__(
        self,
        view: Viewpoint,
        bounds: Sphere,
        ground: Ground,
        gaze: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        self._walker = ground.walker
        self._world_from_walk = ground.axes.T
        super().__init__(view, bounds)
        self.speed = WALKING_SPEED * ground.metre
        self._level = LEVEL * ground.metre
        self._eye = ground.walker.eye
        self.position = self._in_world()
        self.yaw, self.pitch = gaze

    @property
    def grid(self) -> NavigationGrid:
        """The navigation grid of the walker."""
        return self._walker.grid

    def _in_world(self) -> np.ndarray:
        return linalg.dot(self._world_from_walk, self._eye)

    def _move(self, way: tuple[int, int, int], reach: float, seconds: float) -> bool:
        right, _, forward = way
        length = math.sqrt(right * right + forward * forward)
        moved = False
        if length:
            sin_y, cos_y = math.sin(self.yaw), math.cos(self.yaw)
            dx, dz = cos_y * right - sin_y * forward, -sin_y * right - cos_y * forward
            moved = self._walker.move(dx * reach / length, dz * reach / length)
        target = self._walker.eye
        rise = float(target[1] - self._eye[1])
        if abs(rise) > self._level:
            target[1] = self._eye[1] + rise * min(1.0, RISE_A_SECOND * seconds)
            moved = True
        self._eye = target
        self.position = self._in_world()
        return moved


def controller(view_renderer: ViewRenderer, view: Viewpoint) -> FpsController:
    """Return the walking controller of a scene, or a flying one if it has no ground.

    A scene has a ground if it provides one itself, or if the user chose to walk on it.
    """
    viewed, settings, bounds = view_renderer.viewed, view_renderer.settings, view_renderer.bounds
    if viewed.walker is not None:
        ground = Ground(np.eye(3), 1.0, viewed.walker())
        return GroundController(view, bounds, ground, viewed.gaze)
    if settings.walks and viewed.update is None:
        ground = find_ground(viewed.scene, bounds, view, settings.walkable, settings.slope)
        return GroundController(view, bounds, ground, (view.azimuth, 0.0))
    return FpsController(view, bounds)


def walk(view_renderer: ViewRenderer, view: Viewpoint, count: int) -> Iterator[np.ndarray]:
    """Yield ``count`` pictures of a walk straight ahead that turns right where the way ends."""
    seconds = seconds_a_frame(view_renderer, count)
    walker = controller(view_renderer, view)
    view = view.copy()
    for index in range(count):
        walker.place(view)
        yield view_renderer.draw(view, index * seconds % view_renderer.viewed.period).color
        before = walker.position
        walker.walk({"W"}, seconds)
        ahead = walker.position - before
        if ahead[0] * ahead[0] + ahead[2] * ahead[2] < (0.2 * walker.speed * seconds) ** 2:
            walker.walk({"Right"}, _TURN_SECONDS)
