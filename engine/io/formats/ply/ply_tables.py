"""The rows of a PLY file's body as columns.

In: the body of a file, and the elements that its header announces. Out: a `PlyTable` for each
requested element. If all lists have the same lengths as in the first row, rows have equal sizes and
are read as an array; other rows are walked along once. The file's length is checked against every
row.
"""

from __future__ import annotations

from typing import NamedTuple, NoReturn

import numpy as np

from ...._native import loaders as native
from ....errors import FileFormatError
from ...reading.sources import Source
from .ply_body import (
    BadListError,
    ListInRow,
    PlyBody,
    ShortBodyError,
    WalkedRows,
)
from .ply_header import PlyElement, PlyHeader


class PlyList(NamedTuple):
    """A list property of all rows.

    Attributes
    ----------
    sizes : (N,) int64
        Items in each row.
    values : (M,) number
        All items, row after row.
    length : int or None
        The number of items in each row, if known to be equal.
    """

    sizes: np.ndarray
    values: np.ndarray
    length: int | None = None


class _Layout(NamedTuple):
    """The places of an element's numbers.

    Attributes
    ----------
    row_count : int
        The number of rows, N.
    stride : int or None
        The distance between rows if all have the same shape.
    rows : WalkedRows
        All rows; only the first if there is a stride.
    end : int
        The place behind the last row.
    items : (N, K) number or None
        All items, if each row is a single list of the same length.
    """

    row_count: int
    stride: int | None
    rows: WalkedRows
    end: int
    items: np.ndarray | None = None


class PlyTable:
    """One element of a file.

    Attributes
    ----------
    element : PlyElement
    """

    def __init__(self, element: PlyElement, body: PlyBody, layout: _Layout, path: str) -> None:
        self.element = element
        self._body = body
        self._layout = layout
        self._path = path
        self._places = _places_in_row(element, body)

    def __len__(self) -> int:
        return self._layout.row_count

    def has(self, *names: str, lists: bool = False) -> bool:
        """Return whether all these properties exist, as numbers or lists."""
        found = [self.element.properties.get(name) for name in names]
        return all(p is not None and (p.count_type is not None) == lists for p in found)

    def type(self, name: str) -> str:
        """Return the announced type of a property, such as ``"f4"``."""
        return self.element.properties[name].type

    def column(self, name: str) -> np.ndarray:
        """Return a property of single numbers: (N,)."""
        code = self.type(name)
        after, offset = self._places[name]
        layout = self._layout
        if layout.stride is not None:
            first = self._first_place(after, offset)
            return self._body.column(first, len(self), layout.stride, code)
        if after == 0:
            return self._body.numbers(layout.rows.places + offset, code)
        return self._body.numbers(self._list_ends(after - 1) + offset, code)

    def columns(self, *names: str) -> np.ndarray:
        """Return several such properties side by side: (N, len(names)).

        float64, or the properties' own dtype if they share one and are adjacent.
        """
        block = self._block(names)
        if block is not None:
            return block
        table = np.empty((len(self), len(names)), np.float64)
        for index, name in enumerate(names):
            table[:, index] = self.column(name)
        return table

    def _block(self, names: tuple[str, ...]) -> np.ndarray | None:
        """Return adjacent columns of equally shaped rows, copied at once."""
        code, layout = self.type(names[0]), self._layout
        size = self._body.size(code)
        after, offset = self._places[names[0]]
        expected = [(after, offset + size * index) for index in range(len(names))]
        if (
            layout.stride is None
            or any(self.type(name) != code for name in names)
            or [self._places[name] for name in names] != expected
        ):
            return None
        shape = (len(self), len(names))
        return self._rows(layout.stride, self._first_place(after, offset), shape, code)

    def list(self, name: str) -> PlyList:
        """Return a list property."""
        code = self.type(name)
        number = self._places[name][0]
        layout = self._layout
        sizes = layout.rows.sizes[:, number]
        if layout.stride is None:
            return PlyList(sizes, native.frozen(self._body.lists(layout.rows, number, code)))
        values, length = layout.items, int(sizes[0])
        if values is None:
            shape = (len(self), length)
            values = self._rows(layout.stride, int(layout.rows.starts[0, number]), shape, code)
        values = native.frozen(values).reshape(-1)
        return PlyList(np.broadcast_to(sizes, len(self)), values, length)

    def _rows(self, stride: int, start: int, shape: tuple[int, int], code: str) -> np.ndarray:
        """Return adjacent numbers of all rows of one shape; those of the first row at ``start``."""
        place = int(self._layout.rows.places[0])
        return native.frozen(self._body.rows(place, start - place, shape, stride, code))

    def fail(self, row: int, message: str) -> NoReturn:
        """Raise an error about a row."""
        layout = self._layout
        if layout.stride is None:
            place = int(layout.rows.places[row])
        else:
            place = int(layout.rows.places[0]) + row * layout.stride
        raise FileFormatError(
            f"{self.element.name} {row}{self._body.describe(place)}: {message}",
            self._path,
            self._body.line(place),
        )

    def _first_place(self, after: int, offset: int) -> int:
        base = self._layout.rows.places[:1] if after == 0 else self._list_ends(after - 1)[:1]
        return int(base[0]) + offset

    def _list_ends(self, number: int) -> np.ndarray:
        lists = [p for p in self.element.properties.values() if p.count_type is not None]
        size = self._body.size(lists[number].type)
        rows = self._layout.rows
        return rows.starts[:, number] + rows.sizes[:, number] * size


