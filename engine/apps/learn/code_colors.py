"""Parts of lines of Python by kind, so that each view can colour them in its own way."""

from __future__ import annotations

import io
import keyword
import tokenize
from collections.abc import Sequence

#: Kinds of parts: their colours on a dark ground, as bytes.
COLORS = {
    "plain": (222, 224, 228),
    "keyword": (240, 150, 110),
    "number": (130, 200, 240),
    "string": (150, 210, 140),
    "comment": (140, 148, 162),
}
_KINDS = {tokenize.NUMBER: "number", tokenize.STRING: "string", tokenize.COMMENT: "comment"}
# From Python 3.12 on, these are the parts of f-strings.
for _name in ("FSTRING_START", "FSTRING_MIDDLE", "FSTRING_END"):
    if hasattr(tokenize, _name):
        _KINDS[getattr(tokenize, _name)] = "string"


def colored(lines: Sequence[str]) -> list[list[tuple[str, str]]]:
    """Return of each line its parts: (text, kind); together they are the line."""
    marks: list[list[tuple[int, int, str]]] = [[] for _ in lines]
    source = io.StringIO("".join(f"{line}\n" for line in lines))
    for token in tokenize.generate_tokens(source.readline):
        kind = _KINDS.get(token.type)
        if token.type == tokenize.NAME and keyword.iskeyword(token.string):
            kind = "keyword"
        if kind is not None:
            for row in range(token.start[0], token.end[0] + 1):
                start = token.start[1] if row == token.start[0] else 0
                end = token.end[1] if row == token.end[0] else len(lines[row - 1])
                marks[row - 1].append((start, end, kind))
    return [_parts(line, found) for line, found in zip(lines, marks, strict=True)]


def _parts(line: str, marks: Sequence[tuple[int, int, str]]) -> list[tuple[str, str]]:
    parts, place = [], 0
    for start, end, kind in marks:
        parts += [(line[place:start], "plain"), (line[start:end], kind)]
        place = end
    parts.append((line[place:], "plain"))
    return [part for part in parts if part[0]]
