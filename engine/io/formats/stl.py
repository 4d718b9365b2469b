"""STL: triangle soup, as text or binary.

In: the bytes of a file. Out: a `Document`. Corners at exactly the same place become one vertex. The
file's normals are ignored; normals are computed by crease angle. The length decides whether a file
is binary, because many binary files begin with the word ``solid``.
"""

from __future__ import annotations

import re
from typing import NamedTuple, NoReturn

import numpy as np

from ..._native import loaders as native
from ...errors import FileFormatError
from ...model.geometry.groups import put_groups
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ..reading.documents import Document, DocumentObject
from ..reading.far_coordinates import moved_near
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from ..reading.text import decoded, shown, text_lines
from ..reading.triangulation import WorkBudget, triangulate
from ..reading.warning_list import WarningList
from ..reading.welding import number_rows
from .stl_spelling import usual_spelling

_HEADER = 84
# A facet has a normal, three corners, and two bytes of attributes.
_FACET_SIZE, _CORNERS_AT = 50, 12
_SKIPPED = (b"facet", b"outer", b"endfacet", b"endsolid")
_TEXT = re.compile(rb"(?:\xef\xbb\xbf)?\s*(?:solid(?![A-Za-z])|facet[ \t_]*normal)", re.IGNORECASE)
# Bytes that some programs append to text.
_PADDING, _ENDINGS = b"\0\x1a", (b"\0", b"\x1a")
_MAX_OBJECTS = 1000
_MOST = 2**31 - 1
_FORMS = (
    (b"vertex % % %", native.ROW, 3, _MOST, 0.0, 0),
    (b"endloop ", native.MARKED, 0, 0, 0.0, 0),
    *((word + b" ", native.SKIPPED, 0, 0, 0.0, 0) for word in _SKIPPED),
)
_FACET_FORM = 2  # the first of the skipped forms
_SNIFFED = 4096


class _Facets(NamedTuple):
    """The contents of a file.

    Attributes
    ----------
    facet_count : int
        The number of facets, F.
    positions : (V, 3) float32
        The distinct corner positions.
    faces : (T, 3) int32
    polygons : (T,) int32 or None
        The facet that each triangle was cut from; None if each facet is one.
    edge_visible : (T, 3) bool or None
    corner_count : int
        The total number of corners.
    solids : list of (str, int)
        The name of each solid, and its first facet; empty for the binary form.
    pose : (4, 4) float64 or None
        Moves the positions back to the file's coordinates.
    """

    facet_count: int
    positions: np.ndarray
    faces: np.ndarray
    polygons: np.ndarray | None
    edge_visible: np.ndarray | None
    corner_count: int
    solids: list[tuple[str, int]]
    pose: np.ndarray | None


def read_stl(source: Source, split: bool = False) -> Document:
    """Read an STL file, as `Reader.read`.

    With ``split``, each solid is an object; otherwise solids are groups of one mesh.
    """
    warnings = WarningList(source.path)
    facets = (_read_text if _is_text(source) else _read_binary)(source, warnings, split)
    whole = Mesh(
        facets.positions,
        facets.faces,
        materials=[Material(flat_shading=source.crease_angle == 0.0)],
        edge_visible=facets.edge_visible,
        crease_angle=source.crease_angle,
        name=source.stem,
    )
    groups = [] if facets.polygons is None else _groups(facets.solids, facets.polygons)
    put_groups(whole, {name: indices for name, indices in groups if name})
    objects = [DocumentObject(source.stem, whole, facets.pose)]
    if split and 1 < len(groups) <= _MAX_OBJECTS:
        named = [(name or source.stem, indices) for name, indices in groups]
        objects = [
            DocumentObject(name, _part(whole, indices, name), facets.pose)
            for name, indices in named
        ]
    counts = {
        "vertices": facets.corner_count,
        "faces": facets.facet_count,
        "triangles": len(facets.faces),
        "objects": [name for name, _ in facets.solids if name],
    }
    return Document("stl", objects, counts=counts, warnings=warnings.messages())


def _is_text(source: Source) -> bool:
    head = source.head(_SNIFFED)
    if _TEXT.match(head) is None and (head.strip() or _TEXT.match(source.data) is None):
        return False
    return not _has_binary_length(head, source.size) and b"\0" not in source.data.rstrip(_PADDING)


def _has_binary_length(head: bytes, size: int) -> bool:
    """Return whether a file's length matches the facet count in a binary header."""
    count = int.from_bytes(head[80:_HEADER], "little")
    return size == _HEADER + _FACET_SIZE * count


def _read_binary(source: Source, warnings: WarningList, split: bool) -> _Facets:
    size = source.size
    if size < _HEADER:
        raise FileFormatError("too short for an STL file", source.path)
    count = int.from_bytes(source.head(_HEADER)[80:], "little")
    end = _HEADER + _FACET_SIZE * count
    if end > size:
        held = (size - _HEADER) // _FACET_SIZE
        raise FileFormatError(
            f"the file ends after {held} of {count} triangles (at byte {size})", source.path
        )
    if end < size:
        warnings.add(f"{size - end} bytes behind the last triangle are left out")
    _require_facets(count, source)
    pieces = source.pieces(_HEADER, _FACET_SIZE, count)
    faces, positions = native.weld_facets(pieces, _CORNERS_AT, _FACET_SIZE, count)
    positions, pose = moved_near(positions) if split else (positions, None)
    return _Facets(count, positions, faces, None, None, 3 * count, [], pose)


def _require_facets(count: int, source: Source) -> None:
    if not count:
        raise FileFormatError("no triangles in this STL file", source.path)


