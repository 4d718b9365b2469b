"""Meshes of cells, as libraries for simulations hold them: polygons, lines, points.

In: lists of corners, and named numbers of points and polygons. Out: a `Mesh` whose ``values`` hold
the numbers. Its edges are sharp where faces meet at an angle, as in files without normals.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.geometry.creases import CREASE_ANGLE
from ...model.geometry.mesh import Mesh
from ...model.geometry.values import Values
from ..reading.triangulation import triangulate


class Cells(NamedTuple):
    """What a mesh is made of; all indices are rows of the points.

    Attributes
    ----------
    sizes : (P,) int32
        The number of corners of each polygon, three or more.
    corners : (sum of sizes,) int32
        Those of the first polygon, and so on.
    lines : (L, 2) int32
        Segments.
    points : (N,) int32
        The points that show as such.
    """

    sizes: NDArray[np.int32]
    corners: NDArray[np.int32]
    lines: NDArray[np.int32]
    points: NDArray[np.int32]


def mesh_of_cells(
    positions: NDArray[Any],
    cells: Cells,
    of_points: Mapping[str, Any],
    of_polygons: Mapping[str, Any],
    **attributes: Any,
) -> Mesh:
    """Return the mesh of cells.

    Parameters
    ----------
    positions : (N, 3) float
    cells : Cells
    of_points, of_polygons : mapping of str to array
        Named numbers; what is no number, or of another count, is left out.
    **attributes
        ``uvs`` and others of `Mesh`.

    Raises
    ------
    InvalidArgumentError
        An index is out of range.
    """
    cut = triangulate(cells.sizes, np.asarray(positions, np.float32), indices=cells.corners)
    mesh = Mesh(
        positions,
        cells.corners[cut.corners],
        lines=cells.lines,
        points=cells.points,
        edge_visible=cut.edge_visible,
        **attributes,
    )
    mesh.crease_angle = CREASE_ANGLE
    for name, array in of_points.items():
        if _are_numbers(array, len(mesh.positions)):
            mesh.values[str(name)] = Values(np.asarray(array), on="vertices")
    for name, array in of_polygons.items():
        if _are_numbers(array, len(cells.sizes)) and str(name) not in mesh.values:
            mesh.values[str(name)] = Values(np.asarray(array)[cut.polygons], on="faces")
    return mesh


def _are_numbers(array: Any, count: int) -> bool:
    given = np.asarray(array)
    is_table = given.ndim == 1 or (given.ndim == 2 and given.shape[1] > 0)
    return is_table and len(given) == count > 0 and given.dtype.kind in "biuf"
