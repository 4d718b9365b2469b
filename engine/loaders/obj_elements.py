"""The lists of an OBJ file as arrays: vertices and the corners of faces, lines and points.

In: `Statements`. Out: positions, colours, texture coordinates and normals as they stand in the
file, and zero-based indices into them, checked; -1 where a corner has none. Every index error names
its line.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..errors import FileFormatError
from .corner_mesh import Vertices
from .number_arrays import parse_floats, parse_integers
from .obj_statements import Statements, keyword_code
from .text import shown
from .warning_list import WarningList

_SLASH = ord("/")
# Normals whose largest component is outside have no direction that float32 could tell.
_SHORTEST, _LONGEST = 1e-15, 1e15


class Elements(NamedTuple):
    """Faces, lines or points.

    Attributes
    ----------
    statements : (E,) int64
        The statement that each element stands in.
    sizes : (E,) int64
        Its number of corners.
    positions : (C,) int32
        Of all corners, element after element: indices from 0.
    uvs, normals : (C,) int32 or None
        The same, -1 for none; None if no corner has any.
    """

    statements: np.ndarray
    sizes: np.ndarray
    positions: np.ndarray
    uvs: np.ndarray | None
    normals: np.ndarray | None

    def part(self, start: int, end: int) -> Elements:
        """Return the elements whose statements are in a range."""
        first, last = np.searchsorted(self.statements, [start, end])
        corners = slice(int(self.sizes[:first].sum()), int(self.sizes[:last].sum()))
        indices = (self.positions, self.uvs, self.normals)
        parts = [None if array is None else array[corners] for array in indices]
        return Elements(self.statements[first:last], self.sizes[first:last], *parts)


def read_vertices(statements: Statements, warnings: WarningList) -> Vertices:
    """Read the lists ``v``, ``vt`` and ``vn``."""
    rows = _Rows(statements, "v", 3, "vertex", warnings.path)
    positions = rows.columns(3)
    normals = _Rows(statements, "vn", 3, "normal", warnings.path).columns(3)
    uvs = _Rows(statements, "vt", 1, "texture coordinate", warnings.path).columns(2)
    return Vertices(positions, _vertex_colors(rows), uvs, normals)


class _Rows:
    """The numbers of all statements of one kind."""

    def __init__(self, statements, keyword: str, least: int, what: str, path: str) -> None:
        members = statements.of(keyword)
        self.count = statements.count[members]
        words = statements.words_of(members)
        short = np.flatnonzero(self.count < least)
        if len(short):
            raise FileFormatError(
                f"{what} with {self.count[short[0]]} numbers, at least {least} are needed",
                path,
                statements.line(members[short[0]]),
            )
        try:
            self.numbers = parse_floats(words)
        except ValueError as error:
            word = error.args[1]
            row = int(np.searchsorted(np.cumsum(self.count), word, side="right"))
            raise FileFormatError(
                f"not a number: {shown(words[word])}", path, statements.line(members[row])
            ) from None
        self.start = np.cumsum(self.count) - self.count

    def columns(self, width: int) -> np.ndarray:
        """The first numbers of each row, zero where a row is shorter."""
        rows = len(self.count)
        if rows and self.count.min() == width == self.count.max():
            return self.numbers.reshape(rows, width)
        table = np.zeros((rows, width), np.float64)
        for column in range(width):
            present = self.count > column
            table[present, column] = self.numbers[self.start[present] + column]
        return table


def _vertex_colors(rows: _Rows) -> np.ndarray | None:
    """Colours after the coordinates: ``x y z r g b`` with or without alpha.

    They come from scanners and painting programs as display values 0..1 (or 0..255, if any is
    larger than 1), so they are taken as sRGB bytes.
    """
    has_color = rows.count >= 6
    if not has_color.any():
        return None
    colors = np.full((len(rows.count), 4), 255, np.uint8)
    values = np.ones((len(rows.count), 4), np.float64)
    for channel in range(4):
        present = has_color & (rows.count > 3 + channel)
        values[present, channel] = rows.numbers[rows.start[present] + 3 + channel]
    finite = np.isfinite(values).all(axis=1)
    largest = values[finite & has_color].max(initial=0.0)
    scale = 255.0 if largest <= 1 else 1.0
    with np.errstate(invalid="ignore"):
        scaled = np.clip(values * scale, 0, 255)
    chosen = has_color & finite
    colors[chosen] = np.floor(scaled[chosen] + 0.5).astype(np.uint8)
    colors[rows.count == 6, 3] = 255
    return colors


def read_elements(
    statements: Statements, keywords: tuple[str, ...], vertices: Vertices, warnings: WarningList
) -> Elements:
    """Read faces, lines or points.

    Raises
    ------
    FileFormatError
        A corner is no number, or a vertex that does not exist. A texture coordinate or a normal
        that does not exist is a warning, and the corner goes without.
    """
    members = np.flatnonzero(np.isin(statements.keyword, [keyword_code(k) for k in keywords]))
    sizes = statements.count[members]
    return _CornerParser(statements, members, sizes, warnings).parse(vertices)


class _CornerParser:
    """Reads the corners ``v``, ``v/vt``, ``v//vn`` and ``v/vt/vn`` of some statements."""

    def __init__(self, statements, members, sizes, warnings: WarningList) -> None:
        self._statements = statements
        self._members = members
        self._sizes = sizes
        self._warnings = warnings
        first = statements.first[members] + 1
        within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        self._words = np.repeat(first, sizes) + within

    def parse(self, vertices: Vertices) -> Elements:
        fields = self._split_at_slashes()
        indices = []
        for field, keyword, total, what in (
            (fields[0], "v", len(vertices.positions), "vertex"),
            (fields[1], "vt", len(vertices.uvs), "texture coordinate"),
            (fields[2], "vn", len(vertices.normals), "normal"),
        ):
            indices.append(self._indices(field, keyword, total, what))
        return Elements(self._members, self._sizes, *indices[:2], _usable(indices[2], vertices))

    def _split_at_slashes(self):
        """Start and end of the three fields of each corner; empty ones begin where they end."""
        starts = self._statements.word_starts[self._words]
        ends = self._statements.word_ends[self._words]
        slashes = np.flatnonzero(self._statements.codes == _SLASH)
        if len(slashes) == 0:
            return (starts, ends), None, None
        slashes = np.append(slashes, len(self._statements.codes))
        nearest = np.searchsorted(slashes, starts)
        first = np.minimum(slashes[nearest], ends)
        last = len(slashes) - 1
        second = np.minimum(slashes[np.minimum(nearest + 1, last)], ends)
        third = np.minimum(slashes[np.minimum(nearest + 2, last)], ends)
        self._fail_at(third < ends, "a corner has at most three indices")
        texture = (np.minimum(first + 1, ends), second)
        normal = (np.minimum(second + 1, ends), ends)
        return (starts, first), texture, normal

    def _indices(self, field, keyword: str, total: int, what: str) -> np.ndarray | None:
        is_vertex = keyword == "v"
        if field is None:
            return None
        values, sound = parse_integers(self._statements.codes, *field)
        self._fail_at(~sound, f"not a {what} index")
        missing = field[0] == field[1]
        if is_vertex:
            self._fail_at(missing, "a corner without a vertex index")
        indices = values - 1
        negative = values < 0
        if negative.any():
            before = np.cumsum(self._statements.keyword == keyword_code(keyword))[self._members]
            indices = np.where(negative, np.repeat(before, self._sizes) + values, indices)
        outside = ~missing & ((indices < 0) | (indices >= total))
        if is_vertex:
            self._fail_at(outside, f"{what} index out of range, there are {total}")
        elif outside.any():
            corner = int(outside.argmax())
            self._warnings.add(
                f"{what} index out of range, there are {total}: {self._shown(corner)}; "
                f"left out in {int(outside.sum())} corners",
                self._line(corner),
            )
        indices[missing | outside] = -1
        return None if not is_vertex and (indices < 0).all() else indices.astype(np.int32)

    def _fail_at(self, wrong: np.ndarray, message: str) -> None:
        if wrong.any():
            corner = int(wrong.argmax())
            raise FileFormatError(
                f"{message}: {self._shown(corner)}", self._warnings.path, self._line(corner)
            )

    def _shown(self, corner: int) -> str:
        return shown(self._statements.word(int(self._words[corner])))

    def _line(self, corner: int) -> int:
        element = int(np.searchsorted(np.cumsum(self._sizes), corner, side="right"))
        return self._statements.line(int(self._members[element]))


def _usable(normal_indices: np.ndarray | None, vertices: Vertices) -> np.ndarray | None:
    """Normals without a direction (zero, not finite) count as missing."""
    if normal_indices is None:
        return None
    largest = np.abs(vertices.normals).max(axis=1)
    usable = (largest >= _SHORTEST) & (largest <= _LONGEST)
    if usable.all():
        return normal_indices
    indices = np.where((normal_indices >= 0) & usable[normal_indices], normal_indices, -1)
    return indices if (indices >= 0).any() else None