def _read_text(source: Source, warnings: WarningList, split: bool) -> _Facets:
    """Read the text form."""
    if source.data.endswith(_ENDINGS):
        source = source._replace(content=source.data.rstrip(_PADDING))
    text = text_lines(source)
    corners, ends, solids, _ = _rows_of_any(text, source.path, warnings)
    corners, pose = moved_near(corners) if split else (corners, None)
    with np.errstate(over="ignore"):
        corners = corners.astype(np.float32)
    count = len(ends) - 1
    _require_facets(count, source)
    budget = WorkBudget.for_file(source.size)
    sizes = np.diff(ends)
    short = int((sizes < 3).sum())
    if short:
        warnings.add(f"{short} facets of fewer than three corners are left out")
    cut = triangulate(sizes, corners, budget)
    if not cut.is_complete:
        warnings.add("too many concave polygons: some are cut as if they were convex")
    place, first = number_rows(corners)
    faces, visible = place[cut.corners], cut.edge_visible
    return _Facets(count, corners[first], faces, cut.polygons, visible, len(corners), solids, pose)


class _Rows(NamedTuple):
    """The parsed lines of a text.

    Attributes
    ----------
    corners : (C, 3) float64
    ends : (F + 1,) int64
        The first corner of each facet, and their number.
    solids : list of (str, int)
    facet_lines : int
        Lines that begin a facet; more than the facets if some lines hold a whole facet.
    """

    corners: np.ndarray
    ends: np.ndarray
    solids: list[tuple[str, int]]
    facet_lines: int

    @property
    def polygons(self) -> int:
        """The number of facets with at least three corners."""
        return int((np.diff(self.ends) >= 3).sum())

    @property
    def may_lack_facets(self) -> bool:
        """Whether lines of facets or solids may hold more than was read from them."""
        is_less = not self.polygons or self.facet_lines >= len(self.ends)
        return is_less or any("facet" in name.lower() for name, _ in self.solids)


def _rows_of_any(text: bytes, path: str, warnings: WarningList) -> _Rows:
    """Read a text as it is or, if that fails, in normalised spelling."""
    rows = _rows_or_problem(text, path)
    if isinstance(rows, _Rows) and not rows.may_lack_facets:
        return rows
    spelling = usual_spelling(text)
    again = _rows_or_problem(spelling.text, path)
    if isinstance(rows, FileFormatError):
        if isinstance(again, FileFormatError):
            raise rows
    elif isinstance(again, FileFormatError) or again.polygons <= rows.polygons:
        return rows
    if spelling.left_out:
        warnings.add(f"{spelling.left_out} lines that are no part of STL are left out")
    return again


def _rows_or_problem(text: bytes, path: str) -> _Rows | FileFormatError:
    try:
        return _rows(text, path)
    except FileFormatError as problem:
        return problem


def _rows(text: bytes, path: str) -> _Rows:
    """Read lines; only those of vertices and loop ends count."""
    reader = native.FormReader(text, _FORMS, True)
    solids: list[tuple[str, int]] = []
    marks = [np.zeros(1, np.int64)]
    count, place = 0, reader.read(0)
    while place < len(text):
        end = text.index(b"\n", place)
        words = text[place:end].split(None, 1)
        if words[0].lower() != b"solid":
            _fail_at(path, text, place)
        marks.append(reader.take_marks()["rows"])
        name = decoded(words[1].strip()) if len(words) > 1 else ""
        count += len(marks[-1])
        solids.append((name, count))
        place = reader.read(end + 1)
    ends = np.concatenate([*marks, reader.take_marks()["rows"]])
    corners = reader.take_rows(0)
    if ends[-1] != len(corners):
        raise FileFormatError("the file ends within a facet", path, text.count(b"\n"))
    return _Rows(corners, ends, solids, reader.lines(_FACET_FORM))


def _fail_at(path: str, text: bytes, place: int) -> NoReturn:
    """Raise an error about the unrecognised line at an offset."""
    line = text[place : text.index(b"\n", place)]
    is_vertex = line.split()[0].lower() == b"vertex"
    what = "not three numbers" if is_vertex else "not a line of an STL file"
    number = text.count(b"\n", 0, place) + 1
    raise FileFormatError(f"{what}: {shown(line.strip())}", path, number)


def _groups(solids: list[tuple[str, int]], facets: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """Return the triangles of each solid; facets before the first ``solid`` belong to none."""
    if not solids:
        return []
    begins = np.searchsorted(facets, [start for _, start in solids])
    ends = np.append(begins[1:], len(facets))
    groups: dict[str, list[np.ndarray]] = {}
    for (name, _), begin, end in zip(solids, begins, ends, strict=True):
        if begin < end:
            groups.setdefault(name, []).append(np.arange(begin, end, dtype=np.int32))
    return [
        (name, parts[0] if len(parts) == 1 else np.concatenate(parts))
        for name, parts in groups.items()
    ]


def _part(whole: Mesh, chosen: np.ndarray, name: str) -> Mesh:
    """Return some triangles of a mesh, with the vertices that they use."""
    used, faces = np.unique(whole.faces[chosen], return_inverse=True)
    visible = whole.edge_visible
    return Mesh(
        whole.positions[used],
        faces.reshape(-1, 3),
        materials=whole.materials,
        edge_visible=None if visible is None else visible[chosen],
        crease_angle=whole.crease_angle,
        name=name,
    )


def _resembles_stl(head: bytes, size: int) -> bool:
    is_text = _TEXT.match(head) is not None and b"facet" in head
    return is_text or _has_binary_length(head, size)


READERS = (
    Reader(
        "stl",
        "STL, text and binary",
        "mesh",
        (".stl",),
        read_stl,
        resembles=_resembles_stl,
        up="+Z",
    ),
)
