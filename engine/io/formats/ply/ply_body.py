"""The body of a PLY file, with numbers accessed by position.

In: the bytes of a file. Out: arrays of the numbers at given places. A place is a byte offset in a
binary body, or a word number in a text body; otherwise both are alike, so that `ply_tables` reads
them in the same way.
"""

from __future__ import annotations

import re
import sys
from contextlib import suppress
from itertools import islice
from typing import NamedTuple, TypeAlias

import numpy as np

from ...._native import loaders as native
from ....errors import FileFormatError
from ...reading.number_arrays import NotANumberError, ended, read_numbers
from ...reading.sources import Source
from ...reading.text import shown
from .ply_header import PlyElement, PlyHeader

_COMMENT = re.compile(rb"(?:^|(?<=[\r\n]))[ \t]*(?:comment|obj_info)\b[^\r\n]*")
_WORD = re.compile(rb"\S+")
_ORDER_HERE = "<" if sys.byteorder == "little" else ">"
# Most first rows are shorter than this many bytes.
_NEAR = 1 << 12


# A list in each row: the size of the scalars before it, and the types of its length and items.
ListInRow = tuple[int, str, str]


class WalkedRows(NamedTuple):
    """The places of an element's rows.

    Attributes
    ----------
    places : (N,) int64
        The place of each row.
    starts, sizes : (N, K) int64
        The first item, and the length, of each row's lists.
    end : int
        The place behind the last row.
    """

    places: np.ndarray
    starts: np.ndarray
    sizes: np.ndarray
    end: int


class ShortBodyError(Exception):
    """The body ends within a row."""


class BadListError(Exception):
    """A list's length is not an integer from 0 on; holds the row, and the place of the length."""

    def __init__(self, row: int, place: int) -> None:
        super().__init__(row, place)
        self.row, self.place = row, place


