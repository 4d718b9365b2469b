"""Writer of Wavefront OBJ: all data of a mesh, with its materials in a library beside it.

Each vertex has its own ``vt`` and ``vn``; vertices that are one point of the surface share a ``v``.
So a reader that numbers the combinations restores the old vertex order. Faces are written as their
original polygons, if these have one material and the same groups.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from ...._native import writers as native
from ....base.files.atomic_write import Files, StreamFiles
from ....errors import InvalidArgumentError
from ....model.geometry.creases import SMOOTH
from ....model.geometry.mesh import Mesh
from ....model.materials.colors import srgb_bytes
from ...reading.welding import number_rows
from ...writing.losses import lost_of_materials, lost_parts, not_held
from ...writing.outlines import Outlines, polygon_outlines
from ...writing.rows import write_floats, write_integers
from ...writing.side_files import SideFiles
from ...writing.writer_registry import Writer
from ...writing.written_names import encoded, line_text, renamed, unique
from .mtl_writer import Library, is_plain, material_names

_POINTS_A_LINE = 16
_FACES_AT_ONCE = 1 << 16


def write_obj(mesh: Mesh, path: str, files: Files) -> list[str]:
    """Write an OBJ file and its library; return a line for each loss."""
    names, told = [], []
    unwritten: dict[str, list[str]] = {}
    side_files = None
    if not is_plain(mesh.materials):
        if isinstance(files, StreamFiles):
            raise InvalidArgumentError(
                "obj files have their materials in a library beside them, for which a stream has "
                "no place: write to a path, or take the materials off"
            )
        side_files = SideFiles(path)
        names = material_names(mesh.materials)
        library = Library(side_files, files)
        library.write(mesh.materials, names)
        unwritten = library.unwritten
        told += _about(side_files, library, mesh, names)
    told += _write_model(mesh, files.create(path), side_files, names)
    lost = lost_parts(mesh, "obj", "uvs1", "tangents", "values")
    return [*lost_of_materials(mesh, unwritten), *lost, *told]


def _about(side_files: SideFiles, library: Library, mesh: Mesh, names: list[str]) -> list[str]:
    """Return the messages about the library."""
    told = renamed("materials", [material.name for material in mesh.materials], names)
    if library.not_copied:
        images = ", ".join(map(repr, dict.fromkeys(library.not_copied)))
        told.append(f"images that are named, but not copied: {images}")
    if side_files.library != side_files.usual_library:
        usual, actual = map(os.path.basename, (side_files.usual_library, side_files.library))
        told.append(f"{usual!r} is not engine3d's to replace: the materials are in {actual!r}")
    return told


def _write_model(
    mesh: Mesh, file: Any, side_files: SideFiles | None, names: list[str]
) -> list[str]:
    """Write the model's own text; return a line for each loss."""
    told = []
    file.write(b"# written by engine3d\n")
    if side_files is not None:
        file.write(encoded(f"mtllib {os.path.basename(side_files.library)}\n"))
    if mesh.name:
        name = line_text(mesh.name)
        file.write(encoded(f"o {name}\n"))
        told += renamed("objects", [mesh.name], [name])
    position_of = _write_vertices(mesh, file)
    told += _write_faces(mesh, file, position_of, names)
    _write_lines_and_points(mesh, file, position_of)
    return told


def _write_vertices(mesh: Mesh, file: Any) -> np.ndarray:
    """Write the vertex lists; return the position number of each vertex, from 1."""
    numbers, first = _positions(mesh)
    colors = None if mesh.colors is None else srgb_bytes(mesh.colors)
    positions = mesh.positions[first]
    if colors is None:
        write_floats(file, "v ", positions)
    else:
        channels = 4 if (colors[:, 3] != 255).any() else 3
        rows = np.concatenate([positions, np.round(colors[first, :channels] / 255, 4)], axis=1)
        write_floats(file, "v ", rows)
    if mesh.uvs is not None:
        write_floats(file, "vt ", mesh.uvs)
    if mesh.has_normals:
        write_floats(file, "vn ", mesh.normals)
    return numbers + 1


