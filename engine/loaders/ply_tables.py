"""The rows of a PLY file's body as columns.

In: the store of a file's numbers, and the elements that its header announces. Out: a `PlyTable` for
each element that is asked for. Rows whose lists all have the length of those in the first row lie
at equal distances and are read as they lie; others are walked along once. No row is believed in
before the file was found long enough for it.
"""

from __future__ import annotations

import struct
from array import array
from typing import NamedTuple

import numpy as np

from ..errors import FileFormatError
from .ply_header import PlyElement, PlyHeader
from .ply_stores import BinaryStore, TextStore
from .sources import Source


class PlyList(NamedTuple):
    """A list property of all rows.

    Attributes
    ----------
    sizes : (N,) int64
        Items in each row.
    values : (M,) number
        All items, row after row.
    """

    sizes: np.ndarray
    values: np.ndarray


class _Layout(NamedTuple):
    """Where the numbers of an element stand.

    Attributes
    ----------
    count : int
        Number of rows, N.
    stride : int or None
        The distance of rows if all have the same shape.
    rows : (N,) int64
        The place of each row; only the first if there is a stride.
    starts, sizes : (N, K) int64
        The first item, and the length, of each row's lists; only the first row's if there is a
        stride.
    end : int
        The place behind the last row.
    """

    count: int
    stride: int | None
    rows: np.ndarray
    starts: np.ndarray
    sizes: np.ndarray
    end: int


class PlyTable:
    """One element of a file.

    Attributes
    ----------
    element : PlyElement
    """

    def __init__(self, element: PlyElement, store, layout: _Layout, path: str) -> None:
        self.element = element
        self._store = store
        self._layout = layout
        self._path = path
        self._places = _places_in_row(element, store)

    def __len__(self) -> int:
        return self._layout.count

    def has(self, *names: str, lists: bool = False) -> bool:
        """Tell whether all these properties exist, as numbers or as lists."""
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
            return self._store.grid(first, (len(self), 1), layout.stride, code)[:, 0]
        if after == 0:
            return self._store.numbers(layout.rows + offset, code)
        return self._store.numbers(self._list_ends(after - 1) + offset, code)

    def columns(self, *names: str) -> np.ndarray:
        """Return several such properties beside each other: (N, len(names)).

        float64, or the properties' own type where they are alike and stand beside each other.
        """
        block = self._block(names)
        if block is not None:
            return block
        table = np.empty((len(self), len(names)), np.float64)
        for index, name in enumerate(names):
            table[:, index] = self.column(name)
        return table

    def _block(self, names: tuple[str, ...]) -> np.ndarray | None:
        """Columns that lie beside each other in rows of one shape, copied at once."""
        code, layout = self.type(names[0]), self._layout
        size = self._store.size(code)
        after, offset = self._places[names[0]]
        expected = [(after, offset + size * index) for index in range(len(names))]
        if (
            layout.stride is None
            or any(self.type(name) != code for name in names)
            or [self._places[name] for name in names] != expected
        ):
            return None
        shape = (len(self), len(names))
        found = self._store.grid(self._first_place(after, offset), shape, layout.stride, code)
        return _own_copy(found)

    def list(self, name: str) -> PlyList:
        """Return a list property."""
        code = self.type(name)
        number = self._places[name][0]
        layout = self._layout
        sizes = layout.sizes[:, number]
        if layout.stride is not None:
            shape = (len(self), int(sizes[0]))
            first = int(layout.starts[0, number])
            values = self._store.grid(first, shape, layout.stride, code)
            return PlyList(np.broadcast_to(sizes, len(self)), _own_copy(values).reshape(-1))
        within = np.arange(int(sizes.sum())) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        places = np.repeat(layout.starts[:, number], sizes)
        places += within * self._store.size(code)
        return PlyList(sizes, self._store.numbers(places, code))

    def fail(self, row: int, message: str):
        """Raise an error about a row."""
        layout = self._layout
        if layout.stride is None:
            place = int(layout.rows[row])
        else:
            place = int(layout.rows[0]) + row * layout.stride
        raise FileFormatError(
            f"{self.element.name} {row}{self._store.describe(place)}: {message}",
            self._path,
            self._store.line(place),
        )

    def _first_place(self, after: int, offset: int) -> int:
        base = self._layout.rows[:1] if after == 0 else self._list_ends(after - 1)[:1]
        return int(base[0]) + offset

    def _list_ends(self, number: int) -> np.ndarray:
        lists = [p for p in self.element.properties.values() if p.count_type is not None]
        size = self._store.size(lists[number].type)
        return self._layout.starts[:, number] + self._layout.sizes[:, number] * size


def _own_copy(numbers: np.ndarray) -> np.ndarray:
    """Numbers in this machine's byte order; a mesh takes over what nobody can write to."""
    copy = np.array(numbers, numbers.dtype.newbyteorder("="), order="C")
    copy.setflags(write=False)
    return copy


