"""OFF, the Object File Format of Geomview: polygons as text, with the usual prefixes.

In: the bytes of a file. Out: a `Document` of one object. ``N``, ``C`` and ``ST`` before ``OFF``
announce normals, colours and texture coordinates of the vertices; colours behind the coordinates
are taken without it too, and behind a face they are its own. Binary and four-dimensional files are
refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

import numpy as np

from .._native import loaders as native
from ..errors import FileFormatError
from ..materials.material import Material
from .documents import Document, DocumentObject
from .far_coordinates import moved_near
from .indexed_mesh import IndexedGeometry, build_indexed_mesh
from .linked_textures import give_companion_texture
from .number_arrays import NotANumberError, NumberRows, read_numbers
from .registry import Reader
from .sources import Source
from .text import shown, text_lines
from .triangulation import WorkBudget, triangulate
from .vertex_values import finite_uvs, usable_normals
from .warning_list import WarningList

_KEYWORD = re.compile(rb"(ST)?(C)?(N)?(4)?(n)?OFF\b")


def read_off(source: Source, split: bool = False) -> Document:
    """Read an OFF file.

    Parameters
    ----------
    source : Source
    split : bool
        Give coordinates far from the origin another one; the format knows one object.

    Raises
    ------
    FileFormatError
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
    """Reads the first lines one by one, and the numbers of all others at once."""

    def __init__(self, source: Source, warnings: WarningList) -> None:
        self._path = source.path
        self._warnings = warnings
        self._budget = WorkBudget.for_file(source.size)
        if b"BINARY" in source.data[:20]:
            self._fail("binary OFF files are not read")
        self._text = text_lines(source)
        self._has = dict.fromkeys(("uvs", "colors", "normals"), False)
        # Where the lines of numbers begin.
        self._body = 0
        self._vertex_count = self.face_count = 0

    def read(self) -> IndexedGeometry:
        self._read_head()
        rows = self._rows()
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
        """Read the keyword, if there is one, and the counts, which may stand behind it."""
        lines = self._filled_lines(0)
        position, line = next(lines, (0, b""))
        match = _KEYWORD.match(line.lstrip())
        if match is not None:
            if match[4] or match[5]:
                self._fail("only three-dimensional OFF files are read", position)
            self._has = {name: bool(match[k]) for k, name in enumerate(self._has, 1)}
            line = line.lstrip()[match.end() :]
            if not line.strip():
                position, line = next(lines, (0, b""))
        if not line:
            self._fail("no counts of vertices and faces")
        self._vertex_count, self.face_count = self._counts(line, position)
        self._body = self._text.index(b"\n", position) + 1

    def _filled_lines(self, start: int) -> Iterator[tuple[int, bytes]]:
        """Go along the lines that hold anything: the place of each, and it without a comment."""
        while start < len(self._text):
            end = self._text.index(b"\n", start)
            line = self._text[start:end].partition(b"#")[0]
            if line and not line.isspace():
                yield start, line
            start = end + 1

    def _counts(self, line: bytes, position: int) -> list[int]:
        """Vertices and faces; the number of edges, the third, says nothing and may be missing."""
        words = line.split()
        if not 2 <= len(words) <= 3 or not all(w.isdigit() and len(w) < 19 for w in words[:2]):
            self._fail(f"not counts of vertices and faces: {shown(line)}", position)
        counts = [int(word) for word in words[:2]]
        if counts[0] == 0:
            self._fail("no vertices in this OFF file")
        return counts

    def _rows(self) -> NumberRows:
        """The lines of vertices and faces, as many as there must be."""
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

    def _check_widths(self, widths: np.ndarray) -> None:
        """Check that the lines of vertices hold enough numbers, and all as many."""
        widths = widths[: self._vertex_count]
        needed = 3 + 3 * self._has["normals"] + 2 * self._has["uvs"]
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
        colors = _face_colors(values, starts + sizes, widths - 1 - sizes)
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
        """The vertices of all corners, (C,) int32."""
        items = native.copy_numbers(values, starts.reshape(-1, 1), sizes.reshape(-1, 1), 0)
        corners, wrong = native.indices_of(items.reshape(1, -1), self._vertex_count)
        if wrong is not None:
            row = int(np.searchsorted(np.cumsum(sizes), wrong, side="right"))
            self._fail_at_face("vertex index out of range", row)
        return native.frozen(corners).reshape(-1)

    def _row(self, row: int) -> tuple[int, bytes]:
        """The place and the text of a vertex's line, or, counted on, of a face's."""
        return next(islice(self._filled_lines(self._body), row, None))

    def _fail_at_face(self, reason: str, face: int):
        position, line = self._row(self._vertex_count + face)
        self._fail(f"{reason}: {shown(line.strip())}", position)

    def _fail(self, message: str, position: int | None = None):
        line = None if position is None else self._text.count(b"\n", 0, position) + 1
        raise FileFormatError(message, self._path, line)


def _display_colors(values: np.ndarray) -> np.ndarray:
    """Colours of 3 or 4 columns, 0..255 or 0..1, as sRGB bytes; white for what is not finite."""
    largest = values[np.isfinite(values)].max(initial=0)
    scaled = np.nan_to_num(values * (1.0 if largest > 1 else 255.0), nan=255.0)
    colors = np.full((len(values), 4), 255, np.uint8)
    colors[:, : values.shape[1]] = np.floor(np.clip(scaled, 0, 255) + 0.5)
    return colors


def _face_colors(values: np.ndarray, starts: np.ndarray, counts: np.ndarray) -> np.ndarray | None:
    """Colours behind the corners of faces: (F, 4) uint8, white for faces without one."""
    has_color = (counts == 3) | (counts == 4)
    if not has_color.any():
        return None
    rows = np.full((len(starts), 4), np.nan)
    for channel in range(4):
        present = has_color & (counts > channel)
        rows[present, channel] = values[starts[present] + channel]
    return _display_colors(rows)


def _is_off(head: bytes) -> bool:
    return _KEYWORD.match(head.lstrip()) is not None


READERS = (Reader("off", "Object File Format", "mesh", (".off",), read_off, signature=_is_off),)
