"""The help over the picture: keys and gestures, in columns or pages.

In: a `Canvas` over the frame's pixels and the number of a page. Out: the same pixels, drawn on.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from typing import TypeAlias

from ...base.language import translated, translated_keys
from ...rendering.fonts.font import Font
from ...stage.overlays.lettering import text_font
from ...stage.overlays.overlay import PADDING, place, text_scale
from ...stage.overlays.theme import DARK, Theme
from ...stage.views.fps import LOOKS, MOVES
from .keymap import GESTURES, SECTIONS, WALKING, WALKING_GESTURES

#: A row is a key and its action; titles and empty rows have no second part.
Row = tuple[str, str]
GAP: Row = ("", "")
#: Returns what the key at a position of a US keyboard types.
KeyAt: TypeAlias = Callable[[str], str]
#: The titles of the sections in each of three columns.
_COLUMNS = (
    ("Walking", "Drawing"),
    ("View", "Mouse"),
    ("Overlays", "Files", "Window"),
)
_MOVEMENTS = {name for name, _ in (*GESTURES, *WALKING_GESTURES)}
#: As wide as the gap between a key and its action, and that between two columns of the help.
KEY_GAP, GUTTER = "nn", "nnn"


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


def help_sections(key_at: KeyAt | None = None) -> list[list[Row]]:
    """Return the sections of the help, each a list of rows; the first row is its title.

    Parameters
    ----------
    key_at : callable, optional
        Given while one walks: it returns what the key at a position of a US keyboard types. Keys
        that walk have no other meaning then.
    """
    taken = set() if key_at is None else {key_at(position) for position in (*MOVES, *LOOKS)}
    sections = []
    for title, bindings in SECTIONS.items():
        rows = [
            (" ".join(key for key in one.keys if key not in taken), one.help) for one in bindings
        ]
        sections.append([(title, ""), *(row for row in rows if row[0])])
    if key_at is None:
        return [*sections, [("Mouse", ""), *GESTURES]]
    walking = [(" ".join(map(key_at, positions)), text) for positions, text in WALKING]
    return [[("Walking", ""), *walking, *WALKING_GESTURES], *sections]


def help_columns(key_at: KeyAt | None = None) -> list[list[Row]]:
    """Return the help in three columns; parameters as of `help_sections`."""
    sections = {section[0][0]: section for section in help_sections(key_at)}
    return [
        [row for title in column if title in sections for row in (*sections[title], GAP)][:-1]
        for column in _COLUMNS
    ]


def help_lines(
    columns: int, rows: int, page: int = 0, key_at: KeyAt | None = None
) -> tuple[list[str], int]:
    """Return one page of the help as lines of text, and how many pages there are."""
    sections = [_in_language(section) for section in help_sections(key_at)]
    pages = _pages(sections, _Characters(), columns, rows)
    shown = pages[min(page, len(pages) - 1)]
    indent = _indent(shown, _Characters())
    lines = [f"{key:{indent}}{text}" if text else key for key, text in shown]
    return [*lines, _more(page, len(pages))], len(pages)


class _Characters:
    """The measures of a terminal: characters."""

    def width(self, text: str) -> int:
        return len(text)

    def wrapped(self, text: str, width: int) -> list[str]:
        return textwrap.wrap(text, width)


def draw_help(
    canvas,
    page: int = 0,
    scale: int | None = None,
    theme: Theme = DARK,
    key_at: KeyAt | None = None,
) -> int:
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
    key_at : callable, optional
        As of `help_sections`.

    Returns
    -------
    int
        How many pages there are.
    """
    font = text_font(scale or text_scale(canvas))
    inset = 5 * PADDING
    room, rows = canvas.width - inset, (canvas.height - inset) // font.line_height
    columns = [_in_language(column) for column in help_columns(key_at)]
    if _whole_width(columns, font) <= room and max(map(len, columns)) <= rows:
        _draw_columns(canvas, columns, font, theme)
        return 1
    sections = [_in_language(section) for section in help_sections(key_at)]
    pages = _pages(sections, font, room, rows)
    page = min(page, len(pages) - 1)
    _draw_columns(canvas, [[*pages[page], (_more(page, len(pages)), "")]], font, theme)
    return len(pages)


def _in_language(rows: list[Row]) -> list[Row]:
    """Return rows as they are drawn."""
    return [(_keys(key) if text else translated(key), translated(text)) for key, text in rows]


def _keys(text: str) -> str:
    """Return what to press or to move: a gesture, or keys with spaces between them."""
    if text in _MOVEMENTS:
        return translated(text)
    return " ".join(map(translated_keys, text.split(" ")))


def _more(page: int, count: int) -> str:
    return translated(
        "{page} of {count}; H: more" if page + 1 < count else "{page} of {count}; H: close",
        page=page + 1,
        count=count,
    )


def _pages(
    sections: list[list[Row]], ruler: Font | _Characters, room: int, rows: int
) -> list[list[Row]]:
    """Return the help as pages of at most ``rows`` - 1 rows, as wide as the room."""
    rows, pages = max(rows - 1, 2), []
    for title, *entries in sections:
        indent = _indent(entries, ruler)
        page = [title]
        for key, text in entries:
            lines = ruler.wrapped(text, max(room - indent, 1))
            if len(page) + len(lines) > rows and len(page) > 1:
                pages.append(page)
                page = [title]
            page += zip([key, *[""] * (len(lines) - 1)], lines, strict=True)
        if pages and len(pages[-1]) + 1 + len(page) <= rows:
            pages[-1] += [GAP, *page]
        else:
            pages.append(page)
    return pages


def _indent(rows: list[Row], ruler: Font | _Characters) -> int:
    keys = [ruler.width(key) for key, text in rows if text]
    return max(keys) + ruler.width(KEY_GAP) if keys else 0


def _widths(columns: list[list[Row]], font: Font) -> list[int]:
    """Return the width of each column in pixels."""
    return [
        max(
            _indent(column, font) + font.width(text) if text else font.width(key)
            for key, text in column
        )
        for column in columns
    ]


def _whole_width(columns: list[list[Row]], font: Font) -> int:
    return sum(_widths(columns, font)) + font.width(GUTTER) * (len(columns) - 1)


def _draw_columns(canvas, columns: list[list[Row]], font: Font, theme: Theme) -> None:
    width = _whole_width(columns, font) + 4 * PADDING
    height = font.line_height * max(map(len, columns)) + 4 * PADDING
    left, top = place(canvas, width, height, "middle")
    canvas.rectangle(left, top, width, height, theme.block)
    x = left + 2 * PADDING
    for column, column_width in zip(columns, _widths(columns, font), strict=True):
        indent = _indent(column, font)
        for row, (key, text) in enumerate(column):
            y = top + 2 * PADDING + row * font.line_height
            canvas.text(x, y, key, theme.key if text else theme.title, font=font)
            canvas.text(x + indent, y, text, theme.text, font=font)
        x += column_width + font.width(GUTTER)
