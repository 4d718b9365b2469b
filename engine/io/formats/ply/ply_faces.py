"""The triangles and line segments of a PLY file.

In: the tables of its elements. Out: arrays of checked vertex indices. Faces may have any number of
corners, and texture coordinates for each corner; triangle strips and edges are read as well.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...._native import loaders as native
from ...reading.triangulation import WorkBudget, triangulate
from ...reading.vertex_values import finite_uvs
from ...reading.warning_list import WarningList
from .ply_colors import read_colors
from .ply_tables import PlyList, PlyTable
from .ply_vertices import names_but, numbers_of

_INDEX_LISTS = ("vertex_indices", "vertex_index")
#: The properties of faces that have a meaning, besides colours.
FACE_NAMES = (*_INDEX_LISTS, "texcoord", "texnumber")
_RESTART = -1


class PlyFaces(NamedTuple):
    """The triangles of a PLY file.

    Attributes
    ----------
    corners : (T, 3) int32
        Vertex indices.
    uvs : (T, 3, 2) float32 or None
        Texture coordinates of each corner.
    colors : (T, 4) uint8 or float32, or None
    textures : (T,) int64 or None
        The number of each triangle's image.
    edge_visible : (T, 3) bool or None
    polygons : (T,) int or None
        The file's face that each is part of; None if all faces are triangles.
    """

    corners: np.ndarray
    uvs: np.ndarray | None = None
    colors: np.ndarray | None = None
    textures: np.ndarray | None = None
    edge_visible: np.ndarray | None = None
    polygons: np.ndarray | None = None


def read_faces(
    table: PlyTable | None, positions: np.ndarray, budget: WorkBudget, warnings: WarningList
) -> PlyFaces:
    """Read the element ``face``, and triangulate polygons.

    Raises
    ------
    FileFormatError
        A vertex index is out of range.
    """
    name = _index_list(table)
    if table is None or name is None:
        return PlyFaces(np.zeros((0, 3), np.int32))
    outlines = table.list(name)
    indices = _checked(table, outlines, len(positions))
    are_triangles = outlines.length == 3
    short = 0 if are_triangles else int((outlines.sizes < 3).sum())
    if short:
        warnings.add(f"{short} faces of fewer than three corners are left out")
    colors = read_colors(table, warnings)
    textures = None
    if table.has("texnumber"):
        textures = np.nan_to_num(table.column("texnumber").astype(np.float64))
    uvs = _corner_uvs(table, outlines.sizes, warnings)
    if are_triangles or outlines.sizes.min() == 3 == outlines.sizes.max():
        corners = indices.reshape(-1, 3)
        return PlyFaces(corners, None if uvs is None else uvs.reshape(-1, 3, 2), colors, textures)
    cut = triangulate(outlines.sizes, positions, budget, indices=indices)
    if not cut.is_complete:
        warnings.add("too many concave polygons: some are cut as if they were convex")
    return PlyFaces(
        indices[cut.corners],
        None if uvs is None else uvs[cut.corners],
        None if colors is None else colors[cut.polygons],
        None if textures is None else textures[cut.polygons],
        cut.edge_visible,
        cut.polygons,
    )


def face_value_names(table: PlyTable | None) -> list[str]:
    """Return the names of face numbers that `read_faces` does not read."""
    return [] if table is None else names_but(table, FACE_NAMES)


def read_face_values(table: PlyTable | None, faces: PlyFaces) -> dict[str, np.ndarray]:
    """Read the face numbers that `read_faces` does not read, by name: (T, ...)."""
    if table is None or not len(table):
        return {}
    found = numbers_of(table, face_value_names(table))
    if faces.polygons is None:
        return found
    return {name: values[faces.polygons] for name, values in found.items()}


def read_strips(table: PlyTable | None, count: int) -> np.ndarray:
    """Read the element ``tristrips``: triangles (T, 3) int32, without degenerate ones.

    An index of -1 starts a new strip, whose first triangle keeps its winding.
    """
    name = _index_list(table)
    if table is None or name is None:
        return np.zeros((0, 3), np.int32)
    strips = table.list(name)
    indices = _checked(table, strips, count, (_RESTART,))
    begins = np.zeros(len(indices), bool)
    begins[(np.cumsum(strips.sizes) - strips.sizes)[strips.sizes > 0]] = True
    begins[1:] |= indices[:-1] == _RESTART
    number = np.arange(len(indices), dtype=np.int32)
    within = number - np.maximum.accumulate(np.where(begins, number, np.int32(0)))
    first = np.flatnonzero((within >= 2) & (indices != _RESTART)) - 2
    a, b, c = indices[first], indices[first + 1], indices[first + 2]
    is_odd = within[first] % 2 == 1
    del begins, number, within, first
    triangles = np.stack([a, np.where(is_odd, c, b), np.where(is_odd, b, c)], axis=1)
    return triangles[(a != b) & (b != c) & (c != a)]


def read_edges(table: PlyTable | None, count: int) -> np.ndarray:
    """Read the element ``edge``: line segments (L, 2) int32."""
    if table is None or not table.has("vertex1", "vertex2"):
        return np.zeros((0, 2), np.int32)
    ends = table.columns("vertex1", "vertex2")
    both = PlyList(np.full(len(ends), 2), ends.ravel())
    return _checked(table, both, count).reshape(-1, 2)


def _index_list(table: PlyTable | None) -> str | None:
    if table is None or not len(table):
        return None
    for name in _INDEX_LISTS:
        if table.has(name, lists=True):
            return name
    return None


def _checked(
    table: PlyTable, found: PlyList, count: int, others: tuple[int, ...] = ()
) -> np.ndarray:
    """Return vertex indices as int32, checked; those in ``others`` are allowed."""
    values = found.values
    kind, size = values.dtype.kind, values.dtype.itemsize
    # Viewed as unsigned, negative numbers exceed every count.
    if kind in "iu" and len(values) and values.view(f"u{size}").max() < count:
        return values.astype(np.int32, copy=False)
    if values.dtype == np.float64 and not others:
        indices, first_wrong = native.indices_of(values.reshape(1, -1), count)
        if first_wrong is None:
            return native.frozen(indices).reshape(-1)
    wrong = ~((values >= 0) & (values < count))
    for other in others:
        wrong &= values != other
    if values.dtype.kind == "f":
        wrong |= values != np.floor(values)
    if wrong.any():
        item = int(wrong.argmax())
        row = int(np.searchsorted(np.cumsum(found.sizes), item, side="right"))
        value = values[item].item()
        value = int(value) if float(value).is_integer() else value
        table.fail(row, f"vertex index {value} is out of range, there are {count} vertices")
    return values.astype(np.int32)


def _corner_uvs(table: PlyTable, sizes: np.ndarray, warnings: WarningList) -> np.ndarray | None:
    """Return the face property ``texcoord``: two numbers per corner, (C, 2); None without it.

    A face with a wrong count of numbers has none, and gets zeros.
    """
    if not table.has("texcoord", lists=True):
        return None
    found = table.list("texcoord")
    given = found.sizes == 2 * sizes
    if given.all():
        return finite_uvs(found.values.reshape(-1, 2))
    if not (given & (sizes > 0)).any():
        return None
    warnings.add(f"{int((~given).sum())} faces without texture coordinates for all corners")
    uvs = np.zeros((int(sizes.sum()), 2), np.float32)
    values = found.values[np.repeat(given, found.sizes)].reshape(-1, 2)
    uvs[np.repeat(given, sizes)] = finite_uvs(values)
    return uvs
