"""File names with a place for the frame number, such as ``frame_%04d.png``.

In: a name from the user. Out: a `FrameName`, which is the name and knows whether it takes numbers.
``%04d``, ``{:04}``, ``{:04d}`` and ``{}`` are places; ``%%04d``, ``{{:04}}`` and ``{{}}`` are these
texts literally. Names of existing files may contain any characters and are not patterns:
`literal_name` marks them.
"""

from __future__ import annotations

import os
import re
from typing import NamedTuple

#: A place for a frame number, or its escaped form.
FRAME_NUMBER = re.compile(
    r"(?P<escaped>%%0?[0-9]?d|\{\{(?::0?[0-9]?d?)?\}\})|%(0?[0-9]?)d|\{(?::(0?[0-9]?)d?)?\}"
)


class Place(NamedTuple):
    """The place of the number in a name.

    Attributes
    ----------
    before, after : str
    width : str
        Format specification of the number, such as ``"04"``.
    """

    before: str
    width: str
    after: str


class FrameName(str):
    """A file name that may take frame numbers.

    Attributes
    ----------
    place : Place or None
    """

    place: Place | None = None

    def of_frame(self, number: int) -> str:
        """Return the file name for a frame."""
        before, width, after = self.place or Place(self, "", "")
        return f"{before}{format(number, width + 'd')}{after}"


def literal_name(path: str | os.PathLike[str]) -> FrameName:
    """Return a name without places for numbers."""
    return FrameName(os.fspath(path))


def frame_name(path: str | os.PathLike[str]) -> FrameName:
    """Return a name as a pattern with at most one place for numbers, not in a folder's name."""
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
    """Return the literal text of an escaped place."""
    text = match["escaped"]
    return text[1:] if text.startswith("%") else text[1:-1]


def joined_name(pieces: list[str | re.Match[str]]) -> FrameName:
    """Join literal texts and places for a frame number to a name."""
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
