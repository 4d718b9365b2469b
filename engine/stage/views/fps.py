"""The first-person controller: keys move, mouse and arrows look.

In: pressed keys (by position on the keyboard) and mouse movement in pixels. Out: a camera position
and two angles, taken from a `Viewpoint` on entering and given back on leaving, so that neither
change moves the picture.
"""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np

from ...model.scene.orbiting import home_axes
from .orbit import MAX_DISTANCE
from .viewpoint import QUARTER_TURN, Sphere, Viewpoint

#: Key positions (named as on a US keyboard) and their directions: right, up, forward.
MOVES = {
    "W": (0, 0, 1),
    "S": (0, 0, -1),
    "A": (-1, 0, 0),
    "D": (1, 0, 0),
    "E": (0, 1, 0),
    "Q": (0, -1, 0),
}
#: Key positions that turn the view: right and up.
LOOKS = {"Up": (0, 1), "Down": (0, -1), "Left": (-1, 0), "Right": (1, 0)}
RADIANS_A_PIXEL = 0.0025
#: Turning speed of the arrow keys.
RADIANS_A_SECOND = 1.6
#: Scene radii per second; the factor of Shift, and the factor per wheel step.
RADII_A_SECOND = 0.6
FAST = 4.0
SPEED_STEP = 1.15
#: Looking straight up would leave no heading to walk along.
MAX_PITCH = QUARTER_TURN - 0.01


class FpsController:
    """A walking camera without a ground.

    Parameters
    ----------
    view : Viewpoint
        The start; also gives the up direction and the field of view.
    bounds : Sphere
        The scene's bounds; its radius determines the walking speed.
    """

    def __init__(self, view: Viewpoint, bounds: Sphere):
        self.bounds = bounds
        self.speed = RADII_A_SECOND * bounds.radius
        self.enter(view)

    def enter(self, view: Viewpoint) -> None:
        """Take over the position and direction of ``view``."""
        self.position = view.position()
        self.up = view.up
        self.yaw = view.azimuth
        self.pitch = max(-MAX_PITCH, min(MAX_PITCH, -view.elevation))

    def leave(self, view: Viewpoint) -> None:
        """Move ``view`` to the walker; its target is ahead, at the scene's distance."""
        self.place(view)
        ahead = -view.rotation()[:, 2]
        to_center = np.array(self.bounds.center) - self.position
        reach = float(to_center[0] * ahead[0] + to_center[1] * ahead[1] + to_center[2] * ahead[2])
        view.distance = min(MAX_DISTANCE, max(reach, 0.1 * self.bounds.radius))
        view.target = self.position + ahead * view.distance

    def place(self, view: Viewpoint) -> None:
        """Set ``view`` to the walker's position and angles, and keep its distance."""
        view.azimuth = self.yaw
        view.elevation = -self.pitch
        view.target = self.position - view.rotation()[:, 2] * view.distance

    def look(self, dx: float, dy: float) -> None:
        """Turn by a mouse movement of (dx, dy) pixels."""
        self._turn(dx * RADIANS_A_PIXEL, -dy * RADIANS_A_PIXEL)

    def _turn(self, right: float, up: float) -> None:
        self.yaw = math.remainder(self.yaw - right, 2 * math.pi)
        self.pitch = max(-MAX_PITCH, min(MAX_PITCH, self.pitch + up))

    def change_speed(self, steps: float) -> None:
        """Increase the walking speed (decrease it if negative)."""
        self.speed *= SPEED_STEP**steps

    def walk(self, positions: Collection[str], seconds: float, fast: bool = False) -> bool:
        """Move and turn for ``seconds`` according to the pressed keys.

        Parameters
        ----------
        positions : set of str
            Pressed keys, by position (see `MOVES` and `LOOKS`).
        seconds : float
            Time since the last call.
        fast : bool
            Whether Shift is pressed.

        Returns
        -------
        bool
            Whether the walker moved or turned.
        """
        turns = [LOOKS[key] for key in positions if key in LOOKS]
        across, rise = (sum(turn[axis] for turn in turns) for axis in range(2))
        if across or rise:
            self._turn(across * RADIANS_A_SECOND * seconds, rise * RADIANS_A_SECOND * seconds)
        steps = [MOVES[key] for key in positions if key in MOVES]
        right, up, ahead = (sum(step[axis] for step in steps) for axis in range(3))
        reach = self.speed * (FAST if fast else 1.0) * seconds
        return self._move((right, up, ahead), reach, seconds) or bool(across or rise)

    def _move(self, way: tuple[int, int, int], reach: float, seconds: float) -> bool:
        """Move ``reach`` units along right, up and forward; return whether that moves at all."""
        length = math.sqrt(sum(part * part for part in way))
        if not length:
            return False
        heading = self._heading()
        step = heading[0] * way[0] + heading[1] * way[1] + heading[2] * way[2]
        self.position = self.position + step * (reach / length)
        return True

    def _heading(self) -> np.ndarray:
        """Return right, up and forward as rows: forward follows the view, up the world."""
        side, up, back = home_axes(self.up)
        sin_y, cos_y = math.sin(self.yaw), math.cos(self.yaw)
        level = -(side * sin_y + back * cos_y)
        right = side * cos_y - back * sin_y
        forward = level * math.cos(self.pitch) + up * math.sin(self.pitch)
        return np.array([right, up, forward])
