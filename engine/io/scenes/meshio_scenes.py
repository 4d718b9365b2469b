"""Converts meshes of meshio for drawing.

In: a ``meshio.Mesh``. Out: a `Scene` with one mesh: its polygons, lines and vertices, and the outer
faces of its volumes. Data of points and of cells become values of the mesh. The axes stay. Cells of
other types are left out, with a warning.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base.numbers import as_array, floats
from ...errors import InvalidArgumentError, warn
from ...model.scene.scene import Scene
from .cell_meshes import Cells, mesh_of_cells

# Corners of cells come first in meshio's lists, in VTK's order; the others lie on edges and within.
_POLYGONS = {"triangle": 3, "quad": 4}
_FACES: dict[str, tuple[tuple[int, ...], ...]] = {
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "wedge": ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "hexahedron": (
        *((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4)),
        *((1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    ),
}
_SIZES = {
    **_POLYGONS,
    **{kind: 1 + max(max(face) for face in faces) for kind, faces in _FACES.items()},
    "line": 2,
    "vertex": 1,
}


class _Faces(NamedTuple):
    """Faces with equally many corners, and the number of each one's cell."""

    rows: NDArray[Any]
    cells: NDArray[np.intp]


def scene_from_meshio(mesh: Any) -> Scene | None:
    """Return a scene converted from a mesh of meshio; None for its other objects."""
    if not (hasattr(mesh, "points") and hasattr(mesh, "cells")):
        return None
    points = floats(mesh.points, "points")
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise InvalidArgumentError(f"points must have shape (N, 2) or (N, 3), got {points.shape}")
    if points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    scene = Scene()
    cells, owners = _cells(mesh, len(points))
    of_polygons = {name: rows[owners] for name, rows in _data_of_cells(mesh).items()}
    scene.add(mesh_of_cells(points, cells, mesh.point_data, of_polygons), name="mesh")
    return scene


def _data_of_cells(mesh: Any) -> dict[str, NDArray[Any]]:
    """Return the named numbers of all cells, block after block, as far as they fit the cells."""
    counts, found = [len(block.data) for block in mesh.cells], {}
    for name, blocks in mesh.cell_data.items():
        rows = [as_array(block, f"cell data {name!r}") for block in blocks]
        if [len(block) for block in rows] != counts or len({block.shape[1:] for block in rows}) > 1:
            warn(f"cell data {name!r} do not fit the cells, and are left out")
        elif rows:
            found[name] = np.concatenate(rows)
    return found


def _cells(mesh: Any, count: int) -> tuple[Cells, NDArray[np.intp]]:
    """Return what is drawn of cells, and for each polygon the number of its cell."""
    polygons: list[_Faces] = []
    outer: list[_Faces] = []
    lines, points = [np.zeros((0, 2), np.int32)], [np.zeros(0, np.int32)]
    first = 0
    for block in mesh.cells:
        kind, data = block.type.rstrip("0123456789"), block.data
        numbers = np.arange(first, first + len(data))
        first += len(data)
        if not len(data):
            continue
        if kind == "polygon":
            corners = [_corners([one], kind, 1, count) for one in data]
            polygons += [_Faces(*one) for one in zip(corners, numbers[:, np.newaxis], strict=True)]
        elif kind not in _SIZES:
            warn(f"cells of the type {block.type} are not drawn")
        else:
            rows = _corners(data, kind, _SIZES[kind], count)
            if kind in _POLYGONS:
                polygons.append(_Faces(rows, numbers))
            elif kind in _FACES:
                outer += [_Faces(rows[:, list(face)], numbers) for face in _FACES[kind]]
            elif kind == "line":
                lines.append(rows)
            else:
                points.append(rows.reshape(-1))
    polygons += _once(outer, 3) + _once(outer, 4)
    none = [np.zeros(0, np.intp)]
    cells = Cells(
        np.concatenate(
            none + [np.full(len(each.rows), each.rows.shape[1]) for each in polygons]
        ).astype(np.int32),
        np.concatenate(none + [each.rows.reshape(-1) for each in polygons]).astype(np.int32),
        np.concatenate(lines).astype(np.int32),
        np.concatenate(points).astype(np.int32),
    )
    return cells, np.concatenate(none + [each.cells for each in polygons])


def _corners(data: Any, kind: str, size: int, count: int) -> NDArray[Any]:
    """Return the corners of cells, (C, size), or of one polygon, checked to be among the points."""
    rows = as_array(data, f"{kind} cells")
    if rows.ndim != 2 or rows.shape[1] < size or rows.dtype.kind not in "iu":
        raise InvalidArgumentError(
            f"{kind} cells must be integers of shape (C, {size}), not {rows.dtype} of {rows.shape}"
        )
    rows = rows if kind == "polygon" else rows[:, :size]
    low, high = int(rows.min()), int(rows.max())
    if low < 0 or high >= count:
        wrong = low if low < 0 else high
        raise InvalidArgumentError(
            f"{kind} cells hold the index {wrong}, but there are {count} points"
        )
    return rows


def _once(faces: list[_Faces], corners: int) -> list[_Faces]:
    """Return the faces of this many corners that only one cell has: the outer ones."""
    alike = [face for face in faces if face.rows.shape[1] == corners]
    if not alike:
        return []
    every = np.concatenate([face.rows for face in alike])
    cells = np.concatenate([face.cells for face in alike])
    _, first, counts = np.unique(
        np.sort(every, axis=1), axis=0, return_index=True, return_counts=True
    )
    outer = np.sort(first[counts == 1])
    return [_Faces(every[outer], cells[outer])]
