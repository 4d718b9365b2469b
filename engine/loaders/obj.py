"""Wavefront OBJ: polygons, lines and points, with the materials of its libraries.

In: the bytes of a file, and the libraries and images that it names. Out: a `Document`. The order of
work: statements, vertex lists, elements, triangles, materials, normals, welding. Free-form curves
and surfaces are left out with a warning; ``call`` and ``csh`` are never followed.
"""

from __future__ import annotations

import numpy as np

from ..errors import FileFormatError
from ..materials import Material
from ..mesh import Mesh
from .corner_mesh import Triangles, Vertices, build_mesh
from .documents import Document, DocumentObject
from .ear_clipping import WorkBudget
from .obj_elements import Elements, read_elements, read_vertices
from .obj_materials import give_companion_texture, read_library, used_materials
from .obj_statements import Statements, keyword_code
from .registry import Reader
from .smoothing import FLAT, fill_normals
from .sources import Source
from .text import decoded, shown, text_lines
from .triangulation import triangulate
from .warning_list import WarningList

_GEOMETRY = ("v", "vt", "vn", "f", "fo", "l", "p", "g", "o", "s")
# Statements that change nothing that is drawn here.
_IGNORED = (b"lod", b"shadow_obj", b"trace_obj", b"bevel", b"c_interp", b"d_interp", b"vp", b"mg")
_MAX_GROUP = 2**31 - 1

# The work that concave polygons may take: a file of up to a megabyte loads within two seconds, a
# larger one within ten.
_LARGE_FILE = 1 << 20
_WORK = 1_000_000
_WORK_FOR_LARGE_FILES = 6_000_000


def read_obj(source: Source, split: bool = False) -> Document:
    """Read an OBJ file.

    Parameters
    ----------
    source : Source
    split : bool
        Make one object of each ``o`` statement's faces; otherwise all are one mesh.

    Raises
    ------
    FileFormatError
    """
    warnings = WarningList(source.path)
    statements = Statements(text_lines(source))
    vertices = read_vertices(statements, warnings)
    if len(vertices.positions) == 0:
        raise FileFormatError("no vertices in this OBJ file", source.path)
    faces = read_elements(statements, ("f", "fo"), vertices, warnings)
    lines = read_elements(statements, ("l",), vertices, warnings)
    points = read_elements(statements, ("p",), vertices, warnings)
    states = _States(statements, warnings)
    materials, material_of_use = _materials(source, states, len(vertices.uvs) > 0, warnings)
    is_large = len(source.data) > _LARGE_FILE
    budget = WorkBudget(_WORK_FOR_LARGE_FILES if is_large else _WORK)
    triangles = _triangles(statements, vertices, faces, budget, warnings)
    triangles.materials = _material_ids(
        states, material_of_use, materials, faces.statements[triangles.polygons]
    )
    groups = states.smoothing_groups(faces.statements)
    filled = fill_normals(
        vertices.positions,
        triangles.positions,
        triangles.normals,
        vertices.normals,
        groups[triangles.polygons],
        triangles.polygons,
    )
    normals = None
    if filled is not None and len(triangles.positions):
        triangles.normals, normals = filled
    parts = _Parts(vertices, triangles, normals, faces, lines, points, states)
    document = Document("obj", counts=parts.counts(materials))
    document.objects = parts.objects(materials, source.stem, split)
    document.warnings = warnings.messages()
    return document


