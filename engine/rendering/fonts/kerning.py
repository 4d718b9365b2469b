"""Reads the kerning of a font: how much nearer or farther than usual two glyphs stand.

In:  a `kern` table with one subtable of format 2, which data/scripts/font_kerning.py makes. The
     names of fields are those of the OpenType specification, version 1.9.
Out: `Kerning`: glyphs in classes, and a distance for each two classes.
"""

from __future__ import annotations

import struct
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_TABLE_HEADER, _SUBTABLE_HEADER = 4, 6


class Kerning(NamedTuple):
    """Distances between glyphs, in units of the font.

    That between the glyphs a and b is ``values[rows[a] + columns[b]]``. A glyph that no pair has,
    or none of this font, is of row 0 or of column 0, where all values are 0.
    """

    rows: NDArray[np.int64]  # of each glyph as the first one: where its row begins
    columns: NDArray[np.int64]  # of each glyph as the second one: where it is in a row
    values: NDArray[np.int64]


def no_kerning(glyphs: int) -> Kerning:
    """Return the kerning of a font without a `kern` table."""
    zeros = np.zeros(glyphs, np.int64)
    return Kerning(zeros, zeros, np.zeros(1, np.int64))


def read_kerning(table: bytes) -> Kerning:
    """Return the kerning of a `kern` table."""
    subtable = table[_TABLE_HEADER:]
    _, left, right, array = struct.unpack_from(">HHHH", subtable, _SUBTABLE_HEADER)
    values = np.frombuffer(subtable[array:], ">i2").astype(np.int64)
    # Classes are places in bytes; those of first glyphs count from the subtable's begin.
    rows, columns = _classes(subtable, left) - array, _classes(subtable, right)
    return Kerning(rows // 2, columns // 2, values)


def _classes(subtable: bytes, place: int) -> NDArray[np.int64]:
    """Return the class of every glyph; the table that is read leaves none out."""
    _, count = struct.unpack_from(">HH", subtable, place)
    return np.frombuffer(subtable, ">u2", count, place + 4).astype(np.int64)