def read_tables(source: Source, header: PlyHeader, body: PlyBody) -> dict[str, PlyTable]:
    """Find the rows of all elements.

    Raises
    ------
    FileFormatError
        The file is shorter than announced, or a list has an impossible length.
    """
    tables = {}
    place = body.start
    for name, element in header.elements.items():
        layout = _find_rows(source, element, body, place)
        tables[name] = PlyTable(element, body, layout, source.path)
        place = layout.end
    if place < body.end and not header.byte_order:
        # Rows have another width than announced: everything after the first would be wrong.
        raise FileFormatError(
            f"{body.end - place} numbers more than the header announces",
            source.path,
            body.line(place),
        )
    return tables


def _places_in_row(element: PlyElement, body: PlyBody) -> dict[str, tuple[int, int]]:
    """Return each number's lists before it and offset after the last; for lists, their index."""
    places, lists, offset = {}, 0, 0
    for name, item in element.properties.items():
        places[name] = (lists, offset)
        if item.count_type is None:
            offset += body.size(item.type)
        else:
            lists, offset = lists + 1, 0
    return places


def _find_rows(source: Source, element: PlyElement, body: PlyBody, start: int) -> _Layout:
    lists, tail = _lists(element, body)
    least = sum(before + body.size(count_type) for before, count_type, _ in lists) + tail
    count = element.count if least else 0
    if count * least > body.end - start:
        _fail_short(source, element, body)
    try:
        first = body.walk(lists, tail, start, min(count, 1))
        stride = first.end - start
        fits = count * stride <= body.end - start
        if count and fits:
            found = _Layout(count, stride, first, start + stride * count)
            if len(element.properties) == 1 and lists:
                _, count_type, code = lists[0]
                items = body.even_lists(start, count, count_type, code, int(first.sizes[0, 0]))
                if items is not None:
                    return found._replace(items=items)
            elif _is_uniform(lists, body, first, stride, count):
                return found
        rows = body.walk(lists, tail, start, count)
    except ShortBodyError:
        _fail_short(source, element, body)
    except BadListError as error:
        raise FileFormatError(
            f"{element.name} {error.row}{body.describe(error.place)}: "
            "the length of a list must be an integer from 0 on",
            source.path,
            body.line(error.place),
        ) from None
    return _Layout(count, None, rows, rows.end)


def _lists(element: PlyElement, body: PlyBody) -> tuple[list[ListInRow], int]:
    """Return the lists of a row, and the number of places after the last."""
    lists, before = [], 0
    for item in element.properties.values():
        if item.count_type is None:
            before += body.size(item.type)
        else:
            lists.append((before, item.count_type, item.type))
            before = 0
    return lists, before


def _is_uniform(
    lists: list[ListInRow], body: PlyBody, first: WalkedRows, stride: int, count: int
) -> bool:
    """Return whether the lists of all rows have the lengths of those in the first."""
    for (_, count_type, _), begin, size in zip(lists, first.starts[0], first.sizes[0], strict=True):
        place = int(first.places[0])
        offset = int(begin) - body.size(count_type) - place
        if not body.lengths_are(place, offset, stride, count, count_type, int(size)):
            return False
    return True


def _fail_short(source: Source, element: PlyElement, body: PlyBody) -> NoReturn:
    raise FileFormatError(
        f"the file ends before the {element.count} rows of element {element.name!r} do",
        source.path,
        body.line(body.end),
    )
