"""The page of a lesson as lines of a terminal: the picture in half blocks, texts beside and below.

In: a session, columns and rows. Out: lines with the codes of colours that terminals know.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..terminal import half_blocks
from .code_colors import COLORS, colored
from .course_session import Session
from .lesson_programs import Listing
from .page_picture import beside_or_below
from .rich_text import Span, paragraphs, wrapped
from .words import say, told_keys

RESET = "\x1b[0m"
_STYLES = {"bold": "\x1b[1m", "italic": "\x1b[3m", "code": "\x1b[36m"}
_HEADING = "\x1b[1;33m"
_MARK = "\x1b[33m▌\x1b[0m"
_MOODS = {"right": "\x1b[32m", "wrong": "\x1b[31m", "plain": "\x1b[2m"}
#: Of the rows, those that a picture may take.
_PICTURE_SHARE = 0.6


def text_page(session: Session, cells: tuple[int, int], scroll: int) -> tuple[list[str], int]:
    """Return the lines of the page, as many as there are rows, and how far it can be moved.

    Parameters
    ----------
    session : Session
    cells : (int, int)
        Columns and rows of the terminal.
    scroll : int
        Lines by which the page is moved up.
    """
    columns, rows = cells
    language = session.language
    if session.shows_help:
        body = [_heading(say("help", language))]
        body += [f"{keys:<20} {meaning}" for keys, meaning in told_keys(language)]
    elif session.is_at_end:
        body = [_heading(say("end", language)), *_prose(say("after", language), columns)]
    else:
        body = _body(session, columns, rows)
    room = max(rows - 2, 0)
    overflow = max(len(body) - room, 0)
    shown = body[min(scroll, overflow) :][:room]
    shown += [""] * (room - len(shown))
    place = "" if session.is_at_end else session.place
    title = session.title[: max(columns - len(place) - 1, 0)]
    head = f"{_HEADING}{title}{RESET}{place:>{max(columns - len(title), 0)}}"
    return [head, *shown, _prose(say("keys", language), columns)[0]][:rows], overflow


def _heading(text: str) -> str:
    return f"{_HEADING}{text}{RESET}"


def _body(session: Session, columns: int, rows: int) -> list[str]:
    """Return all lines between title and keys."""
    language, texts, step = session.language, session.texts, session.step
    wide = columns // 2 - 1
    picture = _shown(step.shown, (wide, int(rows * _PICTURE_SHARE)))
    picture += ["", *_prose(step.caption, wide)]
    for number, parameter in enumerate(texts.parameters):
        mark = ">" if number == session.chosen else " "
        value = session.word(session.values[parameter.name])
        picture.append(f"{mark} ‹ {value} › {parameter.labels[language]}"[:wide])
    if session.next_title is not None:
        picture.append(f"{say('next', language, session.next_title)} →"[:wide])
    idea = [_heading(say("idea", language))]
    idea += _prose(texts.texts["idea", language], columns - wide - 2)
    return [
        *_side_by_side(picture, idea, wide + 2),
        "",
        _heading(say("code", language)),
        *_code(texts.code, step.marked),
        "",
        _heading(say("exercise", language)),
        *_prose(texts.texts["exercise", language], columns),
        f"{say('answer', language)} {session.answer}_  "
        f"{_MOODS[session.mood]}{session.said or say('type', language)}{RESET}",
    ]


def _prose(text: str, columns: int) -> list[str]:
    lines: list[str] = []
    for spans in paragraphs(text):
        for line in wrapped(spans, lambda part, kind: len(part), columns):
            lines += ["".join(map(_styled, line))]
    return lines


def _styled(span: Span) -> str:
    text, kind = span
    return f"{_STYLES[kind]}{text}{RESET}" if kind in _STYLES else text


def _code(lines: Sequence[str], marked: range) -> list[str]:
    shown = []
    for number, parts in enumerate(colored(lines)):
        mark = _MARK if number in marked else " "
        inked = (f"\x1b[38;2;{'{};{};{}'.format(*COLORS[kind])}m{text}" for text, kind in parts)
        shown.append(f"{mark} {''.join(inked)}{RESET}")
    return shown


def _shown(shown: Sequence[np.ndarray | Listing], room: tuple[int, int]) -> list[str]:
    """Return what a step shows in columns and rows of text."""
    if any(isinstance(one, Listing) for one in shown):
        return [line[: room[0]] for one in shown if isinstance(one, Listing) for line in one.lines]
    pixels = beside_or_below(shown, (room[0], 2 * room[1]), gap=2)
    opaque = np.dstack([pixels, np.full(pixels.shape[:2], 255, np.uint8)])
    return half_blocks.encode(opaque).decode().split("\r\n")


def _side_by_side(left: Sequence[str], right: Sequence[str], column: int) -> list[str]:
    """Return lines of two columns: the second begins at a column, whatever codes the first has."""
    lines = []
    for number in range(max(len(left), len(right))):
        one = left[number] if number < len(left) else ""
        other = right[number] if number < len(right) else ""
        lines.append(f"{one}\x1b[{column + 1}G{other}")
    return lines