def read_tables(
    source: Source, header: PlyHeader, store: BinaryStore | TextStore
) -> dict[str, PlyTable]:
    """Find the rows of all elements.

    Raises
    ------
    FileFormatError
        The file ends before what is announced, or a list has an impossible length.
    """
    tables = {}
    place = store.start
    for name, element in header.elements.items():
        layout = _find_rows(source, element, store, place)
        tables[name] = PlyTable(element, store, layout, source.path)
        place = layout.end
    if place < store.end and not header.byte_order:
        # Rows of another width than announced: everything after the first would be wrong.
        raise FileFormatError(
            f"{store.end - place} numbers more than the header announces",
            source.path,
            store.line(place),
        )
    return tables


def _places_in_row(element: PlyElement, store) -> dict[str, tuple[int, int]]:
    """For each number the lists before it and its distance from the last; for lists, which one."""
    places, lists, offset = {}, 0, 0
    for name, item in element.properties.items():
        places[name] = (lists, offset)
        if item.count_type is None:
            offset += store.size(item.type)
        else:
            lists, offset = lists + 1, 0
    return places


def _find_rows(source: Source, element: PlyElement, store, start: int) -> _Layout:
    steps, tail = _steps(element, store)
    least = sum(skip + size for skip, _, size, _ in steps) + tail
    count = element.count if least else 0
    if count * least > store.end - start:
        _fail_short(source, element, store)
    if not count:
        empty = np.zeros((0, len(steps)), np.int64)
        return _Layout(0, None, np.zeros(0, np.int64), empty, empty, start)
    try:
        first = _walk(steps, tail, store.end, start, 1)
        stride = first[2] - start
        fits = count * stride <= store.end - start
        if fits and _is_uniform(element, store, first, start, stride, count):
            return _layout(count, stride, first, start + stride * count)
        found = _walk(steps, tail, store.end, start, count)
    except (IndexError, struct.error):
        _fail_short(source, element, store)
    except _BadList as error:
        raise FileFormatError(
            f"{element.name} {error.row}{store.describe(error.place)}: "
            "the length of a list must be an integer from 0 on",
            source.path,
            store.line(error.place),
        ) from None
    return _layout(count, None, found, found[2])


def _layout(count: int, stride: int | None, walked, end: int) -> _Layout:
    starts, sizes, _, rows = walked
    rows = np.frombuffer(rows, np.int64)
    starts, sizes = (
        np.frombuffer(numbers, np.int64).reshape(len(rows), len(numbers) // len(rows))
        for numbers in (starts, sizes)
    )
    return _Layout(count, stride, rows, starts, sizes, end)


class _BadList(Exception):
    def __init__(self, row: int, place: int) -> None:
        super().__init__(row, place)
        self.row, self.place = row, place


def _steps(element: PlyElement, store) -> tuple[list[tuple], int]:
    """For each list the places before it, its counter, and the sizes of count and item.

    The second value is the number of places behind the last list.
    """
    steps, skip = [], 0
    for item in element.properties.values():
        if item.count_type is None:
            skip += store.size(item.type)
        else:
            counter = store.counter(item.count_type)
            steps.append((skip, counter, store.size(item.count_type), store.size(item.type)))
            skip = 0
    return steps, skip


def _walk(steps, tail: int, end: int, place: int, count: int):
    """Go along rows: the starts and sizes of their lists, the place behind, and their places.

    Raises IndexError or struct.error where the body ends too early.
    """
    starts, sizes, rows = array("q"), array("q"), array("q")
    for row in range(count):
        rows.append(place)
        for skip, counter, count_size, item_size in steps:
            place += skip
            try:
                size = counter(place)
            except (ValueError, OverflowError):
                raise _BadList(row, place) from None
            if size < 0:
                raise _BadList(row, place)
            place += count_size
            if place + size * item_size > end:
                raise IndexError
            starts.append(place)
            sizes.append(size)
            place += size * item_size
        place += tail
        if place > end:
            raise IndexError
    return starts, sizes, place, rows


def _is_uniform(element: PlyElement, store, first, start: int, stride: int, count: int) -> bool:
    """Whether the lists of all rows have the lengths of those in the first."""
    lists = [p for p in element.properties.values() if p.count_type is not None]
    for item, begin, size in zip(lists, first[0], first[1], strict=True):
        place = begin - store.size(item.count_type)
        if (store.grid(place, (count, 1), stride, item.count_type) != size).any():
            return False
    return True


def _fail_short(source: Source, element: PlyElement, store):
    raise FileFormatError(
        f"the file ends before the {element.count} rows of element {element.name!r} do",
        source.path,
        store.line(store.end),
    )
