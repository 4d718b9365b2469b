"""Reads the outlines of a TrueType font.

In:  the bytes of a font that comes with engine3d: `glyf` outlines, and a character map of format 4.
     The names of tables and fields are those of the OpenType specification, version 1.9.
Out: `TrueType`: a glyph's number for each character, its advance, its `Outline`; kerning.
"""

from __future__ import annotations

import struct
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .kerning import no_kerning, read_kerning

_ON_CURVE, _X_SHORT, _Y_SHORT, _REPEAT, _X_SAME, _Y_SAME = (1 << bit for bit in range(6))
_WORDS, _MORE_COMPONENTS = 1, 32


class Outline(NamedTuple):
    """The contours of a glyph: quadratic curves, in units of the font, y up."""

    points: NDArray[np.int16]  # (N, 2)
    on_curve: NDArray[np.uint8]  # (N,); points between curves' ends are control points
    ends: NDArray[np.int32]  # of each contour: the number of the point behind its last one


class TrueType:
    """A font.

    Attributes
    ----------
    units_per_em : int
    x_height : int
        Height of small letters, in units of the font.
    glyphs : dict
        The number of a glyph by its character's code.
    kerning : Kerning
    """

    def __init__(self, data: bytes) -> None:
        self._data = data
        (count,) = struct.unpack_from(">H", data, 4)
        records = (struct.unpack_from(">4sIII", data, 12 + 16 * k) for k in range(count))
        self._tables = {name.decode(): (first, size) for name, _, first, size in records}
        self.units_per_em = self._number("head", 18, "H")
        self.x_height = self._number("OS/2", 86, "h")
        long_places = self._number("head", 50, "h")
        self._places = self._array("loca", ">u4" if long_places else ">u2").astype(np.int64)
        self._places *= 1 if long_places else 2
        self._metrics = self._array("hmtx", ">u2")
        self._metrics_count = self._number("hhea", 34, "H")
        self.glyphs = self._character_map()
        has_pairs = "kern" in self._tables
        count = len(self._places) - 1
        self.kerning = read_kerning(self._bytes("kern")) if has_pairs else no_kerning(count)

    def advance(self, glyph: int) -> int:
        """Return how far it is to the next glyph, in units of the font."""
        return int(self._metrics[2 * min(glyph, self._metrics_count - 1)])

    def outline(self, glyph: int) -> Outline:
        """Return the contours of a glyph; none if it is a blank."""
        first, end = self._places[glyph : glyph + 2].tolist()
        if first == end:
            return _joined([])
        place = self._tables["glyf"][0] + first
        (contours,) = struct.unpack_from(">h", self._data, place)
        return self._simple(place, contours) if contours >= 0 else self._composed(place + 10)

    def _number(self, table: str, offset: int, kind: str) -> int:
        (number,) = struct.unpack_from(f">{kind}", self._data, self._tables[table][0] + offset)
        return int(number)

    def _array(self, table: str, dtype: str) -> NDArray[np.generic]:
        return np.frombuffer(self._bytes(table), dtype)

    def _bytes(self, table: str) -> bytes:
        first, size = self._tables[table]
        return self._data[first : first + size]

    def _character_map(self) -> dict[int, int]:
        first, _ = self._tables["cmap"]
        (offset,) = struct.unpack_from(">I", self._data, first + 8)  # of the first encoding
        size, _, twice = struct.unpack_from(">HHH", self._data, first + offset + 2)
        words = np.frombuffer(self._data[first + offset : first + offset + size], ">u2").tolist()
        segments = twice // 2
        last, start, delta, range_offset = (
            words[begin : begin + segments]
            for begin in (7, 8 + segments, 8 + 2 * segments, 8 + 3 * segments)
        )
        glyphs = {}
        for segment in range(segments - 1):  # the last one is an end mark
            for code in range(start[segment], last[segment] + 1):
                glyph = code
                if range_offset[segment]:
                    place = 8 + 3 * segments + segment + range_offset[segment] // 2
                    glyph = words[place + code - start[segment]]
                glyphs[code] = (glyph + delta[segment]) & 0xFFFF
        return glyphs

    def _simple(self, place: int, contours: int) -> Outline:
        ends = np.frombuffer(self._data, ">u2", contours, place + 10).astype(np.int32) + 1
        count = int(ends[-1])
        place += 10 + 2 * contours
        (instructions,) = struct.unpack_from(">H", self._data, place)
        place += 2 + instructions
        flags: list[int] = []
        while len(flags) < count:
            flag = self._data[place]
            repeats = self._data[place + 1] if flag & _REPEAT else 0
            flags += [flag] * (1 + repeats)
            place += 2 if flag & _REPEAT else 1
        across, place = self._coordinates(flags, place, _X_SHORT, _X_SAME)
        up, _ = self._coordinates(flags, place, _Y_SHORT, _Y_SAME)
        points = np.array([across, up], np.int16).T.copy()
        return Outline(points, np.array([flag & _ON_CURVE for flag in flags], np.uint8), ends)

    def _coordinates(
        self, flags: list[int], place: int, short: int, same: int
    ) -> tuple[list[int], int]:
        """Return one coordinate of each point, and the place behind them."""
        values, value = [], 0
        for flag in flags:
            if flag & short:
                value += self._data[place] if flag & same else -self._data[place]
                place += 1
            elif not flag & same:
                value += struct.unpack_from(">h", self._data, place)[0]
                place += 2
            values.append(value)
        return values, place

    def _composed(self, place: int) -> Outline:
        """Return the outline of a glyph of several others, which are moved but not scaled."""
        parts, flags = [], _MORE_COMPONENTS
        while flags & _MORE_COMPONENTS:
            flags, glyph = struct.unpack_from(">HH", self._data, place)
            kind = "hh" if flags & _WORDS else "bb"
            moved = struct.unpack_from(f">{kind}", self._data, place + 4)
            place += 4 + struct.calcsize(kind)
            part = self.outline(glyph)
            parts.append(part._replace(points=part.points + np.array(moved, np.int16)))
        return _joined(parts)


def _joined(parts: list[Outline]) -> Outline:
    ends, before = [np.empty(0, np.int32)], 0
    for part in parts:
        ends.append(part.ends + np.int32(before))
        before += len(part.points)
    points = [np.empty((0, 2), np.int16), *(part.points for part in parts)]
    flags = [np.empty(0, np.uint8), *(part.on_curve for part in parts)]
    return Outline(np.concatenate(points), np.concatenate(flags), np.concatenate(ends))
