"""A built-in font at one size: its glyphs' pictures, the lengths of texts, lines that fit.

In:  the faces in engine3d.data/fonts, read when a text needs them.
Out: pixels of a canvas, by `Canvas.text`; widths in pixels. All is integer arithmetic, so that a
     text has the same pixels on every machine; docs/canvas.md gives the rules.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, cached_property
from operator import add
from threading import Lock
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..._native import canvas as native
from ...base.line_breaks import last_break
from ...base.numbers import real, shown
from ...base.validation import FixedNames, choose, whole_number
from ...errors import InvalidArgumentError
from .fitting import most_kept
from .truetype import TrueType

Face = Literal["sans", "mono"]
_Units = TypeVar("_Units", int, NDArray[np.int64])

#: By face: where its glyphs are looked for.
_FACES = {"sans": ("sans", "mono"), "mono": ("mono", "sans")}
_LEAST_SIZE, _LARGEST_SIZE = 4, 512
#: Sizes and positions count these parts of a pixel.
_SIZE_PARTS, _PARTS = 64, 256
#: Of a size: from the top of a line to its baseline, and to the next line.
_ASCENT, _LINE = 0.97, 1.25
_TAB_COLUMNS = 4
_NEW_LINE, _MISSING = -1, 0
_WIDEST = 2**31 - 1
_ELLIPSIS = "…"


class Font(FixedNames):
    """A font at one size.

    Parameters
    ----------
    face : {"sans", "mono"}
        Noto Sans, or Noto Sans Mono, whose characters are all as wide. They have the letters of
        Latin, Greek and Cyrillic alphabets, signs and arrows; other characters show as a box.
    size : float
        Pixels of the em, 4 to 512; a small letter is about half as high.

    Attributes
    ----------
    face : str
    size : float
        Rounded to 1/64 pixel.
    line_height : int
        Pixels from one line to the next.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(self, face: Face, size: float) -> None:
        self._face = choose(face, _FACES, "face")
        pixels = real(size)
        if not _LEAST_SIZE <= pixels <= _LARGEST_SIZE:
            raise InvalidArgumentError(
                f"size must be {_LEAST_SIZE} to {_LARGEST_SIZE} pixels, not {shown(size)}"
            )
        self._parts = round(pixels * _SIZE_PARTS)
        self._line_height = round(_LINE * self.size)
        self._glyphs = native.Glyphs(round(_ASCENT * self.size), self._line_height)
        # Of each character: its glyph's number, its advance, its places in the kerning.
        self._numbers = {"\n": _NEW_LINE}
        self._advances = {"\n": 0}
        self._rows, self._columns = {"\n": 0}, {"\n": 0}
        self._pictures: dict[tuple[TrueType, int], tuple[int, int]] = {}
        self._lock = Lock()

    @property
    def face(self) -> str:
        return self._face

    @property
    def size(self) -> float:
        return self._parts / _SIZE_PARTS

    @property
    def line_height(self) -> int:
        return self._line_height

    def width(self, string: str) -> int:
        """Return the pixels that a line of text takes, rounded up."""
        string = checked_text(string).expandtabs(_TAB_COLUMNS)
        with self._lock:
            self._make(string)
            length = sum(self._steps(string))
        return -(-length // _PARTS)

    def text_size(self, string: str) -> tuple[int, int]:
        """Return the width and the height in pixels of a text, which may have several lines."""
        lines = checked_text(string).split("\n")
        return max(map(self.width, lines)), len(lines) * self._line_height

    def fitted(self, string: str, width: int) -> str:
        """Return a line of text that is at most so many pixels wide, its end cut off with dots."""
        most = _room(width)
        if self.width(string) <= most:
            return string
        kept = most_kept(lambda end: string[:end] + _ELLIPSIS, len(string), most, self.width)
        return string[:kept].rstrip() + _ELLIPSIS if kept > 0 else ""

    def wrapped(self, string: str, width: int) -> list[str]:
        """Return lines that are at most so many pixels wide, broken between words if possible."""
        lines = []
        most = _room(width)
        for line in checked_text(string).split("\n"):
            while self.width(line) > most:
                end = self._most(line, most)
                end = last_break(line, end) or end
                lines.append(line[:end].rstrip())
                line = line[end:].lstrip()
            lines.append(line)
        return lines

    def _draw(self, surface: native.Surface, x: float, y: float, string: str, color: bytes) -> None:
        """Draw a text on a surface, with the top left corner of its first line at (x, y)."""
        string = checked_text(string).expandtabs(_TAB_COLUMNS)
        with self._lock:
            self._make(string)
            numbers = np.array([self._numbers[character] for character in string], np.int32)
            steps = np.fromiter(self._steps(string), np.int32, len(string))
            surface.glyphs(x, y, numbers, steps, self._glyphs, color)

    def _steps(self, string: str) -> Iterator[int]:
        """Return how far the pen moves at each character of a text whose glyphs are made."""
        rows = map(self._rows.__getitem__, string)
        columns = map(self._columns.__getitem__, string[1:] + "\n")
        kerning = map(self._kerning.__getitem__, map(add, rows, columns))
        return map(add, map(self._advances.__getitem__, string), kerning)

    @cached_property
    def _kerning(self) -> list[int]:
        """The distances of the face's kerning, in 1/256 pixel."""
        face = _read(self._face)
        return _rounded(face.kerning.values, self._unit(face), 1).tolist()

    def _unit(self, face: TrueType) -> tuple[int, int]:
        """Return how many 1/256 pixel so many units of a face are."""
        return self._parts * (_PARTS // _SIZE_PARTS), face.units_per_em

    def _most(self, line: str, most: int) -> int:
        """Return how many characters of a line fit, at least one."""
        return max(most_kept(lambda kept: line[:kept], len(line), most, self.width), 1)

    def _make(self, string: str) -> None:
        """Make the glyphs of a text that are not there yet; the caller holds the lock."""
        for character in set(string) - self._numbers.keys():
            face, glyph = _glyph_of(character, self._face)
            self._numbers[character], self._advances[character] = self._picture(face, glyph)
            is_own = face is _read(self._face)
            self._rows[character] = int(face.kerning.rows[glyph]) if is_own else 0
            self._columns[character] = int(face.kerning.columns[glyph]) if is_own else 0

    def _picture(self, face: TrueType, glyph: int) -> tuple[int, int]:
        """Return the number of a glyph and its advance; characters may share one."""
        if (face, glyph) not in self._pictures:
            unit = self._unit(face)
            advance = _rounded(face.advance(glyph), unit, _PARTS if self._face == "mono" else 1)
            # Small letters end at a pixel's edge, so that they are sharp.
            high = max(_rounded(face.x_height, unit, _PARTS), _PARTS), face.x_height
            number = self._glyphs.add(*face.outline(glyph), *unit, *high)
            self._pictures[face, glyph] = number, advance
        return self._pictures[face, glyph]

    def __reduce__(self) -> tuple[type[Font], tuple[Face, float]]:
        return Font, (self._face, self.size)

    def __repr__(self) -> str:
        return f"Font({self._face!r}, {self.size:g})"


@cache
def font(face: Face, size: float) -> Font:
    """Return the font of a face and size that all share."""
    return Font(face, size)


@cache
def _read(face: str) -> TrueType:
    from importlib.resources import files  # takes longer to import than all of this

    return TrueType((files("engine3d.data") / "fonts" / f"{face}.ttf").read_bytes())


def checked_text(string: object) -> str:
    """Return a text; raise an error if it is none."""
    if not isinstance(string, str):
        raise InvalidArgumentError(f"string must be a str, not {shown(string)}")
    return string


def _room(width: int) -> int:
    return whole_number(width, "width", 0, _WIDEST)


def _glyph_of(character: str, face: str) -> tuple[TrueType, int]:
    """Return a font that has a character, and its glyph there; without one, that of a box."""
    for name in _FACES[face]:
        if ord(character) in _read(name).glyphs:
            return _read(name), _read(name).glyphs[ord(character)]
    return _read(face), _MISSING


def _rounded(units: _Units, unit: tuple[int, int], step: int) -> _Units:
    """Return units of a font in 1/256 pixel, rounded to a multiple of a step."""
    numerator, denominator = unit[0], unit[1] * step
    return (2 * units * numerator + denominator) // (2 * denominator) * step
