"""The little of Markdown that lessons use: paragraphs, **bold**, *italic* and `code`.

In: texts of lessons. Out: paragraphs of spans (text, kind), and lines of them that are no wider
than a view has room for.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from ...base.line_breaks import unbroken

#: A text and its kind: "plain", "bold", "italic" or "code".
Span = tuple[str, str]
_MARKED = re.compile(r"\*\*(?P<bold>.+?)\*\*|\*(?P<italic>.+?)\*|`(?P<code>.+?)`")


def paragraphs(text: str) -> list[list[Span]]:
    """Return the paragraphs of a text; one that begins with • stands on a line of its own."""
    parts = re.split(r"\n\n+|\n(?=• )", unbroken(text.strip()))
    return [_spans(" ".join(part.split("\n"))) for part in parts if part]


def _spans(paragraph: str) -> list[Span]:
    spans, place = [], 0
    for match in _MARKED.finditer(paragraph):
        spans.append((paragraph[place : match.start()], "plain"))
        kind = match.lastgroup or "plain"
        spans.append((match[kind], kind))
        place = match.end()
    spans.append((paragraph[place:], "plain"))
    return [span for span in spans if span[0]]


def wrapped(
    spans: Sequence[Span], width_of: Callable[[str, str], float], most: float
) -> list[list[Span]]:
    """Return lines of spans that are at most so wide, broken between words.

    A word that is wider by itself has a line of its own.
    """
    lines: list[list[Span]] = [[]]
    width = 0.0
    for word in _words(spans):
        wide = sum(width_of(text, kind) for text, kind in word)
        space = width_of(" ", "plain") if lines[-1] else 0.0
        if lines[-1] and width + space + wide > most:
            lines.append([])
            width = space = 0.0
        lines[-1] += [(" ", "plain")] * (space > 0) + word
        width += space + wide
    return lines


def _words(spans: Sequence[Span]) -> list[list[Span]]:
    """Return the spans of each word: there may be several, as in **a**-b."""
    words: list[list[Span]] = [[]]
    for text, kind in spans:
        for number, part in enumerate(text.split(" ")):
            if number:
                words.append([])
            if part:
                words[-1].append((part, kind))
    return [word for word in words if word]
