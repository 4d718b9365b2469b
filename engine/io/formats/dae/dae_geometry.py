"""The meshes of a COLLADA file.

In: a ``<geometry>``. Out: a mesh without materials, whose material indices are those of the symbols
that primitives name. Polygons are cut into triangles; holes in them are filled.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....model.geometry.mesh import Mesh
from ....model.materials.material import Material
from ...reading.corner_mesh import Geometry, Triangles, Vertices, build_mesh
from ...reading.triangulation import WorkBudget, triangulate
from ...reading.xml_elements import Element
from .dae_file import DaeFile

_Ints = NDArray[np.int64]
_POLYGONS = ("triangles", "polylist", "polygons", "trifans", "tristrips")
_LINES = ("lines", "linestrips")
# What a corner may have, with the width of its rows.
_WIDTHS = {"POSITION": 3, "NORMAL": 3, "TEXCOORD": 2}


class DaeMesh(NamedTuple):
    """A mesh, and the symbol of each of its materials."""

    mesh: Mesh
    symbols: list[str]


class _Corners(NamedTuple):
    """The corners of a primitive: sizes of its polygons, and an index of each attribute."""

    sizes: _Ints
    indices: dict[str, _Ints]
    symbol: str


class GeometryReader:
    """Reads the geometries of a file, each once."""

    def __init__(self, file: DaeFile) -> None:
        self._file = file
        self._read: dict[int, DaeMesh | None] = {}
        self._budget = WorkBudget.for_file(file.source.size)

    def mesh(self, geometry: Element) -> DaeMesh | None:
        """Return the mesh of a geometry; None, with a warning, if it is none."""
        if id(geometry) not in self._read:
            self._read[id(geometry)] = self._made(geometry)
        return self._read[id(geometry)]

    def _made(self, geometry: Element) -> DaeMesh | None:
        mesh = geometry.first("mesh")
        if mesh is None:
            self._file.warn("a geometry that is no mesh is left out", geometry)
            return None
        tables = _Tables(self._file)
        polygons = [
            c for e in mesh.children if e.name in _POLYGONS for c in self._corners(e, tables)
        ]
        lines = [c for e in mesh.children if e.name in _LINES for c in self._corners(e, tables)]
        symbols = list(dict.fromkeys(corners.symbol for corners in polygons)) or [""]
        name = geometry.attributes.get("name") or geometry.attributes.get("id", "")
        built = build_mesh(
            self._geometry(tables, polygons, lines, symbols), [Material() for _ in symbols], name
        )
        return DaeMesh(built, symbols)

    def _geometry(
        self,
        tables: _Tables,
        polygons: list[_Corners],
        lines: list[_Corners],
        symbols: list[str],
    ) -> Geometry:
        sizes = _joined([corners.sizes for corners in polygons])
        count = int(sizes.sum())
        positions = tables.rows("POSITION")
        of_position = _joined([corners.indices["POSITION"] for corners in polygons])
        cut = triangulate(sizes, positions, self._budget, indices=of_position.astype(np.int32))
        of_corner = {
            name: _joined([c.indices.get(name, np.full(int(c.sizes.sum()), -1)) for c in polygons])
            for name in ("TEXCOORD", "NORMAL")
        }
        materials = _joined(
            [np.full(len(c.sizes), symbols.index(c.symbol), np.int64) for c in polygons]
        )
        has = {name: bool(count) and bool((held >= 0).any()) for name, held in of_corner.items()}
        normals = tables.rows("NORMAL")
        pairs = [_pairs(corners) for corners in lines]
        return Geometry(
            Vertices(positions, None, tables.rows("TEXCOORD"), normals),
            Triangles(
                of_position[cut.corners].astype(np.int32),
                of_corner["TEXCOORD"][cut.corners].astype(np.int32) if has["TEXCOORD"] else None,
                of_corner["NORMAL"][cut.corners].astype(np.int32) if has["NORMAL"] else None,
                materials[cut.polygons].astype(np.int32),
                cut.polygons,
                cut.edge_visible,
            ),
            normals if has["NORMAL"] and (of_corner["NORMAL"] >= 0).all() else None,
            np.concatenate([np.zeros((0, 2), np.int64), *pairs]),
            np.zeros(0, np.int64),
            self._file.source.crease_angle,
        )

    def _corners(self, primitive: Element, tables: _Tables) -> list[_Corners]:
        """Return the corners of a primitive; none if it has none."""
        inputs = primitive.all("input")
        stride = 1 + max((_whole(i.attributes.get("offset")) for i in inputs), default=-1)
        if stride == 0:
            return []
        lists = [self._file.whole_numbers(p) for p in _index_lists(primitive)]
        rows = [held[: len(held) // stride * stride].reshape(-1, stride) for held in lists]
        sizes, rows = self._sizes(primitive, rows)
        corners = np.concatenate([np.zeros((0, stride), np.int64), *rows])
        if int(sizes.sum()) > len(corners):
            raise self._file.fault(f"<{primitive.name}> has too few indices", primitive)
        corners = corners[: int(sizes.sum())]
        indices: dict[str, _Ints] = {}
        for one in inputs:
            place = corners[:, _whole(one.attributes.get("offset"))]
            for semantic, source in self._meant(one):
                if semantic in _WIDTHS and semantic not in indices:
                    indices[semantic] = tables.numbered(semantic, source, place, primitive)
        if "POSITION" not in indices:
            raise self._file.fault(f"<{primitive.name}> has no positions", primitive)
        return [_Corners(sizes, indices, primitive.attributes.get("material", ""))]

    def _meant(self, given: Element) -> list[tuple[str, Element]]:
        """Return the semantics of an input with their sources: of VERTEX, those of its vertices."""
        file, semantic = self._file, given.attributes.get("semantic", "")
        url = given.attributes.get("source", "")
        if semantic != "VERTEX":
            found = file.find(url, "source") if semantic in _WIDTHS else None
            return [] if found is None else [(semantic, found)]
        vertices = file.named(url, given, "vertices")
        return [pair for one in vertices.all("input") for pair in self._meant(one)]

    def _sizes(self, primitive: Element, rows: list[_Ints]) -> tuple[_Ints, list[_Ints]]:
        """Return the corners of each polygon or line, and the rows that they have."""
        kind = primitive.name
        if kind == "polylist":
            return self._file.whole_numbers(primitive.first("vcount")), rows
        if kind in ("polygons", "linestrips"):
            return np.array([len(held) for held in rows], np.int64), rows
        if kind in ("trifans", "tristrips"):
            rows = [_strip(held, kind == "trifans") for held in rows]
        each = 2 if kind == "lines" else 3
        total = sum(len(held) for held in rows) // each
        return np.full(total, each, np.int64), rows


class _Tables:
    """The rows of all sources that a geometry names, one table for each attribute."""

    def __init__(self, file: DaeFile) -> None:
        self._file = file
        self._first: dict[tuple[str, int], tuple[int, int]] = {}
        self._rows: dict[str, list[NDArray[np.float64]]] = {name: [] for name in _WIDTHS}

    def rows(self, semantic: str) -> NDArray[np.float64]:
        """Return the table of an attribute."""
        return np.concatenate([np.zeros((0, _WIDTHS[semantic])), *self._rows[semantic]])

    def numbered(self, semantic: str, source: Element, place: _Ints, user: Element) -> _Ints:
        """Return indices into the table of an attribute, for indices into a source."""
        key = semantic, id(source)
        if key not in self._first:
            rows = self._source_rows(source, _WIDTHS[semantic])
            before = sum(len(held) for held in self._rows[semantic])
            self._rows[semantic].append(rows)
            self._first[key] = before, len(rows)
        first, count = self._first[key]
        if len(place) and place.max() >= count:
            raise self._file.fault(
                f"<{user.name}> names {semantic} {int(place.max())} of {count}", user
            )
        return place + first

    def _source_rows(self, source: Element, width: int) -> NDArray[np.float64]:
        """Return the first ``width`` numbers of each row; missing ones are 0."""
        file, accessor = self._file, source.first("technique_common", "accessor")
        array = source.first("float_array")
        if accessor is not None:
            array = file.find(accessor.attributes.get("source", ""), "float_array") or array
        attributes = {} if accessor is None else accessor.attributes
        numbers = file.numbers(array)[_whole(attributes.get("offset")) :]
        stride = max(_whole(attributes.get("stride"), width), 1)
        count = min(_whole(attributes.get("count"), len(numbers)), len(numbers) // stride)
        rows = np.zeros((count, width))
        held = numbers[: count * stride].reshape(-1, stride)[:, :width]
        rows[:, : held.shape[1]] = held
        return rows


def _index_lists(primitive: Element) -> list[Element]:
    """Return the lists of indices; of polygons with holes, that of the outline."""
    lists = []
    for child in primitive.children:
        outline = child.first("p") if child.name == "ph" else child
        if outline is not None and outline.name == "p":
            lists.append(outline)
    return lists


def _whole(text: str | None, usual: int = 0) -> int:
    return int(text) if text is not None and text.isdecimal() and len(text) < 10 else usual


def _joined(parts: list[_Ints]) -> _Ints:
    return np.concatenate([np.zeros(0, np.int64), *parts])


def _strip(rows: _Ints, is_fan: bool) -> _Ints:
    """Return the corners of the triangles of a strip or fan."""
    count = max(len(rows) - 2, 0)
    k = np.arange(count)
    if is_fan:
        numbers = np.stack([np.zeros_like(k), k + 1, k + 2], axis=1)
    else:
        odd = k % 2
        numbers = np.stack([k, k + 1 + odd, k + 2 - odd], axis=1)
    return rows[numbers.ravel()]


def _pairs(corners: _Corners) -> _Ints:
    """Return the ends of each segment of lines."""
    ends = np.cumsum(corners.sizes)
    first = np.setdiff1d(np.arange(int(corners.sizes.sum())), ends - 1)
    held = corners.indices["POSITION"]
    return np.stack([held[first], held[first + 1]], axis=1)
