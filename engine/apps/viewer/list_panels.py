"""Lists over the picture: objects and materials.

In: a viewer, clicks on rows, the wheel, keys. Out: the rows, drawn in a corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from ...base.language import translated, translated_number
from ...rendering.canvas import Canvas
from ...rendering.fonts.fitting import most_kept
from ...rendering.fonts.font import Font
from ...stage.overlays.lettering import text_font
from ...stage.overlays.overlay import MARGIN, PADDING, place
from ...stage.overlays.theme import Theme
from ...stage.overlays.ui_scale import scaled
from .kept_drawing import KeptDrawing

if TYPE_CHECKING:
    from .viewer import Viewer

#: Maximum width of a list, in halves of the font's size: about characters.
MOST_COLUMNS = 44
#: As wide as the least gap between the two texts of a row.
GAP = "nn"
#: Alpha of the bar behind the chosen row.
BAR_ALPHA = 90
HIDDEN, SHOWN = "[ ]", "[x]"
#: The keys that choose a row, or a place.
ENTER = ("Return", "Enter", "Keypad Enter")


class Row(NamedTuple):
    """A line of a panel.

    Attributes
    ----------
    text, detail : str
        On the left and on the right.
    key : str
        Before the detail, aligned with those of other rows.
    is_title, is_lit : bool
        Whether it is a heading, and whether its detail is lit up.
    """

    text: str
    detail: str = ""
    key: str = ""
    is_title: bool = False
    is_lit: bool = False


class Panel:
    """A list of rows.

    Parameters
    ----------
    viewer : Viewer
        What a click changes.
    """

    title = ""
    hint = ""
    corner = "top right"
    least_columns, most_columns, least_rows = 1, MOST_COLUMNS, 0
    #: The row selected by keys, if keys select rows.
    chosen: int | None = None

    def __init__(self, viewer: Viewer):
        self.viewer = viewer
        self._heads = 1
        self._follows = True
        self._first = self._count = 0
        self._fit = 1
        self._box = (0, 0, 0, 0)
        self._kept = KeptDrawing()
        self._widths: dict[Font, _Widths] = {}
        self._row_height = 1
        self._padding, self._margin = PADDING, MARGIN

    def rows(self) -> list[Row]:
        """Return the current rows."""
        raise NotImplementedError

    def press(self, number: int, alone: bool) -> None:
        """Handle a click on a row; ``alone`` means the other button, or Shift."""
        raise NotImplementedError

    def heads(self, left_out: int) -> list[str]:
        """Return the lines above the rows; not all of them may fit."""
        return [translated(self.title) + self.more(left_out)]

    def more(self, left_out: int) -> str:
        """Return a text about rows that do not fit."""
        return f"  {translated('({count}, wheel: more)', count=self._count)}" if left_out else ""

    def draw(self, canvas, scale: float, theme: Theme) -> None:
        """Draw the rows that fit, from the first visible one."""
        font = text_font(scale)
        self._row_height = font.line_height
        self._padding, self._margin = scaled(PADDING, scale), scaled(MARGIN, scale)
        shown, columns = self._shown(canvas, font)
        padding = self._padding
        width = columns.wide + 2 * padding
        height = (len(shown) + 1) * self._row_height + 2 * padding
        left, top = self.place(canvas, width, height, scale)
        self._box = left, top, width, height
        bar = None if self.chosen is None else self.chosen - self._first + self._heads
        shows = shown, columns, bar, translated(self.hint), font, padding, theme
        onto = canvas.pixels[top:, left:]
        self._kept.put(onto, (width, height), shows, lambda kept: _draw_list(kept, *shows))

    def _shown(self, canvas, font: Font) -> tuple[list[Row], _Columns]:
        """Return the lines of the panel, but for the hint, and its columns."""
        rows = self.rows()
        seen, heads, blank = self._fitting_rows(canvas, rows)
        columns = self._columns([*heads, translated(self.hint)], seen, rows, font)
        most = canvas.width - 2 * self._margin - 2 * self._padding
        columns = columns._replace(wide=max(min(columns.wide, most), 1))
        return [Row(head, is_title=True) for head in heads] + seen + [Row("")] * blank, columns

    def place(self, canvas, width: int, height: int, scale: float) -> tuple[int, int]:
        """Return the top left pixel of the panel."""
        return place(canvas, width, height, self.corner, scale)

    def _columns(self, lines: list[str], seen: list[Row], rows: list[Row], font: Font) -> _Columns:
        """Return the widths of the list and its columns in pixels, if there is room."""
        width = self._widths.setdefault(font, _Widths(font))
        gap, unit = width[GAP], round(font.size / 2)
        keys = max((width[row.key] for row in rows if row.key), default=0)
        details = max((width[row.detail] for row in rows), default=0) if keys else 0
        aside = keys + details + 2 * gap
        widths = [
            width[row.text] + (aside if keys else gap + width[row.detail])
            for row in seen
            if not row.is_title
        ]
        wide = max([self.least_columns * unit, *(width[line] for line in lines), *widths])
        return _Columns(min(self.most_columns * unit, wide), keys, details)

    def lines(self) -> list[str]:
        """Return the list as lines of text."""
        rows = ["  ".join(filter(None, (row.text, row.key, row.detail))) for row in self.rows()]
        return [*self.heads(0), *rows, translated(self.hint)]

    def _fitting_rows(self, canvas, rows: list[Row]) -> tuple[list[Row], list[str], int]:
        """Return the rows that fit, the lines above them, and the number of blank ones below."""
        self._count, inset = len(rows), 2 * self._margin + 2 * self._padding
        room = (canvas.height - inset) // self._row_height
        self._heads = len(self.heads(0))
        self._fit = max(1, min(room - self._heads - 1, len(rows)))
        if self.chosen is not None and self._follows:
            self._first = min(max(self._first, self.chosen - self._fit + 1), self.chosen)
        self._first = max(0, min(self._first, len(rows) - self._fit))
        seen = rows[self._first : self._first + self._fit]
        blank = max(0, min(self.least_rows, room - self._heads - 1) - len(seen))
        return seen, self.heads(len(rows) - len(seen)), blank

    #: Whether a click beside it closes it.
    closes_beside = False

    def covers(self, x: int, y: int) -> bool:
        """Return whether a pixel belongs to the panel."""
        left, top, width, height = self._box
        return left <= x < left + width and top <= y < top + height

    def click(self, x: int, y: int, alone: bool) -> None:
        """Handle a click at a pixel."""
        line = (y - self._box[1] - self._padding) // self._row_height - self._heads
        if 0 <= line < self._fit and self._first + line < len(self.rows()):
            self.press(self._first + line, alone)
            self.viewer.redraw()

    def drag(self, x: int) -> None:
        """Handle a drag, to a column of the picture, that began with a click on the panel."""

    def mark(self, canvas: Canvas, scale: float, theme: Theme) -> None:
        """Draw what belongs on the picture beside the panel, in terminals as well."""

    #: Whether it uses clicks on the model.
    takes_clicks = False

    def take(self, x: int, y: int) -> bool:
        """Handle a click on the model; return whether the panel used it."""
        return False

    def forget(self) -> None:
        """Forget what belongs to the model that was shown."""

    def scroll(self, steps: float) -> None:
        """Handle the wheel."""
        self._first = max(0, self._first - round(steps))
        self._follows = False
        self.viewer.redraw_controls()

    def key(self, event) -> bool:
        """Handle a pressed key; return whether the panel used it."""
        if event.key != "Escape":
            return False
        self.close()
        return True

    def type(self, text: str) -> None:
        """Handle typed text."""

    def end(self) -> None:
        """Close the panel, and undo what lasts beyond that."""
        self.close()

    def close(self) -> None:
        """Close the panel."""
        self.viewer.panel = None


class ChoosingPanel(Panel):
    """A list whose rows keys choose."""

    def __init__(self, viewer: Viewer):
        super().__init__(viewer)
        self.chosen = 0

    def choices(self) -> Sequence[int]:
        """Return the numbers of the rows that can be chosen."""
        return range(len(self.rows()))

    def key(self, event) -> bool:
        """Choose a row, or press the chosen one: with Shift alone."""
        if event.control:
            return False
        if event.key in ("Up", "Down", "PageUp", "PageDown", "Home", "End"):
            self._move(event.key)
        elif event.key in ENTER:
            if self.chosen in self.choices():
                self.press(self.chosen, event.shift)
                self.viewer.redraw()
        elif not super().key(event):
            return False
        self.viewer.redraw_controls()
        return True

    def _move(self, key: str) -> None:
        """Choose another row, by a key."""
        choices = self.choices()
        if not choices:
            return
        last = len(choices) - 1
        steps = {"Up": -1, "Down": 1, "PageUp": -self._fit, "PageDown": self._fit}
        steps |= {"Home": -last, "End": last}
        now = choices.index(self.chosen) if self.chosen in choices else 0
        self.chosen = choices[min(max(0, now + steps[key]), last)]
        self._follows = True


class ObjectPanel(ChoosingPanel):
    """The objects of the scene."""

    title = "Objects"
    hint = "click, Enter: hide, show; right, Shift: alone"

    def rows(self) -> list[Row]:
        return [_row(entry) for entry in self.viewer.view_renderer.visibility.objects()]

    def press(self, number: int, alone: bool) -> None:
        self.viewer.view_renderer.visibility.toggle_object(number, alone)
        self.viewer.inspector.arrange()  # what is hidden has no cut


class MaterialPanel(ChoosingPanel):
    """The materials of the scene."""

    title = "Materials"
    hint = "click, Enter: hide, show; right, Shift: alone"

    def rows(self) -> list[Row]:
        return [_row(entry) for entry in self.viewer.view_renderer.visibility.materials()]

    def press(self, number: int, alone: bool) -> None:
        self.viewer.view_renderer.visibility.toggle_material(number, alone)


def _row(entry) -> Row:
    return Row(
        f"{SHOWN if entry.shown else HIDDEN} {entry.name}", translated_number(entry.triangles, ",")
    )


class _Widths(dict[str, int]):
    """The widths of texts in a font, each measured once."""

    def __init__(self, font: Font) -> None:
        super().__init__()
        self._font = font

    def __missing__(self, text: str) -> int:
        self[text] = self._font.width(text)
        return self[text]


class _Columns(NamedTuple):
    """The width of a list and, where rows have keys, of the columns of keys and of details."""

    wide: int
    keys: int
    details: int


def _draw_list(
    canvas: Canvas,
    rows: list[Row],
    columns: _Columns,
    bar: int | None,
    hint: str,
    font: Font,
    padding: int,
    theme: Theme,
) -> None:
    """Draw a list that fills a canvas: its rows, a bar behind one of them, and a hint."""
    canvas.clear((*theme.block[:3], 255))
    if bar is not None and 0 <= bar < len(rows):
        color, y = (*theme.title[:3], BAR_ALPHA), padding + bar * font.line_height
        canvas.rectangle(0, y, canvas.width, font.line_height, color)
    y = padding
    for row in rows:
        _draw_row(canvas, (padding, y), row, columns, font, theme)
        y += font.line_height
    canvas.text(padding, y, font.fitted(hint, columns.wide), theme.key, font=font)


def _draw_row(
    canvas, at: tuple[int, int], row: Row, columns: _Columns, font: Font, theme: Theme
) -> None:
    x, y = at
    right, wide, gap = row.detail, columns.wide, font.width(GAP)
    if columns.keys:
        keys_x = max(wide - columns.details - gap - columns.keys, wide // 3)
        text = font.fitted(row.text, wide if row.is_title else max(keys_x - gap, 0))
        canvas.text(x + keys_x, y, row.key, theme.key, font=font)
        right = font.fitted(row.detail, max(wide - keys_x - columns.keys - gap, 0))
    else:
        text, right = fitted(row, wide, font)
    canvas.text(x, y, text, theme.title if row.is_title else theme.text, font=font)
    color = theme.title if row.is_lit else theme.text
    canvas.text(x + wide - font.width(right), y, right, color, font=font)


def fitted(row: Row, width: int, font: Font) -> tuple[str, str]:
    """Return a row's texts that fit: the left one cut at its end, the right one at its front."""
    if not row.detail:
        return font.fitted(row.text, width), ""
    gap, detail = font.width(GAP), row.detail
    most = max(width - font.width(row.text) - gap, width // 3)
    if font.width(detail) > most:
        count = len(detail)
        kept = most_kept(lambda end: "…" + row.detail[count - end :], count, most, font.width)
        detail = "…" + detail[count - max(kept, 0) :]
    return font.fitted(row.text, max(width - font.width(detail) - gap, 0)), detail
