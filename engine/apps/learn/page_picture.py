"""Draws the page of a lesson: the picture on the left, idea, code and exercise on the right.

In: a session and the size of the window. Out: pixels, and the places that the mouse may press. All
letters have one size, which follows the screen's scale; pictures fill what is left.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from ...rendering.canvas import Canvas
from ...rendering.fonts.font import font
from .code_colors import COLORS, colored
from .course_session import Session
from .lesson_programs import Listing
from .rich_text import Span, paragraphs, wrapped
from .words import say, told_keys

#: Pixels of the em in a window of the usual size, on a screen of the usual density.
TYPE, LEAST_TYPE, USUAL_SIZE = 14, 12, (1240, 720)
#: Columns of code that have room.
CODE_COLUMNS = 72
PAPER, INK, QUIET = (30, 33, 40), (226, 228, 230), (150, 158, 172)
ACCENT, BAR, PANEL = (255, 200, 0), (58, 62, 44), (38, 42, 51)
GOOD, BAD = (130, 210, 130), (240, 140, 110)
_SPAN_COLORS = {"bold": ACCENT, "code": COLORS["number"]}
_MOODS = {"right": GOOD, "wrong": BAD, "plain": QUIET}
_LEAST_PICTURE = 240

Box = tuple[int, int, int, int]


@dataclass
class Page:
    """A drawn page.

    Attributes
    ----------
    pixels : (H, W, 4) uint8
    places : list of (box, function)
        What the left button does there; boxes are (left, top, right, bottom).
    overflow : int
        Lines of the column of text that are below the window.
    """

    pixels: np.ndarray
    places: list[tuple[Box, Callable[[], object]]] = field(default_factory=list)
    overflow: int = 0

    def press(self, x: int, y: int) -> bool:
        """Do what the left button does at a place; return whether it does anything."""
        for (left, top, right, bottom), act in self.places:
            if left <= x < right and top <= y < bottom:
                act()
                return True
        return False


class _Pen:
    """Writes on a canvas in one size of type, from the top down."""

    def __init__(self, canvas: Canvas, left: int, top: int, width: int, size: int) -> None:
        self.canvas, self.left, self.y, self.width = canvas, left, top, max(width, 1)
        self.sans, self.mono = font("sans", size), font("mono", size)
        self.line = self.sans.line_height

    def width_of(self, text: str, kind: str) -> int:
        return (self.mono if kind == "code" else self.sans).width(text)

    def row(self, text: str, color: tuple[int, int, int] = INK) -> None:
        """Write a line, cut off where there is no more room."""
        shown = self.sans.fitted(text, self.width)
        self.canvas.text(self.left, self.y, shown, color, font=self.sans)
        self.y += self.line

    def paragraph(self, text: str) -> None:
        """Write a text of a lesson, with room below each paragraph."""
        for spans in paragraphs(text):
            for line in wrapped(spans, self.width_of, self.width):
                self.spans(line, INK)
            self.y += self.line // 3

    def spans(self, line: Sequence[Span], color: tuple[int, int, int]) -> None:
        """Write a line of spans; its plain text has a colour of its own."""
        x = self.left
        for part, kind in line:
            face = self.mono if kind == "code" else self.sans
            self.canvas.text(x, self.y, part, _SPAN_COLORS.get(kind, color), font=face)
            x += self.width_of(part, kind)
        self.y += self.line

    def heading(self, text: str) -> None:
        self.row(text, ACCENT)
        self.y += self.line // 6

    def code(self, lines: Sequence[str], marked: range) -> None:
        """Write lines of Python, those that the step explains on a bar."""
        advance = self.mono.width(" ")
        for number, parts in enumerate(colored(lines)):
            if number in marked:
                box = self.left - advance, self.y, self.width + 2 * advance, self.line
                self.canvas.rectangle(*box, BAR)
                self.canvas.rectangle(box[0], box[1], 3, box[3], ACCENT)
            x = self.left
            for text, kind in parts:
                self.canvas.text(x, self.y, text, COLORS[kind], font=self.mono)
                x += advance * len(text)
            self.y += self.line


def draw_page(
    session: Session,
    size: tuple[int, int],
    scale: float = 1.0,
    scroll: int = 0,
    copy: Callable[[], object] | None = None,
) -> Page:
    """Draw the page of the step that a session is at.

    Parameters
    ----------
    session : Session
    size : (int, int)
        Of the window.
    scale : float
        Of the screen: how many times as large letters are, in pixels, as on a usual one.
    scroll : int
        Lines by which the column of text is moved up.
    copy : callable, optional
        What a press on the code does.
    """
    type_size = _type_size(size, scale)
    canvas = Canvas(size)
    canvas.clear(PAPER)
    page = Page(canvas.pixels)
    gap = type_size
    pen = _Pen(canvas, gap, gap // 2, size[0] - 2 * gap, type_size)
    _head_and_foot(pen, session, size, gap)
    top, bottom = pen.line + gap, size[1] - pen.line - gap
    if session.shows_help:
        _help(pen, session.language, top)
    elif session.is_at_end:
        pen.y = top
        pen.heading(say("end", session.language))
        pen.paragraph(say("after", session.language))
    else:
        wanted = max(int(0.44 * size[0]), CODE_COLUMNS * pen.mono.width(" ") + 2 * gap)
        column = min(wanted, max(size[0] - _LEAST_PICTURE, size[0] // 2))
        left = size[0] - column
        _picture_column(page, canvas, session, (gap, top, left - gap, bottom), type_size)
        _text_column(page, canvas, session, (left, top, size[0], bottom), (type_size, scroll), copy)
    return page


def _type_size(size: tuple[int, int], scale: float) -> int:
    """Return pixels of the em: letters grow with the window, as pictures do, for a projector.

    In a narrow window they shrink to what leaves room for a picture beside the code.
    """
    larger = min(side / (scale * usual) for side, usual in zip(size, USUAL_SIZE, strict=True))
    return min(round(TYPE * scale * max(larger, 1.0)), max(size[0] // CODE_COLUMNS, LEAST_TYPE))


def _head_and_foot(pen: _Pen, session: Session, size: tuple[int, int], gap: int) -> None:
    canvas = pen.canvas
    canvas.rectangle(0, 0, size[0], pen.line + gap, PANEL)
    place = "" if session.is_at_end else session.place
    room = pen.sans.width(place)
    canvas.text(size[0] - gap - room, pen.y, place, INK, font=pen.sans)
    title = pen.sans.fitted(session.title, max(size[0] - 3 * gap - room, 0))
    canvas.text(gap, pen.y, title, ACCENT, font=pen.sans)
    pen.y = size[1] - pen.line - gap // 2
    (keys,) = paragraphs(say("keys", session.language))
    pen.spans(wrapped(keys, pen.width_of, pen.width)[0], QUIET)


def _help(pen: _Pen, language: str, top: int) -> None:
    pen.y = top
    pen.heading(say("help", language))
    across = max(pen.mono.width(keys) for keys, _ in told_keys(language)) + pen.line
    for keys, meaning in told_keys(language):
        pen.canvas.text(pen.left, pen.y, keys, COLORS["number"], font=pen.mono)
        pen.canvas.text(pen.left + across, pen.y, meaning, INK, font=pen.sans)
        pen.y += pen.line + pen.line // 4


def _picture_column(page: Page, canvas: Canvas, session: Session, box: Box, type_size: int) -> None:
    """Draw the pictures, below them caption, parameters, and what comes next."""
    left, top, right, bottom = box
    pen = _Pen(canvas, left, 0, right - left, type_size)
    step, parameters = session.step, session.texts.parameters
    caption = pen.sans.wrapped(step.caption, pen.width)
    rows = max(len(caption), 2) + len(parameters) + bool(parameters) + 1
    pen.y = bottom - rows * pen.line
    below = pen.y - type_size // 2
    _pictures(canvas, step.shown, (left, top, right, below), type_size)
    for line in caption:
        pen.row(line)
    pen.y = bottom - (len(parameters) + bool(parameters) + 1) * pen.line
    if parameters:
        pen.row(say("parameters", session.language), ACCENT)
    for number, parameter in enumerate(parameters):
        _parameter_row(page, pen, session, number, parameter.labels[session.language])
    if session.next_title is not None:
        pen.row(f"{say('next', session.language, session.next_title)} ›", GOOD)
        row = (left, pen.y - pen.line, right, pen.y)
        page.places.append((row, session.open_next))


def _parameter_row(page: Page, pen: _Pen, session: Session, number: int, label: str) -> None:
    """Write a parameter between two arrows, which the mouse may press."""
    parameter = session.texts.parameters[number]
    x, arrow = pen.left, pen.sans.width(" ‹ ")
    value = session.word(session.values[parameter.name])
    chosen = ACCENT if number == session.chosen else INK
    for text, by in ((" ‹ ", -1), (value, 0), (" › ", 1)):
        pen.canvas.text(x, pen.y, text, chosen, font=pen.sans)
        wide = pen.sans.width(text)
        if by:
            place = (x, pen.y, x + max(wide, arrow), pen.y + pen.line)
            page.places.append((place, partial(session.change, by, number)))
        x += wide
    pen.canvas.text(x + arrow, pen.y, label, INK, font=pen.sans)
    pen.y += pen.line


def _pictures(
    canvas: Canvas, shown: Sequence[np.ndarray | Listing], box: Box, type_size: int
) -> None:
    """Draw what a step shows side by side or one below the other, whichever is larger."""
    left, top, right, bottom = box
    room = max(right - left, 1), max(bottom - top, 1)
    gap = type_size
    if any(isinstance(one, Listing) for one in shown):
        y = top + gap // 2
        for one in shown:
            if isinstance(one, Listing):
                face = font("mono", type_size)
                text = "\n".join(one.lines[: room[1] // face.line_height])
                canvas.text(left, y, text, INK, font=face)
                y += face.line_height * len(one.lines)
        return
    picture = beside_or_below([one for one in shown if not isinstance(one, Listing)], room, gap)
    high, wide = picture.shape[:2]
    x, y = left + (room[0] - wide) // 2, top + (room[1] - high) // 2
    _put(canvas.pixels, picture, x, y)


def _put(pixels: np.ndarray, picture: np.ndarray, x: int, y: int) -> None:
    """Copy the colours of a picture to a place, as far as it fits: windows may be tiny."""
    part = pixels[max(y, 0) :, max(x, 0) :, :3][: picture.shape[0], : picture.shape[1]]
    part[:] = picture[: part.shape[0], : part.shape[1], :3]


def beside_or_below(pictures: Sequence[np.ndarray], room: tuple[int, int], gap: int) -> np.ndarray:
    """Return pictures side by side or one below the other, as large as there is room for.

    Parameters
    ----------
    pictures : sequence of (H, W, 3) uint8
    room : (int, int)
        Width and height.
    gap : int
        Pixels between two.
    """
    wide, high = [p.shape[1] for p in pictures], [p.shape[0] for p in pictures]
    gaps = gap * (len(pictures) - 1)
    beside = min((room[0] - gaps) / sum(wide), room[1] / max(high))
    below = min(room[0] / max(wide), (room[1] - gaps) / sum(high))
    factor = max(beside, below, 1.0 / max(*wide, *high))
    large = [enlarged(picture, factor) for picture in pictures]
    axis = 1 if beside >= below else 0
    side = max(one.shape[1 - axis] for one in large)
    parts = []
    for one in large:
        shape = [gap, gap, 3]
        shape[1 - axis] = side
        parts += [_padded(one, 1 - axis, side), np.full(shape, PAPER, np.uint8)]
    return np.concatenate(parts[:-1], axis=axis)[: room[1], : room[0]]


def _padded(picture: np.ndarray, axis: int, length: int) -> np.ndarray:
    """Return a picture in the middle of paper that is longer along an axis."""
    before = (length - picture.shape[axis]) // 2
    shape = list(picture.shape)
    shape[axis] = length
    paper = np.full(shape, PAPER, np.uint8)
    place = [slice(None), slice(None)]
    place[axis] = slice(before, before + picture.shape[axis])
    paper[tuple(place)] = picture
    return paper


def enlarged(picture: np.ndarray, factor: float) -> np.ndarray:
    """Return a picture enlarged by any factor; its pixels stay squares with sharp borders."""
    from PIL import Image

    height, width = picture.shape[:2]
    size = max(int(width * factor), 1), max(int(height * factor), 1)
    times = max(-(-size[0] // width), 1)
    large = picture.repeat(times, axis=0).repeat(times, axis=1)
    return np.asarray(Image.fromarray(large).resize(size, Image.Resampling.BOX))


def _text_column(
    page: Page,
    canvas: Canvas,
    session: Session,
    box: Box,
    type_and_scroll: tuple[int, int],
    copy: Callable[[], object] | None,
) -> None:
    """Draw idea, code and exercise; note what is below the window."""
    left, top, right, bottom = box
    type_size, scroll = type_and_scroll
    room, width = max(bottom - top, 1), right - left
    _, end = _write_texts(Canvas((width, 1)), session, type_size)  # to know how long it is
    column = Canvas((width, max(end, room)))
    column.clear(PANEL)
    (code_top, code_bottom), _ = _write_texts(column, session, type_size)
    line = font("sans", type_size).line_height
    below = max(end - room, 0)
    page.overflow = -(-below // line)
    moved = min(scroll * line, below)
    _put(canvas.pixels, column.pixels[moved : moved + room], left, top)
    if copy is not None:
        code = max(code_top - moved, 0) + top, min(code_bottom - moved + top, bottom)
        page.places.append(((left, code[0], right, code[1]), copy))
    if moved < below:
        arrow, sans = Canvas(canvas.pixels), font("sans", type_size)
        arrow.text(right - 2 * type_size, bottom - line, "↓", ACCENT, font=sans)


def _write_texts(column: Canvas, session: Session, type_size: int) -> tuple[tuple[int, int], int]:
    """Write idea, code and exercise; return where the code begins and ends, and the end of all."""
    texts, language = session.texts, session.language
    pen = _Pen(column, type_size, type_size // 2, column.width - 2 * type_size, type_size)
    pen.heading(say("idea", language))
    pen.paragraph(texts.texts["idea", language])
    pen.heading(say("code", language))
    top = pen.y
    pen.code(texts.code, session.step.marked)
    code = top, pen.y
    pen.y += pen.line // 2
    pen.heading(say("exercise", language))
    pen.paragraph(texts.texts["exercise", language])
    _answer(pen, session)
    return code, pen.y + type_size


def _answer(pen: _Pen, session: Session) -> None:
    """Write the answer so far, and what is said of it."""
    language = session.language
    asked = say("answer", language)
    pen.canvas.text(pen.left, pen.y, asked, INK, font=pen.sans)
    x = pen.left + pen.sans.width(f"{asked} ")
    wide = 12 * pen.mono.width("0")
    pen.canvas.rectangle(x, pen.y, wide, pen.line, PAPER)
    pen.canvas.text(x + 4, pen.y, f"{session.answer}_", ACCENT, font=pen.mono)
    said = session.said or say("type", language)
    color = _MOODS[session.mood]
    pen.canvas.text(x + wide + pen.line // 2, pen.y, said, color, font=pen.sans)
    pen.y += pen.line
