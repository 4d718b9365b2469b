"""OFF, the Object File Format of Geomview: polygons as text, with the usual prefixes.

In: the bytes of a file. Out: a `Document` of one object. ``N``, ``C`` and ``ST`` before ``OFF``
announce normals, colours and texture coordinates of the vertices; colours behind the coordinates
are taken without it too, and behind a face they are its own. Binary and four-dimensional files are
refused.
"""

from __future__ import annotations

import re

import numpy as np

from ..errors import FileFormatError
from ..materials import Material
from .documents import Document, DocumentObject
from .indexed_mesh import IndexedGeometry, build_indexed_mesh
from .number_arrays import NotANumberError, parse_text
from .ply_vertices import finite_uvs, usable_normals
from .registry import Reader
from .sources import Source
from .text import shown, text_lines
from .triangulation import WorkBudget, triangulate
from .warning_list import WarningList

_KEYWORD = re.compile(rb"(ST)?(C)?(N)?(4)?(n)?OFF\b")


def read_off(source: Source, split: bool = False) -> Document:
    """Read an OFF file.

    Parameters
    ----------
    source : Source
    split : bool
        Of no effect: the format knows one object.

    Raises
    ------
    FileFormatError
    """
    warnings = WarningList(source.path)
    reader = _OffReader(source, warnings)
    geometry = reader.read()
    mesh = build_indexed_mesh(geometry, source.stem)
    mesh.materials = [Material()]
    counts = {
        "vertices": len(geometry.positions),
        "faces": reader.face_count,
        "triangles": len(geometry.corners),
    }
    entry = DocumentObject(source.stem, mesh)
    return Document("off", [entry], counts=counts, warnings=warnings.messages())


class _OffReader:
    """Goes through the lines that hold anything, and knows their numbers."""

    def __init__(self, source: Source, warnings: WarningList) -> None:
        self._path = source.path
        self._warnings = warnings
        self._budget = WorkBudget.for_file(source.size)
        if b"BINARY" in source.data[:20]:
            self._fail("binary OFF files are not read")
        self._lines = [line.partition(b"#")[0] for line in text_lines(source).split(b"\n")]
        filled = (k for k, line in enumerate(self._lines) if line and not line.isspace())
        self._filled = np.fromiter(filled, np.int64)
        self._has = self._take_keyword()
        self._next = 0
        self.face_count = 0

    def read(self) -> IndexedGeometry:
        counts = self._counts()
        rows = self._rows(counts[0], "vertices")
        table = self._vertex_table(rows)
        self.face_count = counts[1]
        geometry = self._vertices(table)
        self._faces(geometry, self._rows(counts[1], "faces"))
        if geometry.normals is not None:
            geometry.normals = usable_normals(
                geometry.normals, geometry.positions, geometry.corners
            )
        return geometry

    def _take_keyword(self) -> dict[str, bool]:
        """Take the keyword, if there is one, off the first line that holds anything."""
        first = self._filled[0] if len(self._filled) else 0
        line = self._lines[first].lstrip()
        match = _KEYWORD.match(line)
        if match is None:
            return dict.fromkeys(("uvs", "colors", "normals"), False)
        if match[4] or match[5]:
            self._fail("only three-dimensional OFF files are read", int(first) + 1)
        self._lines[first] = line[match.end() :]
        if not self._lines[first].strip():
            self._filled = self._filled[1:]
        return {"uvs": bool(match[1]), "colors": bool(match[2]), "normals": bool(match[3])}

    def _counts(self) -> list[int]:
        """Vertices and faces; the number of edges, the third, says nothing and may be missing."""
        if not len(self._filled):
            self._fail("no counts of vertices and faces")
        line = self._lines[self._filled[0]]
        words = line.split()
        self._next = 1
        if not 2 <= len(words) <= 3 or not all(w.isdigit() and len(w) < 19 for w in words[:2]):
            self._fail(f"not counts of vertices and faces: {shown(line)}", int(self._filled[0]) + 1)
        counts = [int(word) for word in words[:2]]
        if counts[0] == 0:
            self._fail("no vertices in this OFF file")
        return counts

    def _rows(self, count: int, what: str) -> slice:
        start = self._next
        if start + count > len(self._filled):
            self._fail(f"the file ends before its {count} {what} do", len(self._lines) - 1)
        self._next += count
        return slice(start, self._next)

    def _numbers(self, rows: slice) -> tuple[np.ndarray, np.ndarray]:
        """The numbers of some lines, and how many each line holds."""
        lines = [self._lines[k] for k in self._filled[rows].tolist()]
        text = b"\n".join(lines)
        try:
            values = parse_text(text)
        except NotANumberError as error:
            row = text.count(b"\n", 0, error.position)
            self._fail(f"not a number: {shown(error.word)}", self._line(rows.start + row))
        widths = np.fromiter((len(line.split()) for line in lines), np.int64, len(lines))
        return values, widths

    def _vertex_table(self, rows: slice) -> np.ndarray:
        values, widths = self._numbers(rows)
        needed = 3 + 3 * self._has["normals"] + 2 * self._has["uvs"]
        wrong = (widths != widths[0]) | (widths < needed)
        if wrong.any():
            row = int(wrong.argmax())
            self._fail(
                f"a vertex of {widths[row]} numbers, {max(widths[0], needed)} are expected",
                self._line(rows.start + row),
            )
        return values.reshape(len(widths), -1)

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

    def _faces(self, geometry: IndexedGeometry, rows: slice) -> None:
        if rows.start == rows.stop:
            return
        values, widths = self._numbers(rows)
        starts = np.cumsum(widths) - widths
        sizes = values[starts]
        self._check(
            ~((sizes >= 0) & (sizes < widths) & (sizes == np.floor(sizes))), rows, "corners"
        )
        sizes = sizes.astype(np.int64)
        within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        corners = values[np.repeat(starts + 1, sizes) + within]
        is_vertex = (corners >= 0) & (corners < len(geometry.positions))
        wrong = ~is_vertex | (corners != np.floor(corners))
        self._check(np.bincount(np.repeat(np.arange(len(sizes)), sizes), wrong) > 0, rows, "vertex")
        if (sizes < 3).any():
            count = int((sizes < 3).sum())
            self._warnings.add(f"{count} faces of fewer than three corners are left out")
        corners = corners.astype(np.int32)
        cut = triangulate(sizes, geometry.positions, self._budget, indices=corners)
        if not cut.is_complete:
            self._warnings.add("too many concave polygons: some are cut as if they were convex")
        geometry.corners = corners[cut.corners]
        geometry.edge_visible = cut.edge_visible
        colors = _face_colors(values, starts + 1 + sizes, widths - 1 - sizes)
        geometry.face_colors = None if colors is None else colors[cut.polygons]

    def _check(self, wrong: np.ndarray, rows: slice, what: str) -> None:
        if wrong.any():
            number = rows.start + int(wrong.argmax())
            text = shown(self._lines[self._filled[number]].strip())
            reason = {"corners": "not a face", "vertex": "vertex index out of range"}[what]
            self._fail(f"{reason}: {text}", self._line(number))

    def _line(self, filled: int) -> int:
        return int(self._filled[filled]) + 1

    def _fail(self, message: str, line: int | None = None):
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
