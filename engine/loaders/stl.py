"""STL: triangles without anything else, as text or binary.

In: the bytes of a file. Out: a `Document`. Corners at exactly the same place become one vertex. The
normals of the file are not believed; a facet has one, so the material is flat-shaded. Whether a
file is binary is told by its length: many binary files begin with the word ``solid``.
"""

from __future__ import annotations

import re
from typing import NamedTuple

import numpy as np

from ..errors import FileFormatError
from ..materials import Material
from ..mesh import Mesh
from .documents import Document, DocumentObject
from .ear_clipping import WorkBudget
from .number_arrays import NotANumberError, parse_text
from .registry import Reader
from .sources import Source
from .text import decoded, shown, text_lines
from .triangulation import triangulate
from .warning_list import WarningList
from .welding import number_rows

_HEADER = 84
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_TEXT = re.compile(rb"\s*solid\b", re.IGNORECASE)
_MAX_OBJECTS = 1000


class _Facets(NamedTuple):
    """What a file holds.

    Attributes
    ----------
    corners : (C, 3) float32
        Positions.
    sizes : (F,) int64
        Corners of each facet: three, but for the polygons that some programs write.
    solids : list of (str, int)
        The name of each solid, and its first facet.
    """

    corners: np.ndarray
    sizes: np.ndarray
    solids: list[tuple[str, int]]


def read_stl(source: Source, split: bool = False) -> Document:
    """Read an STL file.

    Parameters
    ----------
    source : Source
    split : bool
        Make one object of each solid; otherwise they are groups of one mesh.

    Raises
    ------
    FileFormatError
    """
    warnings = WarningList(source.path)
    facets = _read_text(source) if _is_text(source.data) else _read_binary(source, warnings)
    if not len(facets.sizes):
        raise FileFormatError("no triangles in this STL file", source.path)
    numbers, first = number_rows(facets.corners)
    budget = WorkBudget.for_file(len(source.data))
    cut = triangulate(facets.sizes, facets.corners.astype(np.float64), budget)
    if not cut.is_complete:
        warnings.add("too many concave polygons: some are cut as if they were convex")
    faces = numbers.astype(np.int32)[cut.corners]
    positions = facets.corners[first]
    whole = Mesh(
        positions,
        faces,
        materials=[Material(flat_shading=True)],
        edge_visible=cut.edge_visible,
        name=source.stem,
    )
    groups = _groups(facets.solids, cut.polygons)
    whole.groups = {name: indices for name, indices in groups if name}
    objects = [DocumentObject(source.stem, whole)]
    if split and 1 < len(groups) <= _MAX_OBJECTS:
        named = [(name or source.stem, indices) for name, indices in groups]
        objects = [DocumentObject(name, _part(whole, indices, name)) for name, indices in named]
    counts = {
        "vertices": len(facets.corners),
        "faces": len(facets.sizes),
        "triangles": len(faces),
        "objects": [name for name, _ in facets.solids if name],
    }
    return Document("stl", objects, counts=counts, warnings=warnings.messages())


def _is_text(data: bytes) -> bool:
    if _TEXT.match(data) is None:
        return False
    count = int.from_bytes(data[80:_HEADER], "little")
    has_binary_length = len(data) == _HEADER + _FACET.itemsize * count
    return not has_binary_length and b"\0" not in data


def _read_binary(source: Source, warnings: WarningList) -> _Facets:
    data = source.data
    if len(data) < _HEADER:
        raise FileFormatError("too short for an STL file", source.path)
    count = int.from_bytes(data[80:_HEADER], "little")
    end = _HEADER + _FACET.itemsize * count
    if end > len(data):
        held = (len(data) - _HEADER) // _FACET.itemsize
        raise FileFormatError(
            f"the file ends after {held} of {count} triangles (at byte {len(data)})", source.path
        )
    if end < len(data):
        warnings.add(f"{len(data) - end} bytes behind the last triangle are left out")
    facets = np.frombuffer(data, _FACET, count, _HEADER)
    corners = np.array(facets["corners"], np.float32).reshape(-1, 3)
    return _Facets(corners, np.full(count, 3), [("", 0)])


def _read_text(source: Source) -> _Facets:
    """Read the text form line by line: what counts are the lines of vertices and of loops' ends."""
    lines = text_lines(source).split(b"\n")
    numbers: list[bytes] = []
    ends: list[int] = []
    solids: list[tuple[str, int]] = []
    for number, line in enumerate(lines, 1):
        words = line.split(None, 1)
        if not words:
            continue
        keyword = words[0].lower()
        if keyword == b"vertex":
            numbers.append(words[1] if len(words) > 1 else b"")
        elif keyword == b"endloop":
            ends.append(len(numbers))
        elif keyword == b"solid":
            solids.append((decoded(words[1].strip()) if len(words) > 1 else "", len(ends)))
        elif keyword not in (b"facet", b"outer", b"endfacet", b"endsolid"):
            raise FileFormatError(f"not a line of an STL file: {shown(line)}", source.path, number)
    if ends[-1:] != [len(numbers)] and (ends or numbers):
        raise FileFormatError("the file ends within a facet", source.path, len(lines) - 1)
    try:
        values = parse_text(b"\n".join(numbers))
    except NotANumberError:
        values = np.zeros(0)
    if len(values) != 3 * len(numbers):
        _fail_at_vertex(source.path, lines)
    with np.errstate(over="ignore"):
        corners = values.astype(np.float32).reshape(-1, 3)
    return _Facets(corners, np.diff(ends, prepend=0), solids)


def _fail_at_vertex(path: str, lines: list[bytes]):
    """Raise an error about the first vertex that has not got three numbers."""
    for number, line in enumerate(lines, 1):
        words = line.split()
        if words and words[0].lower() == b"vertex":
            try:
                is_sound = len(parse_text(b" ".join(words[1:]))) == 3
            except NotANumberError:
                is_sound = False
            if not is_sound:
                raise FileFormatError(f"not three numbers: {shown(line.strip())}", path, number)
    raise FileFormatError("a vertex has not got three numbers", path)


def _groups(solids: list[tuple[str, int]], facets: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """The triangles of each solid; facets before the first ``solid`` belong to none."""
    begins = np.searchsorted(facets, [start for _, start in solids])
    ends = np.append(begins[1:], len(facets))
    groups: dict[str, list[np.ndarray]] = {}
    for (name, _), begin, end in zip(solids, begins, ends, strict=True):
        if begin < end:
            groups.setdefault(name, []).append(np.arange(begin, end, dtype=np.int32))
    return [(name, np.concatenate(parts)) for name, parts in groups.items()]


def _part(whole: Mesh, chosen: np.ndarray, name: str) -> Mesh:
    """Some triangles of a mesh with the vertices that they use."""
    used, faces = np.unique(whole.faces[chosen], return_inverse=True)
    visible = whole.edge_visible
    return Mesh(
        whole.positions[used],
        faces.reshape(-1, 3),
        materials=whole.materials,
        edge_visible=None if visible is None else visible[chosen],
        name=name,
    )


READERS = (Reader("stl", "STL, text and binary", "mesh", (".stl",), read_stl),)
