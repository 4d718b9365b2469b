"""A panel with sliders, for the mouse and for the arrow keys."""

from __future__ import annotations

from ....stage.overlays.theme import Theme
from ....stage.overlays.ui_scale import scaled
from ..list_panels import Panel

#: Height of a slider's track, and width of its knob, in pixels times the scale.
_TRACK, _KNOB = 4, 8
#: How far an arrow key moves a slider, without Shift and with it.
_STEP, _LONG_STEP = 0.01, 0.1


class SliderPanel(Panel):
    """A panel of rows, one of which is a slider."""

    least_columns = 30
    #: The number of the slider's row.
    slider = 0

    def share(self) -> float:
        """Return where the knob is, from 0 to 1."""
        raise NotImplementedError

    def slide(self, share: float) -> None:
        """Handle a move of the knob."""
        raise NotImplementedError

    def draw(self, canvas, scale: float, theme: Theme) -> None:
        super().draw(canvas, scale, theme)
        row = self.slider - self._first
        if not 0 <= row < self._fit:
            return
        left, width = self._track()
        top = self._box[1] + self._padding + (self._heads + row) * self._row_height
        middle, half = top + self._row_height // 2, scaled(_TRACK / 2, scale)
        canvas.rectangle(left, middle - half, width, 2 * half, theme.text[:3] + (90,))
        knob = scaled(_KNOB, scale)
        place = left + round(self.share() * width) - knob // 2
        canvas.rectangle(place, top + 1, knob, self._row_height - 2, theme.title)

    def _track(self) -> tuple[int, int]:
        """Return the left end and the length of the track, in pixels."""
        return self._box[0] + self._padding, max(self._box[2] - 2 * self._padding, 1)

    def press(self, number: int, alone: bool) -> None:
        if number == self.slider:
            return  # `click` moves the knob
        self.choose(number)

    def choose(self, number: int) -> None:
        """Handle a click on another row."""

    def click(self, x: int, y: int, alone: bool) -> None:
        line = (y - self._box[1] - self._padding) // self._row_height - self._heads
        self._slides = self._first + line == self.slider
        super().click(x, y, alone)
        self.drag(x)

    _slides = False

    def drag(self, x: int) -> None:
        if self._slides:
            left, width = self._track()
            self._slide((x - left) / width)

    def _slide(self, share: float) -> None:
        self.slide(min(max(share, 0.0), 1.0))
        self.viewer.redraw()

    def key(self, event) -> bool:
        steps = {"Left": -1, "Right": 1}
        if event.key in steps and not event.control:
            step = _LONG_STEP if event.shift else _STEP
            self._slide(self.share() + steps[event.key] * step)
            return True
        return super().key(event)