class _States:
    """The statements that set a state for the elements behind them."""

    def __init__(self, statements: Statements, warnings: WarningList) -> None:
        self._statements = statements
        self._warnings = warnings
        self.material_uses: list[tuple[str, int]] = []
        self.use_statements: list[int] = []
        self.libraries: list[tuple[str, int]] = []
        self.objects = statements.of("o")
        self.groups = statements.of("g")
        self._read_others()

    def _read_others(self) -> None:
        """Note materials and libraries; warn once of each kind that is not understood."""
        statements = self._statements
        unknown: dict[bytes, list[int]] = {}
        known = np.isin(statements.keyword, [keyword_code(k) for k in _GEOMETRY])
        for statement in np.flatnonzero(~known).tolist():
            keyword = statements.keyword_text(statement)
            if keyword == b"usemtl":
                self.material_uses.append((self.name(statement), statements.line(statement)))
                self.use_statements.append(statement)
            elif keyword == b"mtllib":
                self.libraries.append((self.name(statement), statements.line(statement)))
            elif keyword not in _IGNORED:
                unknown.setdefault(keyword, []).append(statement)
        for keyword, members in unknown.items():
            self._warnings.add(
                f"{shown(keyword)} is not understood; {len(members)} statements left out",
                statements.line(members[0]),
            )

    def name(self, statement: int) -> str:
        return decoded(self._statements.rest(statement))

    def smoothing_groups(self, elements: np.ndarray) -> np.ndarray:
        """Smoothing group of each element: all one group if the file sets none at all."""
        setters = self._statements.of("s")
        if len(setters) == 0:
            return np.full(len(elements), 1, np.int64)
        values = np.array([self._smoothing_group(s) for s in setters.tolist()], np.int64)
        return np.concatenate([[FLAT], values])[last_before(setters, elements) + 1]

    def _smoothing_group(self, statement: int) -> int:
        word = (self._statements.words(statement) or [b"off"])[0]
        if word == b"off":
            return FLAT
        if word == b"on":
            return 1
        try:
            return min(max(int(word[:10]), 0), _MAX_GROUP)
        except ValueError:
            self._warnings.add(
                f"smoothing group {shown(word)} counts as off", self._statements.line(statement)
            )
            return FLAT


def last_before(setters, elements: np.ndarray) -> np.ndarray:
    """Number of the last setting statement before each element, -1 for none."""
    return np.searchsorted(np.asarray(setters, np.int64), elements) - 1


def _materials(source, states: _States, has_uvs: bool, warnings):
    """The materials in use (an unnamed one if there are none) and the one of each use."""
    library = read_library(source, states.libraries, warnings)
    materials, material_of_use = used_materials(states.material_uses, library, warnings)
    if not materials:
        materials = [Material()]
    if not library and has_uvs:
        give_companion_texture(source, materials, warnings)
    return materials, material_of_use


def _material_ids(states, material_of_use, materials, of_triangles) -> np.ndarray:
    """Material of each triangle; those before any ``usemtl`` get one more, an unnamed one."""
    use = last_before(states.use_statements, of_triangles)
    if not material_of_use:
        return np.zeros(len(of_triangles), np.int32)
    ids = np.array(material_of_use, np.int32)[use]
    before_any = use < 0
    if before_any.any():
        ids[before_any] = len(materials)
        materials.append(Material(texture=None))
    return ids


def _triangles(statements, vertices: Vertices, faces: Elements, budget, warnings) -> Triangles:
    """Cut the faces into triangles."""
    short = np.flatnonzero(faces.sizes < 3)
    if len(short):
        warnings.add(
            f"{len(short)} faces of fewer than three corners are left out",
            statements.line(faces.statements[short[0]]),
        )
    cut = triangulate(faces.sizes, vertices.positions[faces.positions], budget)
    if not cut.is_complete:
        warnings.add("too many concave polygons: some are cut as if they were convex")
    return Triangles(
        faces.positions[cut.corners],
        faces.uvs[cut.corners],
        faces.normals[cut.corners],
        np.zeros(len(cut.corners), np.int32),
        cut.polygons,
        cut.edge_visible,
    )


