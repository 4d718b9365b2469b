"""Converts datasets of PyVista for drawing.

In: a PolyData; another dataset, of which the surface shows; or a MultiBlock of them. Out: a `Scene`
with a node for each. Arrays of points and cells become values of the meshes. The axes stay: PyVista
shows +Z upwards.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...model.geometry.mesh import Mesh
from ...model.scene.scene import Scene
from .cell_meshes import Cells, mesh_of_cells


def scene_from_pyvista(dataset: Any) -> Scene | None:
    """Return a scene converted from a dataset of PyVista; None for its other objects."""
    if not (hasattr(dataset, "points") or hasattr(dataset, "GetNumberOfBlocks")):
        return None
    scene = Scene()
    for name, part in _parts(dataset, "mesh"):
        scene.add(_mesh(part), name=name)
    return scene


def _parts(dataset: Any, name: str) -> Iterator[tuple[str, Any]]:
    """Yield the surfaces of a dataset, with the names of their blocks."""
    if not hasattr(dataset, "points"):  # a MultiBlock
        for number, key in enumerate(dataset.keys()):
            if dataset[number] is not None:
                yield from _parts(dataset[number], str(key))
        return
    if hasattr(dataset, "GetPolys"):
        yield name, dataset
        return
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of defaults that will change
        yield name, dataset.extract_surface(pass_pointid=False, pass_cellid=False)


def _mesh(surface: Any) -> Mesh:
    if surface.n_strips:
        surface = surface.triangulate()
    sizes, corners = _cells(surface.GetPolys())
    of_lines, ends = _cells(surface.GetLines())
    _, points = _cells(surface.GetVerts())
    # Polylines: each point but the last of one begins a segment.
    begins = np.ones(len(ends), bool)
    begins[np.cumsum(of_lines) - 1] = False
    starts = np.flatnonzero(begins)
    lines = np.stack([ends[starts], ends[starts + 1]], axis=-1)
    first = surface.n_verts + surface.n_lines  # the order of cells in VTK
    of_points = dict(surface.point_data)
    of_polygons = {name: array[first:] for name, array in dict(surface.cell_data).items()}
    # Its normals are not taken: PyVista itself does not draw by them, and some are out of date.
    of_points.pop(surface.point_data.active_normals_name or "", None)
    uvs = of_points.pop(surface.point_data.active_texture_coordinates_name or "", None)
    cells = Cells(sizes, corners, lines, points)
    return mesh_of_cells(np.asarray(surface.points), cells, of_points, of_polygons, uvs=uvs)


def _cells(cells: Any) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return the sizes and the corners of VTK's cells of one kind."""
    from pyvista import convert_array

    if not cells.GetNumberOfCells():
        return np.zeros(0, np.int32), np.zeros(0, np.int32)
    offsets = np.asarray(convert_array(cells.GetOffsetsArray()))
    corners = np.asarray(convert_array(cells.GetConnectivityArray()))
    return np.diff(offsets).astype(np.int32), corners.astype(np.int32)
