"""Makes the kerning of a font: a `kern` table of classes, from the pairs of its GPOS table.

In:  a font of fontTools whose GPOS table has pairs in its feature `kern`; what depends on more than
     two glyphs is left out.
Out: the bytes of a `kern` table with one subtable of format 2. Glyphs with the same distances to
     all that may follow share a row, those with the same ones to all before them a column; the
     first row and the first column are zeros.
"""

import struct

import numpy as np

_PAIRS, _EXTENSION = 2, 9
_HORIZONTAL_CLASSES = 0x0201
_SUBTABLE_HEADER = 14


def kerning_table(font):
    """Return the bytes of a font's `kern` table; None if it has no pairs."""
    values = _values(font)
    if not values.any():
        return None
    rows, row_of = _classes(values)
    columns, column_of = _classes(rows.T)
    return _table(columns.T, row_of, column_of)


def _values(font):
    """Return the kerning of each pair of glyphs: rows are those of the first glyph."""
    order = font.getGlyphOrder()
    values = np.zeros((len(order), len(order)), np.int64)
    is_set = np.zeros(values.shape, bool)
    for subtable in _pair_subtables(font["GPOS"].table) if "GPOS" in font else []:
        for row, first in enumerate(order):
            found = _followers(subtable, first, order)
            for column, value in found.items():
                if not is_set[row, column]:
                    values[row, column], is_set[row, column] = value, True
    return values


def _pair_subtables(table):
    features = (
        record.Feature for record in table.FeatureList.FeatureRecord if record.FeatureTag == "kern"
    )
    numbers = sorted({number for feature in features for number in feature.LookupListIndex})
    for lookup in (table.LookupList.Lookup[number] for number in numbers):
        for subtable in lookup.SubTable:
            found = subtable.ExtSubTable if lookup.LookupType == _EXTENSION else subtable
            if found.LookupType == _PAIRS:
                yield found


def _followers(subtable, first, order):
    """Return the kerning that a subtable gives a first glyph, by the second one's number."""
    if first not in subtable.Coverage.glyphs:
        return {}
    if subtable.Format == 1:
        pairs = subtable.PairSet[subtable.Coverage.glyphs.index(first)].PairValueRecord
        listed = {pair.SecondGlyph: _advance(pair.Value1) for pair in pairs}
        return {number: listed[glyph] for number, glyph in enumerate(order) if glyph in listed}
    records = subtable.Class1Record[subtable.ClassDef1.classDefs.get(first, 0)].Class2Record
    classes = subtable.ClassDef2.classDefs
    return {n: _advance(records[classes.get(glyph, 0)].Value1) for n, glyph in enumerate(order)}


def _advance(value):
    return getattr(value, "XAdvance", 0) if value else 0


def _classes(rows):
    """Return the different rows, zeros first, and the number of each row among them."""
    with_zeros = np.vstack([np.zeros_like(rows[:1]), rows])
    different, number_of = np.unique(with_zeros, axis=0, return_inverse=True)
    number_of = number_of.ravel()
    zeros = number_of[0]
    moved = np.where(number_of == zeros, 0, number_of + (number_of < zeros))
    order = np.r_[zeros, np.delete(np.arange(len(different)), zeros)]
    return different[order], moved[1:]


def _table(values, row_of, column_of):
    """Return a table of one subtable: headers, the classes of both sides, the values."""
    width = 2 * values.shape[1]
    right = _SUBTABLE_HEADER + 4 + 2 * len(row_of)
    array = right + 4 + 2 * len(column_of)
    places = (array + width * row_of, 2 * column_of)
    classes = b"".join(struct.pack(">HH", 0, len(of)) + of.astype(">u2").tobytes() for of in places)
    size = array + 2 * values.size
    head = struct.pack(">HHHHH", 0, 1, 0, size, _HORIZONTAL_CLASSES)
    head += struct.pack(">HHHH", width, _SUBTABLE_HEADER, right, array)
    return head + classes + values.astype(">i2").tobytes()
