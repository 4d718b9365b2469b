"""Converts meshes of meshio for drawing.

In: a ``meshio.Mesh``. Out: a `Scene` with one mesh: its polygons, lines and vertices, and the outer
faces of its volumes. Data of points become values of the mesh. The axes stay.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

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


def scene_from_meshio(mesh: Any) -> Scene | None:
    """Return a scene converted from a mesh of meshio; None for its other objects."""
    if not (hasattr(mesh, "points") and hasattr(mesh, "cells")):
        return None
    points = np.asarray(mesh.points, np.float64)
    if points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    scene = Scene()
    scene.add(mesh_of_cells(points, _cells(mesh), mesh.point_data, {}), name="mesh")
    return scene


def _cells(mesh: Any) -> Cells:
    polygons: list[NDArray[Any]] = []
    outer: list[NDArray[Any]] = []
    lines, points = [np.zeros((0, 2), np.int32)], [np.zeros(0, np.int32)]
    for block in mesh.cells:
        kind, data = block.type.rstrip("0123456789"), block.data
        if kind in _POLYGONS:
            polygons.append(np.asarray(data)[:, : _POLYGONS[kind]])
        elif kind == "polygon":
            polygons += [np.asarray(one)[None] for one in data]
        elif kind in _FACES:
            outer += [np.asarray(data)[:, list(face)] for face in _FACES[kind]]
        elif kind == "line":
            lines.append(np.asarray(data)[:, :2])
        elif kind == "vertex":
            points.append(np.asarray(data).reshape(-1))
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
