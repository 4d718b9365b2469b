"""The ball of axes in the corner of the scene panel: a click looks along an axis.

In: the workspace, the shown frame, the mouse. Out: a picture of the ball on the frame's pixels,
drawn again only if it would change; the turned view.
"""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from .....rendering.canvas import Canvas
from .....rendering.frame import Frame
from .....stage.overlays.axes_ball import RADIUS, BallPlace, draw_ball, tip_at, turn_to
from ....imgui_painter.imgui_painter import ImguiPainter
from ..style import scaled
from ..workspace import Workspace

MARGIN = 8
#: Pictures need to be so many times as large as the ball.
_LEAST = 4


class ClickableAxes:
    """Shows the ball of axes.

    Parameters
    ----------
    workspace : Workspace
    painter : ImguiPainter
        Shows the picture.
    """

    def __init__(self, workspace: Workspace, painter: ImguiPainter) -> None:
        self._workspace, self._painter = workspace, painter
        self._number = 0
        self._drawn: tuple = ()

    def draw(self, frame: Frame, corner, is_hovered: bool) -> bool:
        """Draw the ball in the upper right corner; return whether the mouse is on it.

        Parameters
        ----------
        frame : Frame
            The scene's picture.
        corner : ImVec2
            Where it is in the window.
        is_hovered : bool
            Whether the mouse is on the picture.
        """
        radius = round(scaled(RADIUS))
        side = 2 * radius
        if min(frame.width, frame.height) < _LEAST * radius:
            return False
        margin = round(scaled(MARGIN))
        left, top = frame.width - side - margin, margin
        mouse = imgui.get_io().mouse_pos
        x, y = mouse.x - corner.x - left, mouse.y - corner.y - top
        place = BallPlace(radius, radius, radius)
        rotation = self._workspace.camera()[1][:3, :3]
        is_on = is_hovered and place.covers(x, y)
        lit = tip_at(rotation, place, x, y) if is_on else None
        self._show(frame, (left, top, side), place, rotation, lit, is_on)
        first = corner.x + left, corner.y + top
        last = first[0] + side, first[1] + side
        lines = imgui.get_window_draw_list()
        lines.add_image(imgui.ImTextureRef(self._number), first, last)
        if lit is not None and imgui.is_mouse_clicked(0):
            self._workspace.through.leave()
            turn_to(self._workspace.view, lit)
        return is_on

    def _show(
        self,
        frame: Frame,
        part: tuple[int, int, int],
        place: BallPlace,
        rotation: np.ndarray,
        lit: str | None,
        is_on: bool,
    ) -> None:
        """Draw the ball on the part of the frame below it: left, top, side."""
        key = frame, part, lit, is_on
        if key == self._drawn:
            return
        left, top, side = part
        canvas = Canvas((side, side))
        canvas.pixels[:] = frame.color[top : top + side, left : left + side]
        draw_ball(canvas, rotation, place, lit=lit, is_hovered=is_on)
        if not self._number:
            self._number = self._painter.add(canvas.pixels, opaque=True)
        self._painter.replace(self._number, canvas.pixels, opaque=True)
        self._drawn = key