def _positions(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Return the position number of each vertex, and the first vertex of each number."""
    count = len(mesh.positions)
    if mesh.position_ids is None or (mesh.uvs is None and not mesh.has_normals):
        return np.arange(count), np.arange(count)
    # Vertices of one point may still differ in position or colour.
    parts = [mesh.position_ids, number_rows(mesh.positions)[0]]
    if mesh.colors is not None:
        parts.append(number_rows(mesh.colors)[0])
    keys = np.stack(parts, axis=1).astype(np.uint32)
    if mesh.has_normals:
        return number_rows(keys)
    # Readers join points along seams again; here only consecutive vertices can safely share a point
    # of the file, which keeps the vertices in order.
    is_new = np.r_[True, (keys[1:] != keys[:-1]).any(axis=1)][:count]
    return np.cumsum(is_new) - 1, np.flatnonzero(is_new)


def _write_faces(mesh: Mesh, file: Any, position_of: np.ndarray, names: list[str]) -> list[str]:
    """Write the faces with their states; return a line for each loss."""
    groups, labels, told = _group_sets(mesh)
    is_flat = np.array([material.flat_shading for material in mesh.materials])
    smooth = ~is_flat[mesh.material_ids] | mesh.has_normals
    states = np.stack([mesh.material_ids, groups, smooth], axis=1)
    outlines = polygon_outlines(mesh, states)
    if outlines.lost_edges:
        told += not_held("obj", [f"the hidden edges of {outlines.lost_edges} triangles"])
    if names:
        _declare_materials(mesh, file, names)
    first = outlines.first_faces
    if not len(first):
        return told
    states = states[first]
    starts = np.flatnonzero(np.r_[True, (states[1:] != states[:-1]).any(axis=1)])
    lines = _FaceLines(mesh, outlines, position_of)
    # Without smoothing statements, readers search for creases.
    old = (-1, 0, True if mesh.has_normals or mesh.crease_angle < SMOOTH else None)
    for start, end in zip(starts.tolist(), [*starts[1:].tolist(), len(first)], strict=True):
        new = tuple(states[start].tolist())
        if names and new[0] != old[0]:
            file.write(encoded(f"usemtl {names[new[0]]}\n"))
        if new[1] != old[1]:
            file.write(encoded(" ".join(["g", *labels[new[1]]])) + b"\n")
        if new[2] != old[2]:
            file.write(b"s 1\n" if new[2] else b"s off\n")
        old = new
        lines.write(file, start, end)
    return told


def _declare_materials(mesh: Mesh, file: Any, names: list[str]) -> None:
    """Name all materials in order, unless the faces do; readers number them by first use."""
    used, first = np.unique(mesh.material_ids, return_index=True)
    in_order = len(used) == len(names) and (np.diff(first) > 0).all()
    if not in_order:
        file.write(encoded("".join(f"usemtl {name}\n" for name in names)))


def _group_sets(mesh: Mesh) -> tuple[np.ndarray, list[list[str]], list[str]]:
    """Return each face's set of groups, the names in each set, and the losses."""
    sets = np.zeros(len(mesh.faces), np.int64)
    labels: list[list[str]] = [[]]
    groups = {name: faces for name, faces in mesh.groups.items() if len(faces)}
    wanted = ["_".join(line_text(name).split()) or "group" for name in groups]
    written = unique(wanted)
    for label, faces in zip(written, groups.values(), strict=True):
        old, number = np.unique(sets[faces], return_inverse=True)
        sets[faces] = len(labels) + number.reshape(-1)
        labels += [[*labels[k], label] for k in old.tolist()]
    told = renamed("groups", groups, written)
    if len(groups) < len(mesh.groups):
        told += not_held("obj", ["groups without faces"])
    return sets, labels, told


class _FaceLines:
    """The lines of faces, formatted in batches and written in runs."""

    def __init__(self, mesh: Mesh, outlines: Outlines, position_of: np.ndarray) -> None:
        self._outlines = outlines
        self._position_of = position_of
        self._form = (
            (native.V, native.V_VN),
            (native.V_VT, native.V_VT_VN),
        )[mesh.uvs is not None][mesh.has_normals]
        self._corner_ends = np.append(0, np.cumsum(outlines.sizes))
        self._first = self._last = 0
        self._text = np.zeros(0, np.uint8)
        self._ends = [0]

    def write(self, file: Any, start: int, end: int) -> None:
        """Write the lines ``start`` to ``end - 1``; each call continues the previous one."""
        while start < end:
            if start == self._last:
                self._make(start)
            stop = min(end, self._last)
            file.write(self._text[self._ends[start - self._first] : self._ends[stop - self._first]])
            start = stop

    def _make(self, first: int) -> None:
        sizes = self._outlines.sizes[first : first + _FACES_AT_ONCE]
        begin, end = self._corner_ends[[first, first + len(sizes)]]
        corners = self._outlines.corners[begin:end]
        positions = self._position_of[corners].astype(np.int32)
        others = None if self._form == native.V else (corners + 1).astype(np.int32)
        text, ends = native.face_lines(sizes.astype(np.int32), positions, others, self._form)
        self._first, self._last = first, first + len(sizes)
        self._text, self._ends = text, [0, *ends.tolist()]


def _write_lines_and_points(mesh: Mesh, file: Any, position_of: np.ndarray) -> None:
    if len(mesh.lines):
        write_integers(file, "l %d %d", position_of[mesh.lines])
    is_cloud = not len(mesh.faces) and not len(mesh.lines)
    if is_cloud and np.array_equal(mesh.points, np.arange(len(mesh.positions))):
        return
    for start in range(0, len(mesh.points), _POINTS_A_LINE):
        numbers = position_of[mesh.points[start : start + _POINTS_A_LINE]].tolist()
        file.write(f"p {' '.join(map(str, numbers))}\n".encode())


WRITERS = (Writer("obj", "Wavefront OBJ with MTL", (".obj",), write_obj),)
