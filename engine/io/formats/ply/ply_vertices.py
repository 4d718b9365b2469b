"""The vertices of a PLY file: positions, normals, colours and texture coordinates.

In: the table of the element ``vertex``. Out: arrays as a `Mesh` takes them. Property names follow
common programs; others are numbers for ``Mesh.values``.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import NamedTuple

import numpy as np

from ...reading.vertex_values import finite_uvs
from ...reading.warning_list import WarningList
from .ply_colors import (
    color_names,
    is_splats,
    names_of_colors,
    read_colors,
    splat_colors,
)
from .ply_tables import PlyTable

_HARMONICS = "f_rest_"
_PLACES = ("x", "y", "z", "nx", "ny", "nz", "position_id")
#: Lists with more items are not vectors.
WIDEST_VECTOR = 16
#: The names of texture coordinates, the usual ones first.
UV_NAMES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))


class PlyVertices(NamedTuple):
    """The vertices of a file.

    Attributes
    ----------
    positions : (V, 3) float32 or float64
    normals : (V, 3) float32 or None
    colors : (V, 4) uint8 or float32, or None
    uvs : (V, 2) float32 or None
    position_ids : (V,) number or None
        Our own writer's numbers for vertices that are one point of the surface.
    """

    positions: np.ndarray
    normals: np.ndarray | None
    colors: np.ndarray | None
    uvs: np.ndarray | None
    position_ids: np.ndarray | None


def read_vertices(table: PlyTable, warnings: WarningList, is_own: bool = False) -> PlyVertices:
    """Read the vertices; the table has ``x``, ``y`` and ``z``.

    Other parameters as in `read_colors`.
    """
    positions = table.columns("x", "y", "z")
    normals = None
    if table.has("nx", "ny", "nz"):
        with np.errstate(over="ignore"):
            normals = table.columns("nx", "ny", "nz").astype(np.float32, copy=False)
    uvs = None
    for names in UV_NAMES:
        if table.has(*names):
            uvs = finite_uvs(table.columns(*names))
            break
    position_ids = table.column("position_id") if table.has("position_id") else None
    colors = (
        splat_colors(table, warnings) if is_splats(table) else read_colors(table, warnings, is_own)
    )
    return PlyVertices(positions, normals, colors, uvs, position_ids)


def value_names(table: PlyTable) -> list[str]:
    """Return the names of vertex numbers that `read_vertices` does not read."""
    uvs = next((names for names in UV_NAMES if table.has(*names)), ())
    found = names_but(table, {*_PLACES, *uvs})
    # Of splats, the coefficients of view-dependent colours take most of the file.
    return [name for name in found if not (is_splats(table) and name.startswith(_HARMONICS))]


def meant_names(names: set[str]) -> set[str]:
    """Return those among the names of an element's properties that are taken for other things."""
    uvs = next((pair for pair in UV_NAMES if names.issuperset(pair)), ())
    return names & {*_PLACES, *uvs, *names_of_colors(names)}


def names_but(table: PlyTable, taken: Collection[str]) -> list[str]:
    """Return the names of an element's properties, without its colours and those in ``taken``."""
    taken = {*taken, *color_names(table)}
    return [name for name in table.element.properties if name not in taken]


def numbers_of(table: PlyTable, names: Iterable[str]) -> dict[str, np.ndarray]:
    """Read some properties: (N,), or (N, K) for lists of K items; other lists are skipped."""
    found = {}
    for name in names:
        if table.has(name):
            found[name] = table.column(name).astype(np.dtype(table.type(name)), copy=False)
            continue
        items = table.list(name)
        width = int(items.sizes[0]) if len(table) else 0
        if 1 <= width <= WIDEST_VECTOR and (items.sizes == width).all():
            values = items.values.astype(np.dtype(table.type(name)), copy=False)
            found[name] = values.reshape(-1, width)
    return found
