"""Lists over the picture that the mouse works on: objects, materials, files opened before.

In: a viewer, clicks on rows, the wheel over them. Out: the rows, drawn in the top right corner.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, NamedTuple

from ..canvas import text_size
from .overlay import LINE_GAP, MARGIN, PADDING
from .recent_files import recent_files
from .theme import Theme

if TYPE_CHECKING:
    from .viewer import Viewer

#: A panel is not wider than so many characters.
MOST_COLUMNS = 44
HIDDEN, SHOWN = "[ ]", "[x]"


class Row(NamedTuple):
    """A line of a panel: what stands on the left, and on the right."""

    text: str
    detail: str = ""


class Panel:
    """A list of rows.

    Parameters
    ----------
    viewer : Viewer
        What a click changes.
    """

    title = ""
    hint = ""

    def __init__(self, viewer: Viewer):
        self.viewer = viewer
        self._first = 0
        self._fit = 1
        self._box = (0, 0, 0, 0)
        self._row_height = 1

    def rows(self) -> list[Row]:
        """Return the rows as they are now."""
        raise NotImplementedError

    def press(self, number: int, alone: bool) -> None:
        """Obey a click on a row; ``alone`` is the other button, or Shift."""
        raise NotImplementedError

    def draw(self, canvas, scale: int, theme: Theme) -> None:
        """Draw the rows that fit, from the first that shows."""
        cell_width, cell_height = text_size("M", scale)
        self._row_height = cell_height + LINE_GAP * scale
        rows = self.rows()
        room = (canvas.height - 2 * MARGIN - 2 * PADDING) // self._row_height - 2
        self._fit = max(1, min(room, len(rows)))
        self._first = max(0, min(self._first, len(rows) - self._fit))
        seen = rows[self._first : self._first + self._fit]
        more = len(rows) - len(seen)
        head = self.title + (f"  ({len(rows)}, wheel: more)" if more else "")
        lines = [head, *(f"{row.text}  {row.detail}" for row in seen), self.hint]
        columns = min(MOST_COLUMNS, max(map(len, lines)))
        columns = max(1, min(columns, (canvas.width - 2 * MARGIN - 2 * PADDING) // cell_width))
        width = columns * cell_width + 2 * PADDING
        height = len(lines) * self._row_height + 2 * PADDING
        left, top = canvas.width - width - MARGIN, MARGIN
        self._box = left, top, width, height
        canvas.rectangle(left, top, width, height, theme.block)
        colors = [theme.title, *[theme.text] * len(seen), theme.key]
        texts = [head, *(_fitted(row, columns) for row in seen), self.hint]
        for number, (text, color) in enumerate(zip(texts, colors, strict=True)):
            y = top + PADDING + number * self._row_height
            canvas.text(left + PADDING, y, text[:columns], color, scale=scale)

    def covers(self, x: int, y: int) -> bool:
        """Return whether a pixel is the panel's."""
        left, top, width, height = self._box
        return left <= x < left + width and top <= y < top + height

    def click(self, x: int, y: int, alone: bool) -> None:
        """Obey a click at a pixel."""
        line = (y - self._box[1] - PADDING) // self._row_height - 1
        if 0 <= line < self._fit and self._first + line < len(self.rows()):
            self.press(self._first + line, alone)
            self.viewer.changed = True

    def scroll(self, steps: float) -> None:
        """Obey the wheel."""
        self._first = max(0, self._first - round(steps))
        self.viewer.changed = True


class ObjectPanel(Panel):
    """The objects of the scene."""

    title = "Objects"
    hint = "click: hide, show; right: alone"

    def rows(self) -> list[Row]:
        return [_row(entry) for entry in self.viewer.visibility.objects()]

    def press(self, number: int, alone: bool) -> None:
        self.viewer.visibility.toggle_object(number, alone)


class MaterialPanel(Panel):
    """The materials of the scene."""

    title = "Materials"
    hint = "click: hide, show; right: alone"

    def rows(self) -> list[Row]:
        return [_row(entry) for entry in self.viewer.visibility.materials()]

    def press(self, number: int, alone: bool) -> None:
        self.viewer.visibility.toggle_material(number, alone)


class RecentPanel(Panel):
    """The files that were opened last."""

    title = "Opened before"
    hint = "click: open"

    def __init__(self, viewer: Viewer):
        super().__init__(viewer)
        self._paths = recent_files()

    def rows(self) -> list[Row]:
        return [Row(os.path.basename(path), os.path.dirname(path)) for path in self._paths]

    def press(self, number: int, alone: bool) -> None:
        self.viewer.panel = None
        self.viewer.opening.open([self._paths[number]])


def _row(entry) -> Row:
    return Row(f"{SHOWN if entry.shown else HIDDEN} {entry.name}", f"{entry.triangles:,}")


def _fitted(row: Row, columns: int) -> str:
    """Return a row as wide as the panel: the text cut at its end, the detail at its front."""
    most = max(columns - len(row.text) - 2, columns // 3)
    detail = row.detail if len(row.detail) <= most else ".." + row.detail[2 - most :]
    most = columns - len(detail) - 2
    text = row.text if len(row.text) <= most else row.text[: max(0, most - 2)] + ".."
    return f"{text}{detail:>{max(0, columns - len(text))}}"
