"""OFF, the Object File Format of Geomview: text polygons, with the usual prefixes.

In: the bytes of a file. Out: a `Document` of one object. ``N``, ``C`` and ``ST`` before ``OFF``
announce normals, colours and texture coordinates of the vertices, ``4`` a divisor of the
coordinates, ``n`` a number of dimensions, of which there must be three; colours after the
coordinates are also read without ``C``, and after a face they are face colours. If the lines do not
match vertices and faces, the numbers are read one by one. Binary files are refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from typing import NoReturn

import numpy as np

from ..._native import loaders as native
from ...errors import FileFormatError
from ...model.materials.material import Material
from ..reading.documents import Document, DocumentObject
from ..reading.far_coordinates import moved_near
from ..reading.indexed_mesh import IndexedGeometry, build_indexed_mesh
from ..reading.linked_textures import give_companion_texture
from ..reading.number_arrays import NotANumberError, NumberRows, read_numbers
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from ..reading.text import shown, text_lines
from ..reading.triangulation import WorkBudget, triangulate
from ..reading.vertex_values import finite_uvs, usable_normals
from ..reading.warning_list import WarningList

_KEYWORD = re.compile(
    rb"(?:(ST)?[ \t]*(C)?[ \t]*(N)?[ \t]*(4)?[ \t]*(n)?[ \t]*OFF|off)(?![A-Za-z])"
)
_MOST_DIGITS = 19
# Numbers in vertex lines beyond the announced ones: none, or a colour.
_COLOR_WIDTHS = (0, 3, 4)


def read_off(source: Source, split: bool = False) -> Document:
    """Read an OFF file, as `Reader.read`: one object.

    With ``split``, coordinates far from the origin are moved near it.
    """
    warnings = WarningList(source.path)
    reader = _OffReader(source, warnings)
    geometry = reader.read()
    geometry.crease_angle = source.crease_angle
    pose = None
    if split:
        geometry.positions, pose = moved_near(geometry.positions)
    mesh = build_indexed_mesh(geometry, source.stem)
    mesh.materials = [Material()]
    if mesh.uvs is not None:
        give_companion_texture(source, mesh.materials, warnings)
    counts = {
        "vertices": len(geometry.positions),
        "faces": reader.face_count,
        "triangles": len(geometry.corners),
    }
    entry = DocumentObject(source.stem, mesh, pose)
    return Document("off", [entry], counts=counts, warnings=warnings.messages())


class _OffReader:
    """Reads the first lines one by one, and all other numbers at once."""

    def __init__(self, source: Source, warnings: WarningList) -> None:
        self._path = source.path
        self._warnings = warnings
        self._budget = WorkBudget.for_file(source.size)
        if b"BINARY" in source.data[:20]:
            self._fail("binary OFF files are not read")
        self._text = text_lines(source)
        self._has = dict.fromkeys(("uvs", "colors", "normals", "divisor"), False)
        # Where the lines of numbers start.
        self._body = 0
        self._vertex_count = self.face_count = 0

    def read(self) -> IndexedGeometry:
        self._read_head()
        try:
            return self._geometry(self._rows())
        except FileFormatError as problem:
            rows = self._rows_of_words()
            if rows is None:
                raise
            try:
                return self._geometry(rows)
            except FileFormatError:
                raise problem from None

    def _geometry(self, rows: NumberRows) -> IndexedGeometry:
        count = self._vertex_count
        split = int(rows.widths[:count].sum())
        geometry = self._vertices(rows.values[:split].reshape(count, -1))
        if self.face_count:
            self._faces(geometry, rows.values[split:], rows.widths[count:])
        if geometry.normals is not None:
            geometry.normals = usable_normals(
                geometry.normals, geometry.positions, geometry.corners
            )
        return geometry

    def _read_head(self) -> None:
        """Read the keyword, if present, and the counts, wherever lines end."""
        position, line = next(self._filled_lines(0), (0, b""))
        match = _KEYWORD.match(line.lstrip())
        place = position
        if match is not None:
            place += len(line) - len(line.lstrip()) + match.end()
            self._has = {name: bool(match[k]) for k, name in enumerate(self._has, 1)}
            if match[5]:
                place = self._read_dimensions(place)
        self._read_counts(place)

    def _read_dimensions(self, place: int) -> int:
        """Read the number of dimensions; return the position after it."""
        place, word = self._next_word(place)
        if word != b"3":
            self._fail("only three-dimensional OFF files are read", place)
        return place + len(word)

    def _read_counts(self, place: int) -> None:
        """Read the numbers of vertices and faces; that of edges is ignored and optional."""
        counts, line = [], b""
        for _ in range(2):
            place, word = self._next_word(place)
            end = self._text.index(b"\n", place) if word else place
            line = line or self._text[place:end]
            if not (word.isdigit() and len(word) < _MOST_DIGITS):
                if not word:
                    self._fail("no counts of vertices and faces")
                self._fail(f"not counts of vertices and faces: {shown(line)}", place)
            counts.append(int(word))
            place += len(word)
        end = self._text.index(b"\n", place)
        rest = self._text[place:end].partition(b"#")[0].split()
        self._body = end + 1
        if len(rest) > 1:  # the vertex numbers begin in this line
            self._body = place + self._text[place:end].index(rest[0]) + len(rest[0])
        elif not rest:
            self._skip_edges()
        self._vertex_count, self.face_count = counts
        if counts[0] == 0:
            self._fail("no vertices in this OFF file")

    def _skip_edges(self) -> None:
        """Skip a number of edges on its own line."""
        place, line = next(self._filled_lines(self._body), (0, b""))
        if len(line.split()) == 1:
            self._body = self._text.index(b"\n", place) + 1

    def _next_word(self, place: int) -> tuple[int, bytes]:
        """Return the next word from a position on, and its position; empty at the end."""
        place, line = next(self._filled_lines(place), (len(self._text) - 1, b""))
        word = line.split(None, 1)[0] if line else b""
        return place + line.index(word), word

    def _filled_lines(self, start: int) -> Iterator[tuple[int, bytes]]:
        """Yield the non-empty lines: position, and content without comment."""
        while start < len(self._text):
            end = self._text.index(b"\n", start)
            line = self._text[start:end].partition(b"#")[0]
            if line and not line.isspace():
                yield start, line
            start = end + 1

    def _rows(self) -> NumberRows:
        """Return the lines of vertices and faces, as many as announced."""
        vertices, faces = self._vertex_count, self.face_count
        body = memoryview(self._text)[self._body :]
        try:
            rows = read_numbers(body, native.HASH_COMMENTS, vertices + faces, widths=True)
        except NotANumberError as error:
            self._check_widths(error.widths)
            self._fail(f"not a number: {shown(error.word)}", self._body + error.position)
        count = len(rows.widths)
        if count < vertices:
            self._fail(f"the file ends before its {vertices} vertices do", len(self._text) - 1)
        self._check_widths(rows.widths)
        if count < vertices + faces:
            self._fail(f"the file ends before its {faces} faces do", len(self._text) - 1)
        return rows

    def _rows_of_words(self) -> NumberRows | None:
        """Return the rows of vertices and faces for arbitrary line ends; None if impossible."""
        body = memoryview(self._text)[self._body :]
        try:
            values = read_numbers(body, native.HASH_COMMENTS).values
        except NotANumberError:
            return None
        for color_width in _COLOR_WIDTHS:
            width = self._needed() + color_width
            start = width * self._vertex_count
            if start + self.face_count > len(values):
                break
            sizes = _sizes_of_faces(values[start:], self.face_count)
            if sizes is not None:
                widths = np.concatenate([np.full(self._vertex_count, width), sizes + 1])
                return NumberRows(values, widths, len(self._text))
        return None

    def _needed(self) -> int:
        """Return the minimum count of numbers per vertex."""
        has = self._has
        return 3 + 3 * has["normals"] + 2 * has["uvs"] + has["divisor"]

    def _check_widths(self, widths: np.ndarray) -> None:
        """Check that vertex lines have enough numbers, and equally many."""
        widths = widths[: self._vertex_count]
        needed = self._needed()
        wrong = (widths != widths[:1]) | (widths < needed)
        if wrong.any():
            row = int(wrong.argmax())
            self._fail(
                f"a vertex of {widths[row]} numbers, {max(widths[0], needed)} are expected",
                self._row(row)[0],
            )

    def _vertices(self, table: np.ndarray) -> IndexedGeometry:
        geometry = IndexedGeometry(table[:, :3], np.zeros((0, 3), np.int32))
        rest = table[:, 3:]
        if self._has["divisor"]:
            with np.errstate(all="ignore"):
                geometry.positions = geometry.positions / rest[:, :1]
            rest = rest[:, 1:]
        if self._has["normals"]:
            with np.errstate(over="ignore"):
                geometry.normals = rest[:, :3].astype(np.float32)
            rest = rest[:, 3:]
        if self._has["uvs"]:
            geometry.uvs = finite_uvs(rest[:, -2:])
            rest = rest[:, :-2]
        if rest.shape[1] in (3, 4):
            geometry.colors = _display_colors(rest)
        elif rest.shape[1]:
            self._warnings.add(f"{rest.shape[1]} further numbers of each vertex are left out")
        return geometry

    def _faces(self, geometry: IndexedGeometry, values: np.ndarray, widths: np.ndarray) -> None:
        starts = np.cumsum(widths) - widths
        sizes = values[starts]
        wrong = ~((sizes >= 0) & (sizes < widths) & (sizes == np.floor(sizes)))
        if wrong.any():
            self._fail_at_face("not a face", int(wrong.argmax()))
        sizes = sizes.astype(np.int64)
        starts += 1
        corners = self._corners(values, starts, sizes)
        colors = self._face_colors(values, starts + sizes, widths - 1 - sizes)
        if sizes.min() == 3 == sizes.max():
            geometry.corners, geometry.face_colors = corners.reshape(-1, 3), colors
            return
        if (sizes < 3).any():
            count = int((sizes < 3).sum())
            self._warnings.add(f"{count} faces of fewer than three corners are left out")
        cut = triangulate(sizes, geometry.positions, self._budget, indices=corners)
        if not cut.is_complete:
            self._warnings.add("too many concave polygons: some are cut as if they were convex")
        geometry.corners = corners[cut.corners]
        geometry.edge_visible = cut.edge_visible
        geometry.face_colors = None if colors is None else colors[cut.polygons]

    def _corners(self, values: np.ndarray, starts: np.ndarray, sizes: np.ndarray) -> np.ndarray:
        """Return the vertices of all corners, (C,) int32."""
        items = native.copy_numbers(values, starts.reshape(-1, 1), sizes.reshape(-1, 1), 0)
        corners, wrong = native.indices_of(items.reshape(1, -1), self._vertex_count)
        if wrong is not None:
            row = int(np.searchsorted(np.cumsum(sizes), wrong, side="right"))
            self._fail_at_face("vertex index out of range", row)
        return native.frozen(corners).reshape(-1)

    def _face_colors(
        self, values: np.ndarray, starts: np.ndarray, counts: np.ndarray
    ) -> np.ndarray | None:
        """Return the colours after face corners: (F, 4) uint8, white for faces without one."""
        has_color = (counts == 3) | (counts == 4)
        if (counts > 0).any() and (others := int(((counts > 0) & ~has_color).sum())):
            self._warnings.add(f"what stands behind the corners of {others} faces is left out")
        if not has_color.any():
            return None
        rows = np.full((len(starts), 4), np.nan)
        for channel in range(4):
            present = has_color & (counts > channel)
            rows[present, channel] = values[starts[present] + channel]
        return _display_colors(rows)

    def _row(self, row: int) -> tuple[int, bytes]:
        """Return position and text of a vertex line or, counted on, a face line."""
        end = len(self._text) - 1, b""  # the rows are not lines
        return next(islice(self._filled_lines(self._body), row, None), end)

    def _fail_at_face(self, reason: str, face: int) -> NoReturn:
        position, line = self._row(self._vertex_count + face)
        self._fail(f"{reason}: {shown(line.strip())}", position)

    def _fail(self, message: str, position: int | None = None) -> NoReturn:
        line = None if position is None else self._text.count(b"\n", 0, position) + 1
        raise FileFormatError(message, self._path, line)


def _sizes_of_faces(values: np.ndarray, count: int) -> np.ndarray | None:
    """Return the number of corners of each face in a flat list of numbers; None if inconsistent."""
    numbers, sizes = values.data, []
    place, end = 0, len(values)
    for _ in range(count):
        if place >= end or not 0 <= numbers[place] < end:
            return None
        sizes.append(int(numbers[place]))
        place += sizes[-1] + 1
    return np.array(sizes, np.int64) if place == end else None


def _display_colors(values: np.ndarray) -> np.ndarray:
    """Return colours of 3 or 4 columns, 0..255 or 0..1, as sRGB bytes; non-finite ones white.

    The alpha column may have another range.
    """
    colors = np.full((len(values), 4), 255, np.uint8)
    for columns in (slice(0, 3), slice(3, 4)):
        part = values[:, columns]
        largest = part[np.isfinite(part)].max(initial=0)
        scaled = np.nan_to_num(part * (1.0 if largest > 1 else 255.0), nan=255.0)
        colors[:, columns][:, : part.shape[1]] = np.floor(np.clip(scaled, 0, 255) + 0.5)
    return colors


def _is_off(head: bytes) -> bool:
    return _KEYWORD.match(head.lstrip()) is not None


READERS = (Reader("off", "Object File Format", "mesh", (".off",), read_off, signature=_is_off),)
