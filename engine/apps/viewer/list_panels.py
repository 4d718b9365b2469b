"""Clickable lists over the picture: objects and materials.

In: a viewer, clicks on rows, the wheel. Out: the rows, drawn in a corner.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ...rendering.canvas import text_size
from ...stage.overlays.overlay import LINE_GAP, MARGIN, PADDING, place
from ...stage.overlays.theme import Theme

if TYPE_CHECKING:
    from .state import ViewerState

#: Maximum width of a list in characters.
MOST_COLUMNS = 44
#: Alpha of the bar behind the chosen row.
BAR_ALPHA = 90
HIDDEN, SHOWN = "[ ]", "[x]"


class Row(NamedTuple):
    """A line of a panel: its left and right text."""

    text: str
    detail: str = ""


class Panel:
    """A list of rows.

    Parameters
    ----------
    viewer : ViewerState
        What a click changes.
    """

    title = ""
    hint = ""
    corner = "top right"
    least_columns, most_columns, least_rows = 1, MOST_COLUMNS, 0
    #: The row selected by keys, if keys select rows.
    chosen: int | None = None

    def __init__(self, viewer: ViewerState):
        self.viewer = viewer
        self._heads = 1
        self._follows = True
        self._first = 0
        self._fit = 1
        self._box = (0, 0, 0, 0)
        self._row_height = 1

    def rows(self) -> list[Row]:
        """Return the current rows."""
        raise NotImplementedError

    def press(self, number: int, alone: bool) -> None:
        """Handle a click on a row; ``alone`` means the other button, or Shift."""
        raise NotImplementedError

    def heads(self, left_out: int) -> list[str]:
        """Return the lines above the rows; not all of them may fit."""
        return [self.title + (f"  ({len(self.rows())}, wheel: more)" if left_out else "")]

    def draw(self, canvas, scale: int, theme: Theme) -> None:
        """Draw the rows that fit, from the first visible one."""
        cell_width, cell_height = text_size("M", scale)
        self._row_height = cell_height + LINE_GAP * scale
        seen, heads, blank = self._fitting_rows(canvas)
        room = max(1, (canvas.width - 2 * MARGIN - 2 * PADDING) // cell_width)
        lines = [*heads, *(f"{row.text}  {row.detail}" for row in seen), self.hint]
        columns = min(self.most_columns, max(self.least_columns, *map(len, lines)), room)
        width = columns * cell_width + 2 * PADDING
        height = (len(lines) + blank) * self._row_height + 2 * PADDING
        left, top = place(canvas, width, height, self.corner)
        self._box = left, top, width, height
        canvas.rectangle(left, top, width, height, theme.block)
        if self.chosen is not None and 0 <= self.chosen - self._first < len(seen):
            y = top + PADDING + (len(heads) + self.chosen - self._first) * self._row_height
            bar = (*theme.title[:3], BAR_ALPHA)
            canvas.rectangle(left, y - LINE_GAP * scale // 2, width, self._row_height, bar)
        rows = [_fitted(row, columns) for row in seen] + [""] * blank
        colors = [theme.title] * len(heads) + [theme.text] * len(rows) + [theme.key]
        texts = [*heads, *rows, self.hint]
        for number, (text, color) in enumerate(zip(texts, colors, strict=True)):
            y = top + PADDING + number * self._row_height
            canvas.text(left + PADDING, y, text[:columns], color, scale=scale)

    def lines(self) -> list[str]:
        """Return the list as lines of text."""
        rows = [f"{row.text}  {row.detail}".rstrip() for row in self.rows()]
        return [*self.heads(0), *rows, self.hint]

    def _fitting_rows(self, canvas) -> tuple[list[Row], list[str], int]:
        """Return the rows that fit, the lines above them, and the number of blank ones below."""
        rows, room = self.rows(), (canvas.height - 2 * MARGIN - 2 * PADDING) // self._row_height
        self._heads = len(self.heads(0))
        self._fit = max(1, min(room - self._heads - 1, len(rows)))
        if self.chosen is not None and self._follows:
            self._first = min(max(self._first, self.chosen - self._fit + 1), self.chosen)
        self._first = max(0, min(self._first, len(rows) - self._fit))
        seen = rows[self._first : self._first + self._fit]
        blank = max(0, min(self.least_rows, room - self._heads - 1) - len(seen))
        return seen, self.heads(len(rows) - len(seen)), blank

    def covers(self, x: int, y: int) -> bool:
        """Return whether a pixel belongs to the panel."""
        left, top, width, height = self._box
        return left <= x < left + width and top <= y < top + height

    def click(self, x: int, y: int, alone: bool) -> None:
        """Handle a click at a pixel."""
        line = (y - self._box[1] - PADDING) // self._row_height - self._heads
        if 0 <= line < self._fit and self._first + line < len(self.rows()):
            self.press(self._first + line, alone)
            self.viewer.redraw()

    def scroll(self, steps: float) -> None:
        """Handle the wheel."""
        self._first = max(0, self._first - round(steps))
        self._follows = False
        self.viewer.redraw()

    def key(self, event) -> bool:
        """Handle a pressed key; return whether the panel used it."""
        if event.key != "Escape":
            return False
        self.close()
        return True

    def type(self, text: str) -> None:
        """Handle typed text."""

    def close(self) -> None:
        """Close the panel."""
        self.viewer.panel = None
        self.viewer.redraw()


class ObjectPanel(Panel):
    """The objects of the scene."""

    title = "Objects"
    hint = "click: hide, show; right: alone"

    def rows(self) -> list[Row]:
        return [_row(entry) for entry in self.viewer.view_renderer.visibility.objects()]

    def press(self, number: int, alone: bool) -> None:
        self.viewer.view_renderer.visibility.toggle_object(number, alone)


class MaterialPanel(Panel):
    """The materials of the scene."""

    title = "Materials"
    hint = "click: hide, show; right: alone"

    def rows(self) -> list[Row]:
        return [_row(entry) for entry in self.viewer.view_renderer.visibility.materials()]

    def press(self, number: int, alone: bool) -> None:
        self.viewer.view_renderer.visibility.toggle_material(number, alone)


def _row(entry) -> Row:
    return Row(f"{SHOWN if entry.shown else HIDDEN} {entry.name}", f"{entry.triangles:,}")


def _fitted(row: Row, columns: int) -> str:
    """Return a row fitted to the panel: the text cut at its end, the detail at its front."""
    most = max(columns - len(row.text) - 2, columns // 3)
    detail = row.detail if len(row.detail) <= most else ".." + row.detail[2 - most :]
    most = columns - len(detail) - 2
    text = row.text if len(row.text) <= most else row.text[: max(0, most - 2)] + ".."
    return f"{text}{detail:>{max(0, columns - len(text))}}"
