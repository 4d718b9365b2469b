"""Names of files with a place for the number of a frame, such as ``frame_%04d.png``.

In: what somebody typed or gave. Out: a `FrameName`, which is the name and knows whether numbers go
into it. ``%04d``, ``{:04}``, ``{:04d}`` and ``{}`` are places; ``%%04d``, ``{{:04}}`` and ``{{}}``
stand for these letters themselves. What comes of a file's name, which may hold any letters, is no
pattern: who puts it into a name says so by `literal_name`.
"""

from __future__ import annotations

import os
import re
from typing import NamedTuple

#: A place for a frame's number, or what stands for such letters.
FRAME_NUMBER = re.compile(
    r"(?P<escaped>%%0?[0-9]?d|\{\{(?::0?[0-9]?d?)?\}\})|%(0?[0-9]?)d|\{(?::(0?[0-9]?)d?)?\}"
)


class Place(NamedTuple):
    """The place of a number in a name.

    Attributes
    ----------
    before, after : str
    width : str
        How `format` is to write the number, such as ``"04"``.
    """

    before: str
    width: str
    after: str


class FrameName(str):
    """The name of files; it is known whether numbers go into it.

    Attributes
    ----------
    place : Place or None
    """

    place: Place | None = None

    def of_frame(self, number: int) -> str:
        """Return the name of a frame's file."""
        before, width, after = self.place or Place(self, "", "")
        return f"{before}{format(number, width + 'd')}{after}"


def literal_name(path: str | os.PathLike[str]) -> FrameName:
    """Return a name whose letters are all meant as they are."""
    return FrameName(os.fspath(path))


def frame_name(path: str | os.PathLike[str]) -> FrameName:
    """Return a name as a pattern; numbers go into one place, which is not in a folder's name."""
    if isinstance(path, FrameName):
        return path
    folder, name = os.path.split(os.fspath(path))
    pieces: list[str | re.Match[str]] = []
    last = 0
    for match in FRAME_NUMBER.finditer(name):
        pieces += [name[last : match.start()], match if match["escaped"] is None else meant(match)]
        last = match.end()
    return joined_name([os.path.join(folder, ""), *pieces, name[last:]])


def meant(match: re.Match[str]) -> str:
    """Return the letters that what `FRAME_NUMBER` calls escaped stands for."""
    text = match["escaped"]
    return text[1:] if text.startswith("%") else text[1:-1]


def joined_name(pieces: list[str | re.Match[str]]) -> FrameName:
    """Return the name of texts, which are meant as they are, and of places for a frame's number."""
    texts = [piece if isinstance(piece, str) else piece[0] for piece in pieces]
    name = FrameName("".join(texts))
    behind = ["".join(texts[index + 1 :]) for index in range(len(pieces))]
    places = [
        (index, piece)
        for index, piece in enumerate(pieces)
        if not isinstance(piece, str) and not os.path.dirname(behind[index])
    ]
    if len(places) == 1:
        ((index, place),) = places
        width = next((group for group in place.groups()[1:] if group), "")
        name.place = Place("".join(texts[:index]), width, behind[index])
    return name
