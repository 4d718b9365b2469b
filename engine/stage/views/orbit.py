"""The orbit controller: mouse drags rotate, pan and dolly a `Viewpoint` around its target.

In: drags and wheel steps in pixels. Out: the view, changed in place. The gestures are those of
three.js's OrbitControls: a drag over the window's height makes one turn; panning and the wheel keep
the point under the pointer.
"""

from __future__ import annotations

import math

from .viewpoint import QUARTER_TURN, Viewpoint

#: Distance factor of one wheel step, or of twenty pixels of a dolly drag.
DOLLY_STEP = 0.95
DOLLY_PIXELS_A_STEP = 20.0
#: More wheel steps at once have no further effect.
MAX_STEPS = 500
MIN_DISTANCE = 1e-6
MAX_DISTANCE = 1e9


class OrbitController:
    """Rotates a view around its target.

    Parameters
    ----------
    view : Viewpoint
        The view to change; may be replaced at any time through the attribute.
    """

    def __init__(self, view: Viewpoint):
        self.view = view

    def rotate(self, dx: float, dy: float, height: int) -> None:
        """Rotate by a drag of (dx, dy) pixels in a window ``height`` pixels high."""
        full_turn = 2 * math.pi / max(height, 1)
        self.turn(-dx * full_turn, dy * full_turn)

    def turn(self, azimuth: float, elevation: float) -> None:
        """Add to the angles (radians); the elevation is clamped at the poles."""
        view = self.view
        view.azimuth = math.remainder(view.azimuth + azimuth, 2 * math.pi)
        view.elevation = max(-QUARTER_TURN, min(QUARTER_TURN, view.elevation + elevation))

    def dolly(
        self, steps: float, at: tuple[int, int] | None = None, size: tuple[int, int] | None = None
    ) -> None:
        """Approach the target by ``steps`` wheel steps; a negative number recedes.

        Parameters
        ----------
        steps : float
        at : (int, int), optional
            A pixel whose point in the target's plane stays fixed.
        size : (int, int), optional
            Width and height of the window in pixels.
        """
        view = self.view
        steps = max(-MAX_STEPS, min(MAX_STEPS, steps))
        before = view.distance
        view.distance = max(MIN_DISTANCE, min(MAX_DISTANCE, before * DOLLY_STEP**steps))
        if at is not None and size is not None:
            nearer = 1.0 - view.distance / before
            dx, dy = ((place - side / 2) * nearer for place, side in zip(at, size, strict=True))
            self._shift(dx, dy, before, size[1])

    def dolly_drag(self, dy: float) -> None:
        """Recede by a downward drag of ``dy`` pixels."""
        self.dolly(-dy / DOLLY_PIXELS_A_STEP)

    def pan(self, dx: float, dy: float, height: int) -> None:
        """Move the target so that it follows a drag of (dx, dy) pixels."""
        self._shift(-dx, -dy, self.view.distance, height)

    def _shift(self, dx: float, dy: float, distance: float, height: int) -> None:
        """Move the target by pixels in a plane at a given distance."""
        view = self.view
        world_a_pixel = 2 * distance * math.tan(view.yfov / 2) / max(height, 1)
        right, up, _ = view.rotation().T * world_a_pixel
        view.target = view.target + right * dx - up * dy