class _Parts:
    """What the file holds, ready to become one mesh or one for each object."""

    def __init__(self, vertices, triangles, normals, faces, lines, points, states) -> None:
        self._vertices = vertices
        self._triangles = triangles
        self._normals = normals
        self._faces = faces
        self._lines = lines
        self._points = points
        self._states = states

    def counts(self, materials: list[Material]) -> dict:
        """The lists of the file, as `Document.counts` shows them."""
        states = self._states
        return {
            "vertices": len(self._vertices.positions),
            "uvs": len(self._vertices.uvs),
            "normals": len(self._vertices.normals),
            "colors": 0 if self._vertices.colors is None else len(self._vertices.colors),
            "faces": len(self._faces.sizes),
            "triangles": len(self._triangles.positions),
            "lines": len(self._lines.sizes),
            "points": int(self._points.sizes.sum()),
            "objects": _unique([states.name(s) for s in states.objects.tolist()]),
            "groups": _unique(self._group_names(states.groups.tolist())),
            "materials": [material.name for material in materials if material.name],
            "libraries": _unique([name for name, _ in states.libraries]),
        }

    def _group_names(self, statements: list[int]) -> list[str]:
        return [name for s in statements for name in self._states.name(s).split()]

    def objects(self, materials, stem: str, split: bool) -> list[DocumentObject]:
        """One object for all, or one for each ``o`` (and one for what stands before the first)."""
        setters = self._states.objects
        names = [stem, *(self._states.name(s) or stem for s in setters.tolist())]
        if not split or len(setters) == 0:
            name = names[1] if len(names) == 2 else stem
            return [DocumentObject(name, self._mesh(materials, name, None), None)]
        objects = []
        for number, name in enumerate(names):
            mesh = self._mesh(materials, name, number)
            if len(mesh.faces) or len(mesh.lines) or len(mesh.points):
                objects.append(DocumentObject(name, mesh, None))
        return objects

    def _mesh(self, materials, name: str, number: int | None) -> Mesh:
        """The mesh of one object, counted from 0 for what stands before the first; None: all."""
        triangles = self._triangles
        statements = self._faces.statements[triangles.polygons]
        if number is not None:
            chosen = last_before(self._states.objects, statements) + 1 == number
            triangles, statements = triangles.select(chosen), statements[chosen]
        segments = _segments(self._of_object(self._lines, number))
        points = self._of_object(self._points, number).positions
        is_cloud = not (len(self._faces.sizes) or len(self._lines.sizes) or len(points))
        if is_cloud and number is None:
            points = np.arange(len(self._vertices.positions))
        mesh = build_mesh(
            self._vertices, triangles, self._normals, segments, points, materials, name
        )
        mesh.groups = self._groups(statements)
        return mesh

    def _of_object(self, elements: Elements, number: int | None) -> Elements:
        """Those lines or points that belong to an object."""
        if number is None:
            return elements
        chosen = last_before(self._states.objects, elements.statements) + 1 == number
        corners = np.repeat(chosen, elements.sizes)
        return Elements(
            elements.statements[chosen],
            elements.sizes[chosen],
            elements.positions[corners],
            elements.uvs[corners],
            elements.normals[corners],
        )

    def _groups(self, statements: np.ndarray) -> dict[str, np.ndarray]:
        """Triangles of each group name; ``g`` may put what follows into several groups."""
        setters = self._states.groups
        if len(setters) == 0:
            return {}
        starts = np.searchsorted(statements, setters)
        ends = np.append(starts[1:], len(statements))
        ranges: dict[str, list[np.ndarray]] = {}
        for setter, start, end in zip(setters.tolist(), starts, ends, strict=True):
            if start < end:
                for name in _unique(self._group_names([setter])):
                    ranges.setdefault(name, []).append(np.arange(start, end, dtype=np.int32))
        return {name: np.concatenate(parts) for name, parts in ranges.items()}


def _segments(lines: Elements) -> np.ndarray:
    """The segments (L, 2) of polylines."""
    corners = np.arange(len(lines.positions))
    is_last = np.zeros(len(corners), bool)
    ends = np.cumsum(lines.sizes)
    is_last[ends[lines.sizes > 0] - 1] = True
    first = corners[~is_last]
    return np.stack([lines.positions[first], lines.positions[first + 1]], axis=1)


def _unique(names: list[str]) -> list[str]:
    return list(dict.fromkeys(names))


def _resembles_obj(head: bytes) -> bool:
    return b"\0" not in head and any(
        line.startswith((b"v ", b"vn ", b"vt ", b"f ", b"mtllib ")) for line in head.splitlines()
    )


READERS = (
    Reader("obj", "Wavefront OBJ with MTL", "mesh", (".obj",), read_obj, resembles=_resembles_obj),
)