class BinaryBody:
    """The numbers of a binary body.

    Attributes
    ----------
    start, end : int
        The first place, and the place after the last.
    """

    def __init__(self, source: Source, header: PlyHeader) -> None:
        self._source = source
        self._order = header.byte_order
        self._is_big_endian = header.byte_order == ">"
        self.start, self.end = header.body_start, source.size

    def size(self, code: str) -> int:
        """Return how many places a number of a type takes."""
        return int(code[1])

    def walk(self, lists: list[ListInRow], tail: int, place: int, rows: int) -> WalkedRows:
        """Walk along rows, with ``tail`` places after the last list of each.

        Raises `ShortBodyError` and `BadListError`.
        """
        if rows <= 1:
            near = min(self.end - place, _NEAR)
            for _, data in self._source.pieces(place, near, 1) if near else ():
                with suppress(ShortBodyError):
                    return self._walk(data, place, lists, tail, place, rows)
        return self._walk(self._source.data, 0, lists, tail, place, rows)

    def _walk(
        self,
        data: bytes | memoryview,
        base: int,
        lists: list[ListInRow],
        tail: int,
        place: int,
        rows: int,
    ) -> WalkedRows:
        """Walk along rows in the bytes from ``base`` on."""
        sizes = [
            (before, self.size(count_type), count_type[0] == "i", self.size(item_type))
            for before, count_type, item_type in lists
        ]
        problem, places, starts, lengths, end, row = native.walk_ply_rows(
            data, place - base, self._is_big_endian, sizes, tail, rows
        )
        if problem == native.PLY_SHORT:
            raise ShortBodyError
        if problem == native.PLY_BAD_LIST:
            raise BadListError(row, base + end)
        return WalkedRows(places + base, starts + base, lengths, base + end)

    def lengths_are(
        self, place: int, offset: int, stride: int, rows: int, code: str, length: int
    ) -> bool:
        """Return whether a list has ``length`` items in all rows, which are ``stride`` apart.

        The first row is at ``place``, with the length at ``offset`` in it.
        """
        return all(
            native.ply_lengths_are(
                data,
                self._is_big_endian,
                offset,
                stride,
                len(data) // stride,
                self.size(code),
                length,
            )
            for _, data in self._source.pieces(place, stride, rows)
        )

    def even_lists(
        self, place: int, rows: int, count_type: str, code: str, length: int
    ) -> np.ndarray | None:
        """Return the items (rows, length) of single-list rows; None if lengths differ."""
        before = self.size(count_type)
        stride = before + length * self.size(code)
        items = native.large_array((rows, length), code)
        for first, data in self._source.pieces(place, stride, rows):
            count = len(data) // stride
            block = items[first : first + count]
            if not native.copy_even_ply_lists(data, self._is_big_endian, before, block):
                return None
        return items

    def lists(self, walked: WalkedRows, number: int, code: str) -> np.ndarray:
        """Return the items of one list of all rows, row after row."""
        starts, sizes = walked.starts, walked.sizes
        return native.copy_ply_lists(
            self._source.data, self._is_big_endian, starts, sizes, number, np.dtype(code)
        )

    def rows(
        self, place: int, offset: int, shape: tuple[int, int], stride: int, code: str
    ) -> np.ndarray:
        """Return adjacent numbers of rows that are ``stride`` apart.

        The first row is at ``place``, with the numbers at ``offset`` in it.
        """
        items = native.large_array(shape, code)
        if items.nbytes == stride * shape[0] and self._order == _ORDER_HERE:
            self._source.read_into(items, place)
            return items
        for first, data in self._source.pieces(place, stride, shape[0]):
            block = items[first : first + len(data) // stride]
            native.copy_ply_rows(data, self._is_big_endian, offset, stride, block)
        return items

    def numbers(self, places: np.ndarray, code: str) -> np.ndarray:
        """Return the numbers at ``places`` (any shape), which must all be inside."""
        if not len(places):
            return np.zeros(places.shape, code)
        # A view of numbers that start at every byte.
        count = self.end - self.size(code) + 1
        every = np.ndarray((count,), self._order + code, self._source.data, 0, (1,))
        return every[places].astype(code, copy=False)

    def column(self, start: int, rows: int, stride: int, code: str) -> np.ndarray:
        """Return one number of each row as a view; rows are ``stride`` apart."""
        if not rows:
            return np.zeros(0, code)
        return np.ndarray((rows,), self._order + code, self._source.data, start, (stride,))

    def line(self, place: int) -> None:
        """Return no line: binary files have none."""
        return None

    def describe(self, place: int) -> str:
        """Return the description of a place for a message."""
        return f" at byte {place}"


class TextBody:
    """The numbers of a text body; comments may occur between lines."""

    def __init__(self, source: Source, header: PlyHeader) -> None:
        self._body = ended(memoryview(source.data)[header.body_start :])
        self._first_line = header.body_line
        try:
            self._values = read_numbers(self._body, native.PLY_COMMENTS).values
        except NotANumberError as error:
            raise FileFormatError(
                f"not a number: {shown(error.word)}", source.path, self._line_at(error.position)
            ) from None
        self.start, self.end = 0, len(self._values)

    def size(self, code: str) -> int:
        return 1

    def walk(self, lists: list[ListInRow], tail: int, place: int, rows: int) -> WalkedRows:
        skips = [before for before, _, _ in lists]
        problem, places, starts, sizes, end, row = native.walk_number_rows(
            self._values, place, skips, tail, rows
        )
        if problem == native.PLY_SHORT:
            raise ShortBodyError
        if problem == native.PLY_BAD_LIST:
            raise BadListError(row, end)
        return WalkedRows(places, starts, sizes, end)

    def lengths_are(
        self, place: int, offset: int, stride: int, rows: int, code: str, length: int
    ) -> bool:
        return bool((self.column(place + offset, rows, stride, code) == length).all())

    def even_lists(
        self, place: int, rows: int, count_type: str, code: str, length: int
    ) -> np.ndarray | None:
        if not self.lengths_are(place, 0, 1 + length, rows, count_type, length):
            return None
        return self.rows(place, 1, (rows, length), 1 + length, code)

    def lists(self, walked: WalkedRows, number: int, code: str) -> np.ndarray:
        return native.copy_numbers(self._values, walked.starts, walked.sizes, number)

    def rows(
        self, place: int, offset: int, shape: tuple[int, int], stride: int, code: str
    ) -> np.ndarray:
        if 0 in shape:
            return np.zeros(shape, np.float64)
        view = np.ndarray(shape, np.float64, self._values, 8 * (place + offset), (8 * stride, 8))
        items = native.large_array(shape, np.float64)
        items[:] = view
        return items

    def numbers(self, places: np.ndarray, code: str) -> np.ndarray:
        return self._values[places]

    def column(self, start: int, rows: int, stride: int, code: str) -> np.ndarray:
        return self._values[start :: max(stride, 1)][:rows]

    def line(self, place: int) -> int:
        """Return the line of a number; the last line for places after the end."""
        body = _COMMENT.sub(lambda comment: b" " * len(comment[0]), self._body)
        words = islice(_WORD.finditer(body), place, None)
        found = next(words, None)
        return self._line_at(len(body.rstrip()) if found is None else found.start())

    def describe(self, place: int) -> str:
        return ""

    def _line_at(self, position: int) -> int:
        before = bytes(self._body[:position])
        feeds, returns, pairs = (before.count(mark) for mark in (b"\n", b"\r", b"\r\n"))
        return self._first_line + feeds + returns - pairs


PlyBody: TypeAlias = BinaryBody | TextBody


def open_body(source: Source, header: PlyHeader) -> PlyBody:
    """Return the body of a file for reading numbers."""
    if not header.byte_order:
        return TextBody(source, header)
    if not all(map(_is_read_once, header.elements.values())):
        # Reading everything at once is faster than reading the file repeatedly.
        _ = source.data
    return BinaryBody(source, header)


def _is_read_once(element: PlyElement) -> bool:
    """Return whether all properties of an element are read together."""
    lists = [item for item in element.properties.values() if item.count_type is not None]
    return len(element.properties) == 1 if lists else len(element.properties) <= 3
