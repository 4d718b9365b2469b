"""Clickable lists over the picture: objects and materials.

In: a viewer, clicks on rows, the wheel. Out: the rows, drawn in a corner.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ...base.language import translated, translated_number
from ...rendering.fonts.fitting import most_kept
from ...rendering.fonts.font import Font
from ...stage.overlays.lettering import text_font
from ...stage.overlays.overlay import MARGIN, PADDING, place
from ...stage.overlays.theme import Theme

if TYPE_CHECKING:
    from .state import ViewerState

#: Maximum width of a list, in halves of the font's size: about characters.
MOST_COLUMNS = 44
#: As wide as the least gap between the two texts of a row.
GAP = "nn"
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
        return [translated(self.title) + self.count_told(left_out)]

    def count_told(self, left_out: int) -> str:
        """Return what the title says of rows that do not fit."""
        return (
            "  " + translated("({count}, wheel: more)", count=len(self.rows())) if left_out else ""
        )

    def draw(self, canvas, scale: int, theme: Theme) -> None:
        """Draw the rows that fit, from the first visible one."""
        font = text_font(scale)
        self._row_height = font.line_height
        seen, heads, blank = self._fitting_rows(canvas)
        hint = translated(self.hint)
        wide = self._width([*heads, hint], seen, font)
        wide = max(min(wide, canvas.width - 2 * MARGIN - 2 * PADDING), 1)
        width = wide + 2 * PADDING
        height = (len(heads) + len(seen) + blank + 1) * self._row_height + 2 * PADDING
        left, top = place(canvas, width, height, self.corner)
        self._box = left, top, width, height
        canvas.rectangle(left, top, width, height, theme.block)
        if self.chosen is not None and 0 <= self.chosen - self._first < len(seen):
            y = top + PADDING + (len(heads) + self.chosen - self._first) * self._row_height
            bar = (*theme.title[:3], BAR_ALPHA)
            canvas.rectangle(left, y, width, self._row_height, bar)
        rows = [Row(head) for head in heads] + seen + [Row("")] * blank + [Row(hint)]
        colors = [theme.title] * len(heads) + [theme.text] * (len(seen) + blank) + [theme.key]
        for number, (row, color) in enumerate(zip(rows, colors, strict=True)):
            x, y = left + PADDING, top + PADDING + number * self._row_height
            text, detail = fitted(row, wide, font)
            canvas.text(x, y, text, color, font=font)
            canvas.text(x + wide - font.width(detail), y, detail, color, font=font)

    def _width(self, lines: list[str], rows: list[Row], font: Font) -> int:
        """Return the width of the list's texts in pixels, if there is room."""
        gap, unit = font.width(GAP), round(font.size / 2)
        widths = [font.width(row.text) + gap + font.width(row.detail) for row in rows]
        wide = max([self.least_columns * unit, *map(font.width, lines), *widths])
        return min(self.most_columns * unit, wide)

    def lines(self) -> list[str]:
        """Return the list as lines of text."""
        rows = [f"{row.text}  {row.detail}".rstrip() for row in self.rows()]
        return [*self.heads(0), *rows, translated(self.hint)]

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
    return Row(
        f"{SHOWN if entry.shown else HIDDEN} {entry.name}", translated_number(entry.triangles, ",")
    )


def fitted(row: Row, width: int, font: Font) -> Row:
    """Return a row that fits: the text cut at its end, the detail at its front."""
    if not row.detail:
        return Row(font.fitted(row.text, width))
    gap, detail = font.width(GAP), row.detail
    most = max(width - font.width(row.text) - gap, width // 3)
    if font.width(detail) > most:
        count = len(detail)
        kept = most_kept(lambda end: "…" + row.detail[count - end :], count, most, font.width)
        detail = "…" + detail[count - max(kept, 0) :]
    return Row(font.fitted(row.text, max(width - font.width(detail) - gap, 0)), detail)
