"""The help over the picture: keys and gestures, in columns or pages.

In: a `Canvas` over the frame's pixels and the number of a page. Out: the same pixels, drawn on.
"""

from __future__ import annotations

import textwrap

from ...rendering.canvas import text_size
from ...stage.overlays.overlay import LINE_GAP, PADDING, place, text_scale
from ...stage.overlays.theme import DARK, Theme
from .keymap import GESTURES, SECTIONS

#: A row is a key and its action; titles and empty rows have no second part.
Row = tuple[str, str]
GAP: Row = ("", "")
#: Columns of text between two columns of the help.
GUTTER = 3


class HelpPages:
    """Whether the help is shown, and its page.

    Attributes
    ----------
    shown : bool
    page, count : int
        From 0 on, and how many there were when it was drawn last.
    """

    def __init__(self) -> None:
        self.shown, self.page, self.count = False, 0, 1

    def turn(self, step: int) -> None:
        """Show the help, or its next or previous page; close it after the last one."""
        page = self.page + step if self.shown else 0
        self.shown = 0 <= page < self.count or not self.shown
        self.page = page


def help_sections() -> list[list[Row]]:
    """Return the sections of the help, each a list of rows; the first row is its title."""
    sections = [
        [(title, ""), *((" ".join(binding.keys), binding.help) for binding in bindings)]
        for title, bindings in SECTIONS.items()
    ]
    return [*sections, [("Mouse", ""), *GESTURES]]


def help_columns() -> list[list[Row]]:
    """Return the help in three columns."""
    drawing, view, overlays, files, window, mouse = help_sections()
    return [drawing, [*view, GAP, *mouse], [*overlays, GAP, *files, GAP, *window]]


def help_lines(columns: int, rows: int, page: int = 0) -> tuple[list[str], int]:
    """Return one page of the help as lines of text, and how many pages there are."""
    pages = _pages(columns, rows)
    shown = pages[min(page, len(pages) - 1)]
    indent = _indent(shown)
    lines = [f"{key:{indent}}{text}" if text else key for key, text in shown]
    return [*lines, _more(page, len(pages))], len(pages)


def draw_help(canvas, page: int = 0, scale: int | None = None, theme: Theme = DARK) -> int:
    """Draw keys and gestures on a block in the middle.

    Parameters
    ----------
    canvas : Canvas
        Over the frame.
    page : int
        Which part, from 0, where not all of it fits.
    scale : int, optional
        Factor on the font's size; by default what suits the picture.
    theme : Theme

    Returns
    -------
    int
        How many pages there are.
    """
    scale = scale or text_scale(canvas)
    cell_width, cell_height = _cell(scale)
    inset = 5 * PADDING
    room = (canvas.width - inset) // cell_width, (canvas.height - inset) // cell_height
    columns = help_columns()
    if sum(_widths(columns)) + GUTTER <= room[0] and max(map(len, columns)) <= room[1]:
        _draw_columns(canvas, columns, scale, theme)
        return 1
    pages = _pages(*room)
    page = min(page, len(pages) - 1)
    _draw_columns(canvas, [[*pages[page], (_more(page, len(pages)), "")]], scale, theme)
    return len(pages)


def _more(page: int, count: int) -> str:
    return f"{page + 1} of {count}; H: " + ("more" if page + 1 < count else "close")


def _cell(scale: int) -> tuple[int, int]:
    width, height = text_size("M", scale)
    return width, height + LINE_GAP * scale


def _pages(columns: int, rows: int) -> list[list[Row]]:
    """Return the help as pages of at most ``rows`` - 1 rows and ``columns`` characters."""
    rows, pages = max(rows - 1, 2), []
    for title, *entries in help_sections():
        indent = _indent(entries)
        page = [title]
        for key, text in entries:
            lines = textwrap.wrap(text, max(columns - indent, 1))
            if len(page) + len(lines) > rows and len(page) > 1:
                pages.append(page)
                page = [title]
            page += zip([key, *[""] * (len(lines) - 1)], lines, strict=True)
        if pages and len(pages[-1]) + 1 + len(page) <= rows:
            pages[-1] += [GAP, *page]
        else:
            pages.append(page)
    return pages


def _indent(rows: list[Row]) -> int:
    return max((len(key) for key, text in rows if text), default=-2) + 2


def _widths(columns: list[list[Row]]) -> list[int]:
    """Return the width of each column in characters."""
    return [
        max(_indent(column) + len(text) if text else len(key) for key, text in column)
        for column in columns
    ]


def _draw_columns(canvas, columns: list[list[Row]], scale: int, theme: Theme) -> None:
    cell_width, cell_height = _cell(scale)
    widths = _widths(columns)
    width = (sum(widths) + GUTTER * (len(columns) - 1)) * cell_width + 4 * PADDING
    height = cell_height * max(map(len, columns)) - LINE_GAP * scale + 4 * PADDING
    left, top = place(canvas, width, height, "middle")
    canvas.rectangle(left, top, width, height, theme.block)
    x = left + 2 * PADDING
    for column, column_width in zip(columns, widths, strict=True):
        indent = _indent(column) * cell_width
        for row, (key, text) in enumerate(column):
            y = top + 2 * PADDING + row * cell_height
            canvas.text(x, y, key, theme.key if text else theme.title, scale=scale)
            canvas.text(x + indent, y, text, theme.text, scale=scale)
        x += (column_width + GUTTER) * cell_width
