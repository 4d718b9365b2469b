"""Pointing at the model by keys: what clicks do, without a mouse.

In: arrow keys and Enter. Out: a cross over the picture that they move, and clicks where it is.
"""

from __future__ import annotations

from ....base.language import translated
from ....rendering.canvas import Canvas
from ....stage.overlays.theme import Theme
from ....stage.overlays.ui_scale import scaled
from ....stage.views.fps import LOOKS
from ..list_panels import ENTER, Panel, Row

#: How far an arrow key moves the cross, in heights of the picture: with Shift, and without.
_LONG_STEP, _STEP = 1 / 18, 1 / 180
#: Half the length of the cross's arms, and the hole in its middle, in pixels times the scale.
_ARM, _HOLE = 14, 3


class PointingPanel(Panel):
    """Moves a cross over the picture, and clicks there.

    Parameters
    ----------
    viewer : Viewer
    """

    title = "Point by keys"
    hint = "arrows: move (Shift: faster); Escape: end"
    #: Whether the cross is there from the start; else it comes with the first key.
    shows_cross = True

    def __init__(self, viewer) -> None:
        super().__init__(viewer)
        self._at: tuple[float, float] | None = (0.5, 0.5) if self.shows_cross else None

    def rows(self) -> list[Row]:
        return [
            Row(translated("select what is there"), key=translated("Enter")),
            Row(translated("turn round what is there"), key=translated("Shift+Enter")),
        ]

    def press(self, number: int, alone: bool) -> None:
        self.point(*self._pixel(), number == 1)

    def point(self, x: int, y: int, shift: bool) -> None:
        """Do what a click at a pixel does; with Shift, a double click."""
        viewer = self.viewer
        if not shift:
            viewer.select(x, y)
        elif viewer.walker is None and viewer.focus(x, y):
            self._at = (0.5, 0.5)  # where the place now is

    def key(self, event) -> bool:
        if event.control or event.key not in (*LOOKS, *ENTER):
            return super().key(event)
        if event.key in ENTER:
            self.point(*self._pixel(), event.shift)
            self.viewer.redraw()
        else:
            self._move(*LOOKS[event.key], _LONG_STEP if event.shift else _STEP)
            self.viewer.redraw_controls()
        return True

    def _move(self, right: int, up: int, step: float) -> None:
        width, height = self.viewer.view_renderer.size
        x, y = self._place()
        x, y = x + right * step * height / width, y - up * step
        self._at = min(max(x, 0.0), 1.0), min(max(y, 0.0), 1.0)

    def _place(self) -> tuple[float, float]:
        """Return where the cross is, as shares of the picture; it comes if it was not there."""
        if self._at is None:
            self._at = (0.5, 0.5)
        return self._at

    def _pixel(self) -> tuple[int, int]:
        (x, y), (width, height) = self._place(), self.viewer.view_renderer.size
        return min(int(x * width), width - 1), min(int(y * height), height - 1)

    def mark(self, canvas: Canvas, scale: float, theme: Theme) -> None:
        if self._at is None:
            return
        x, y = self._pixel()
        arm, hole = scaled(_ARM, scale), scaled(_HOLE, scale)
        for edge, color in ((1, theme.block), (0, theme.title)):
            thick = 1 + 2 * edge
            for near, far in ((-arm, -hole), (hole, arm)):
                start, length = near - edge, far - near + thick
                canvas.rectangle(x + start, y - edge, length, thick, (*color[:3], 255))
                canvas.rectangle(x - edge, y + start, thick, length, (*color[:3], 255))
