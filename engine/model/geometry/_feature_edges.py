"""The feature edges of a mesh: where its faces meet sharply, and its borders.

In: the arrays of a mesh. Out: pairs of vertices. Vertices at exactly the same place are one point,
as for creases. Where a mesh has normals of its own that do not break at an edge, it is no feature:
the mesh shows it smooth.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..._native import loaders as native
from ...base import linalg
from .creases import CREASE_ANGLE

#: Faces that meet at less than the first angle count as one surface, at more than the second as
#: two. Of faceted meshes nearly all do one or the other.
_FLAT, _SHARP = math.radians(20.0), math.radians(40.0)
#: So many edges may meet in between, for each that is sharp.
_BETWEEN = 0.6
#: In large meshes, only faces in some runs of so many are looked at for that. Short runs would miss
#: the sharp edges, which lie between patches of faces that are stored far from each other.
_RUNS, _RUN = 4, 10_000
#: Meshes with more faces, or more sides at such edges, are too fine for lines.
MOST_FACES, MOST_SIDES = 300_000, 60_000


class _Welded(NamedTuple):
    """Triangles whose vertices at one place are one point.

    Attributes
    ----------
    positions : (P, 3) float32
    faces : (F, 3) int32
    visible : (F, 3) uint8 or None
    vertices : (P,) int32
        The first vertex at each place.
    """

    positions: np.ndarray
    faces: np.ndarray
    visible: np.ndarray | None
    vertices: np.ndarray


def feature_edges(
    positions: np.ndarray,
    faces: np.ndarray,
    edge_visible: np.ndarray | None,
    normals: np.ndarray | None,
) -> np.ndarray:
    """Return the feature edges of a mesh: (E, 2) int32, vertex indices; none if they are very many.

    Parameters
    ----------
    positions, faces, edge_visible, normals
        Those of a `Mesh`; normals only if they were given.
    """
    return _edges(positions, faces, edge_visible, normals, only_faceted=False)


def faceted_edges(
    positions: np.ndarray,
    faces: np.ndarray,
    edge_visible: np.ndarray | None,
    normals: np.ndarray | None,
) -> np.ndarray:
    """Return `feature_edges` of a mesh whose faces mostly meet either flat or sharply.

    There are none of other meshes, such as scans and coarse organic models.
    """
    return _edges(positions, faces, edge_visible, normals, only_faceted=True)


def _edges(
    positions: np.ndarray,
    faces: np.ndarray,
    edge_visible: np.ndarray | None,
    normals: np.ndarray | None,
    only_faceted: bool,
) -> np.ndarray:
    nothing = np.zeros((0, 2), np.int32)
    if not 0 < len(faces) <= MOST_FACES:
        return nothing
    visible = None if edge_visible is None else edge_visible.view(np.uint8)
    if only_faceted and not _is_faceted(*_sample(positions, faces, visible)):
        return nothing
    welded = _weld(positions, faces, visible)
    found = _sharp_edges(welded, CREASE_ANGLE)
    if found is None:
        return nothing
    if normals is not None:
        broken = _broken_edges(welded, positions, faces, normals)
        if broken is None:
            return nothing
        found = np.intersect1d(found, broken, assume_unique=True)
    count = len(welded.positions)
    ends = np.stack([found // count, found % count], axis=1)
    return welded.vertices[ends]


def _weld(positions: np.ndarray, faces: np.ndarray, visible: np.ndarray | None) -> _Welded:
    bits = positions.view(np.uint32)
    if not native.rows_repeat(bits, True):
        return _Welded(positions, faces, visible, np.arange(len(positions), dtype=np.int32))
    places, first = native.number_rows(bits, True)
    return _Welded(positions[first], places[faces], visible, first)


def _sample(
    positions: np.ndarray, faces: np.ndarray, visible: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Return a part of the faces of a large mesh: some runs of faces that follow each other."""
    if len(faces) <= _RUNS * _RUN:
        return positions, faces, visible
    starts = np.arange(_RUNS) * ((len(faces) - _RUN) // (_RUNS - 1))
    rows = (starts[:, np.newaxis] + np.arange(_RUN)).reshape(-1)
    corners = faces[rows].reshape(-1)
    return (
        positions[corners],
        np.arange(len(corners), dtype=np.int32).reshape(-1, 3),
        None if visible is None else visible[rows],
    )


def _is_faceted(positions: np.ndarray, faces: np.ndarray, visible: np.ndarray | None) -> bool:
    """Return whether nearly all faces meet either flat or sharply."""
    welded = _weld(positions, faces, visible)
    blunt = _sharp_edges(welded, _FLAT)
    sharp = None if blunt is None else _sharp_edges(welded, _SHARP)
    borders = None if sharp is None else _sharp_edges(welded, math.pi)
    if blunt is None or sharp is None or borders is None:
        return False
    return len(blunt) - len(sharp) <= _BETWEEN * (len(sharp) - len(borders))


def _sharp_edges(welded: _Welded, angle: float) -> np.ndarray | None:
    """Return the edges whose faces meet at more than an angle, and borders, as sorted keys (E,).

    None if they are too many. An edge that is sharp all alone, with no other at either end, is
    left out.
    """
    positions, faces, visible, _ = welded
    count, places = len(positions), np.arange(len(positions), dtype=np.int32)
    if angle < math.pi:
        cosine = float(linalg.cos(angle))
        faces, rows, _, _ = native.find_creases(positions, faces, None, visible, count, cosine)
        places = np.concatenate([places, rows])
    return _open_edges(positions[places], faces, places, count)


def _broken_edges(
    welded: _Welded, positions: np.ndarray, faces: np.ndarray, normals: np.ndarray
) -> np.ndarray | None:
    """Return the edges across which normals break, and borders, as `_sharp_edges` does."""
    rows = np.concatenate([positions, normals], axis=1).view(np.uint32)
    corners, first = native.number_rows(rows, True)
    places = np.empty(len(positions), np.int32)
    places[faces] = welded.faces
    count = len(welded.positions)
    return _open_edges(positions[first], corners[faces], places[first], count)


def _open_edges(
    positions: np.ndarray, faces: np.ndarray, places: np.ndarray, count: int
) -> np.ndarray | None:
    """Return the edges with sides that one triangle alone has, as `_sharp_edges` does.

    Parameters
    ----------
    positions, faces
        In which each vertex is a point of its own.
    places : (W,) int32
        The place of each of these points, below ``count``.
    count : int
    """
    sides = native.open_sides(positions, faces, None, len(positions), MOST_SIDES)
    if sides is None:
        return None
    ends = np.sort(places[sides].astype(np.int64), axis=1)
    numbers = np.sort(ends[:, 0] * count + ends[:, 1])
    return numbers[np.diff(numbers, prepend=-1) != 0]  # np.unique would import numpy.ma
