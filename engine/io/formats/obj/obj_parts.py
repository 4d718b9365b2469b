"""The objects and groups of an OBJ file.

In: the parsed file. Out: one `Mesh` for all, or one for each ``o`` statement; the triangles of each
group; the counts of a `Document`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ....model.geometry.groups import put_groups
from ....model.materials.material import Material
from ...reading.corner_mesh import Geometry, Triangles, build_mesh
from ...reading.documents import DocumentObject
from ...reading.far_coordinates import moved_near
from ...reading.smoothing import join_seams
from ...reading.text import words_of
from ...reading.warning_list import WarningList
from .obj_file import Elements, ObjFile, ObjStates

# No real model has more; such files are loaded as one object, and further group names are dropped.
_MAX_OBJECTS = 1000
_MAX_GROUPS_OF_A_FACE = 16


class ObjParts(NamedTuple):
    """The content of an OBJ file, ready to become meshes.

    Attributes
    ----------
    file : ObjFile
    triangles : Triangles
    normals : (N, 3) float or None
        The normals that ``triangles.normals`` indexes, if any.
    states : ObjStates
    materials : list of Material
    crease_angle : float
        Radians, for normals that neither the file nor its smoothing groups define.
    moves : bool
        Whether objects far from the origin are moved near it.
    """

    file: ObjFile
    triangles: Triangles
    normals: np.ndarray | None
    states: ObjStates
    materials: list[Material]
    crease_angle: float
    moves: bool = False

    def counts(self) -> dict[str, Any]:
        """Return the list lengths of the file, for `Document.counts`."""
        file, states = self.file, self.states
        groups = [name for names in states.groups.names() for name in words_of(names)]
        colors = file.vertices.colors
        return {
            "vertices": len(file.vertices.positions),
            "uvs": len(file.vertices.uvs),
            "normals": len(file.vertices.normals),
            "colors": 0 if colors is None else len(colors),
            "faces": len(file.faces.sizes),
            "triangles": len(self.triangles.positions),
            "lines": len(file.lines.sizes),
            "points": len(file.points.positions),
            "objects": _unique(states.objects.names()),
            "groups": _unique(groups),
            "materials": [material.name for material in self.materials if material.name],
            "libraries": _unique(states.libraries.names()),
        }

    def whole(self, stem: str) -> DocumentObject:
        """Return everything as one object, named by its only ``o`` statement or else ``stem``."""
        file, objects = self.file, self.states.objects
        name = (objects.names()[0] if len(objects) == 1 else "") or stem
        points = file.points.positions
        if not (len(file.faces.sizes) or len(file.lines.sizes) or len(points)):
            # Only vertices: a point cloud.
            points = np.arange(len(file.vertices.positions))
        geometry = Geometry(
            file.vertices,
            self.triangles,
            self.normals,
            _segments(file.lines),
            points,
            self.crease_angle,
        )
        return self._built(geometry, name, self._starts(), slice(None))

    def objects(self, stem: str, warnings: WarningList) -> list[DocumentObject]:
        """Return one object for each non-empty ``o``, and one for elements before the first."""
        setters = self.states.objects
        if not len(setters):
            return [self.whole(stem)]
        if len(setters) > _MAX_OBJECTS:
            warnings.add(f"{len(setters)} objects are taken as one, {_MAX_OBJECTS} are the limit")
            return [self.whole(stem)]
        names = [stem, *(name or stem for name in setters.names())]
        file = self.file
        bounds = {
            what: [0, *setters.before[what].tolist(), len(elements.sizes)]
            for what, elements in (
                ("faces", file.faces),
                ("lines", file.lines),
                ("points", file.points),
            )
        }
        triangles = self._first_triangles(np.array(bounds["faces"])).tolist()
        starts = self._starts()
        found = []
        for k, name in enumerate(names):
            lines = file.lines.part(*bounds["lines"][k : k + 2])
            points = file.points.part(*bounds["points"][k : k + 2])
            chosen = slice(*triangles[k : k + 2])
            if chosen.start < chosen.stop or len(lines.sizes) or len(points.sizes):
                found.append(self._object(name, chosen, lines, points, starts))
        return found or [self.whole(stem)]

    def _object(
        self, name: str, chosen: slice, lines: Elements, points: Elements, starts: np.ndarray
    ) -> DocumentObject:
        """Return some triangles, lines and points as one object."""
        geometry = Geometry(
            self.file.vertices,
            self.triangles.part(chosen),
            self.normals,
            _segments(lines),
            points.positions,
            self.crease_angle,
        )
        return self._built(geometry.with_own_positions(), name, starts, chosen)

    def _built(
        self, geometry: Geometry, name: str, starts: np.ndarray, chosen: slice
    ) -> DocumentObject:
        pose = None
        if self.moves:
            positions, pose = moved_near(geometry.vertices.positions)
            geometry = geometry._replace(vertices=geometry.vertices._replace(positions=positions))
        mesh = build_mesh(geometry, self.materials, name)
        if not mesh.has_normals:
            join_seams(mesh)
        put_groups(mesh, self._groups(starts, chosen))
        return DocumentObject(name, mesh, pose)

    def _starts(self) -> np.ndarray:
        """Return the first triangle after each ``g``, and the number of triangles."""
        faces = np.append(self.states.groups.before["faces"], len(self.file.faces.sizes))
        return self._first_triangles(faces)

    def _first_triangles(self, faces: np.ndarray) -> np.ndarray:
        """Return the first triangle of each face, or the next one for a face without triangles."""
        return np.searchsorted(self.triangles.polygons, faces)

    def _groups(self, starts: np.ndarray, chosen: slice) -> dict[str, np.ndarray]:
        """Return the triangles of each group name; one ``g`` may name several groups."""
        first, last, _ = chosen.indices(int(starts[-1]))
        starts = np.clip(starts, first, last) - first
        ranges: dict[str, list[np.ndarray]] = {}
        names = self.states.groups.names()
        for number in np.flatnonzero(starts[:-1] < starts[1:]).tolist():
            triangles = np.arange(starts[number], starts[number + 1], dtype=np.int32)
            for name in _unique(words_of(names[number]))[:_MAX_GROUPS_OF_A_FACE]:
                ranges.setdefault(name, []).append(triangles)
        return {
            name: parts[0] if len(parts) == 1 else np.concatenate(parts)
            for name, parts in ranges.items()
        }


def _segments(lines: Elements) -> np.ndarray:
    """Return the segments (L, 2) of polylines, as position indices."""
    is_last = np.zeros(len(lines.positions), bool)
    ends = np.cumsum(lines.sizes)
    is_last[ends[lines.sizes > 0] - 1] = True
    first = np.flatnonzero(~is_last)
    return np.stack([lines.positions[first], lines.positions[first + 1]], axis=1)


def _unique(names: list[str]) -> list[str]:
    return list(dict.fromkeys(names))
