"""Converts meshes of meshio for drawing.

In: a ``meshio.Mesh``. Out: a `Scene` with one mesh: its polygons, lines and vertices, and the outer
faces of its volumes. Data of points become values of the mesh. The axes stay. Cells of other types
are left out, with a warning.
"""

from __future__ import annotations

from typing import Any

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
    cells = _cells(mesh, len(points))
    scene.add(mesh_of_cells(points, cells, mesh.point_data, {}), name="mesh")
    return scene


def _cells(mesh: Any, count: int) -> Cells:
    polygons: list[NDArray[Any]] = []
    outer: list[NDArray[Any]] = []
    lines, points = [np.zeros((0, 2), np.int32)], [np.zeros(0, np.int32)]
    for block in mesh.cells:
        kind, data = block.type.rstrip("0123456789"), block.data
        if not len(data):
            continue
        if kind == "polygon":
            polygons += [_corners([one], kind, 1, count) for one in data]
        elif kind not in _SIZES:
            warn(f"cells of the type {block.type} are not drawn")
        else:
            rows = _corners(data, kind, _SIZES[kind], count)
            if kind in _POLYGONS:
                polygons.append(rows)
            elif kind in _FACES:
                outer += [rows[:, list(face)] for face in _FACES[kind]]
            elif kind == "line":
                lines.append(rows)
            else:
                points.append(rows.reshape(-1))
    polygons += _once(outer, 3) + _once(outer, 4)
    sizes = [np.full(len(rows), rows.shape[1], np.int32) for rows in polygons]
    corners = [rows.reshape(-1) for rows in polygons]
    none = [np.zeros(0, np.int32)]
    return Cells(
        np.concatenate(none + sizes),
        np.concatenate(none + corners).astype(np.int32),
        np.concatenate(lines).astype(np.int32),
        np.concatenate(points).astype(np.int32),
    )


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


def _once(faces: list[NDArray[Any]], corners: int) -> list[NDArray[Any]]:
    """Return the faces of this many corners that only one cell has: the outer ones."""
    rows = [face for face in faces if face.shape[1] == corners]
    if not rows:
        return []
    every = np.concatenate(rows)
    _, first, counts = np.unique(
        np.sort(every, axis=1), axis=0, return_index=True, return_counts=True
    )
    return [every[np.sort(first[counts == 1])]]
