"""The objects and groups of an OBJ file.

In: everything that was read of the file. Out: one `Mesh` for all, or one for each ``o`` statement;
the triangles of each group; the counts of a `Document`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..materials import Material
from .corner_mesh import Geometry, Triangles, Vertices, build_mesh
from .documents import DocumentObject
from .obj_elements import Elements
from .obj_states import ObjStates
from .smoothing import join_seams
from .warning_list import WarningList

# No model has more; files that do are taken as one object, and a group name beyond is left out.
_MAX_OBJECTS = 1000
_MAX_GROUPS_OF_A_FACE = 16


class ObjParts(NamedTuple):
    """What an OBJ file holds.

    Attributes
    ----------
    vertices : Vertices
    triangles : Triangles
    normals : (N, 3) float or None
        What ``triangles.normals`` refers to, if anything.
    faces, lines, points : Elements
    states : ObjStates
    materials : list of Material
    """

    vertices: Vertices
    triangles: Triangles
    normals: np.ndarray | None
    faces: Elements
    lines: Elements
    points: Elements
    states: ObjStates
    materials: list[Material]

    def counts(self) -> dict:
        """Return the lists of the file, as `Document.counts` shows them."""
        states = self.states
        groups = [name for s in states.groups.tolist() for name in states.name(s).split()]
        return {
            "vertices": len(self.vertices.positions),
            "uvs": len(self.vertices.uvs),
            "normals": len(self.vertices.normals),
            "colors": 0 if self.vertices.colors is None else len(self.vertices.colors),
            "faces": len(self.faces.sizes),
            "triangles": len(self.triangles.positions),
            "lines": len(self.lines.sizes),
            "points": int(self.points.sizes.sum()),
            "objects": _unique([states.name(s) for s in states.objects.tolist()]),
            "groups": _unique(groups),
            "materials": [material.name for material in self.materials if material.name],
            "libraries": _unique([name for name, _ in states.libraries]),
        }

    def whole(self, stem: str) -> DocumentObject:
        """Return all as one object, named by its only ``o`` statement or else ``stem``."""
        setters = self.states.objects.tolist()
        name = (self.states.name(setters[0]) if len(setters) == 1 else "") or stem
        points = self.points.positions
        if not (len(self.faces.sizes) or len(self.lines.sizes) or len(points)):
            # Nothing but vertices: a point cloud.
            points = np.arange(len(self.vertices.positions))
        geometry = Geometry(
            self.vertices, self.triangles, self.normals, _segments(self.lines), points
        )
        return self._built(geometry, name, self._triangle_statements())

    def objects(self, stem: str, warnings: WarningList) -> list[DocumentObject]:
        """Return one object for each ``o`` that holds anything, and one for what stands before."""
        setters = self.states.objects.tolist()
        if not setters:
            return [self.whole(stem)]
        if len(setters) > _MAX_OBJECTS:
            warnings.add(f"{len(setters)} objects are taken as one, {_MAX_OBJECTS} are the limit")
            return [self.whole(stem)]
        end = int(max((e.statements.max(initial=0) for e in self[3:6]), default=0)) + 1
        ranges = zip([0, *setters], [*setters, max(end, setters[-1])], strict=True)
        names = [stem, *(self.states.name(s) or stem for s in setters)]
        statements = self._triangle_statements()
        found = [
            self._object(name, start, stop, statements)
            for name, (start, stop) in zip(names, ranges, strict=True)
        ]
        return [entry for entry in found if entry is not None] or [self.whole(stem)]

    def _object(self, name, start: int, end: int, statements) -> DocumentObject | None:
        """What stands in a range of statements, or None if nothing does."""
        first, last = np.searchsorted(statements, [start, end])
        lines, points = self.lines.part(start, end), self.points.part(start, end)
        if first == last and not len(lines.sizes) and not len(points.sizes):
            return None
        chosen = slice(int(first), int(last))
        geometry = Geometry(
            self.vertices,
            self.triangles.part(chosen),
            self.normals,
            _segments(lines),
            points.positions,
        )
        return self._built(geometry.with_own_positions(), name, statements[chosen])

    def _built(self, geometry: Geometry, name: str, statements: np.ndarray) -> DocumentObject:
        mesh = build_mesh(geometry, self.materials, name)
        if not mesh.has_normals:
            join_seams(mesh)
        mesh.groups = self._groups(statements)
        return DocumentObject(name, mesh)

    def _triangle_statements(self) -> np.ndarray:
        return self.faces.statements[self.triangles.polygons]

    def _groups(self, statements: np.ndarray) -> dict[str, np.ndarray]:
        """Triangles of each group name; ``g`` may put what follows into several groups."""
        setters = self.states.groups
        starts = np.searchsorted(statements, setters)
        ends = np.append(starts[1:], len(statements))[: len(setters)]
        ranges: dict[str, list[np.ndarray]] = {}
        for number in np.flatnonzero(starts < ends).tolist():
            triangles = np.arange(starts[number], ends[number], dtype=np.int32)
            names = self.states.name(int(setters[number])).split()
            for name in _unique(names)[:_MAX_GROUPS_OF_A_FACE]:
                ranges.setdefault(name, []).append(triangles)
        return {name: np.concatenate(parts) for name, parts in ranges.items()}


def _segments(lines: Elements) -> np.ndarray:
    """The segments (L, 2) of polylines, as position indices."""
    is_last = np.zeros(len(lines.positions), bool)
    ends = np.cumsum(lines.sizes)
    is_last[ends[lines.sizes > 0] - 1] = True
    first = np.flatnonzero(~is_last)
    return np.stack([lines.positions[first], lines.positions[first + 1]], axis=1)


def _unique(names: list[str]) -> list[str]:
    return list(dict.fromkeys(names))
