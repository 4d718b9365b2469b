"""Cuts meshes: the part of a mesh on one side of a plane.

In: a mesh, and the plane in its space. Out: a mesh with the faces of that side whole, and those
that the plane crosses cut. An edge that is cut gives one vertex, with interpolated attributes, that
its faces share. The cut stays open.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.geometry.vertex_attributes import attributes_of
from ...model.materials.linear_colors import floats_are_linear


class _Cut(NamedTuple):
    """The faces of a side: the vertices of their corners, and what belongs to each face.

    Attributes
    ----------
    corners : (F, 3) int64
        The mesh's vertices, then those on cut edges.
    faces : (F,) int64
        Which of the mesh's faces each one is, or is a piece of.
    visible : (F, 3) bool
        Which of its edges lie on visible edges of the mesh.
    """

    corners: NDArray[np.int64]
    faces: NDArray[np.int64]
    visible: NDArray[np.bool_]


class _CutEdges(NamedTuple):
    """The edges that are cut.

    Attributes
    ----------
    ends : (E, 2) int64
        The mesh's vertices.
    share : (E,) float64
        Where the cut is on the way from the first to the second.
    """

    ends: NDArray[np.int64]
    share: NDArray[np.float64]

    def some(self, numbers: NDArray[np.int64]) -> _CutEdges:
        """Return some of them."""
        return _CutEdges(self.ends[numbers], self.share[numbers])


@np.errstate(all="ignore")
def clipped(mesh: Mesh, plane: NDArray[np.float64]) -> Mesh | None:
    """Return the part of a mesh at the side of a plane where its equation is not negative.

    Parameters
    ----------
    mesh : Mesh
    plane : (4,) float64
        The equation of the plane in the mesh's space: a point's height is the product with x, y, z
        and 1.

    Returns
    -------
    Mesh or None
        The mesh itself if all of it is there, None if nothing is. Vertices that are not finite are
        not there.
    """
    mesh = mesh.with_creases()  # the remaining faces keep their normals
    heights = linalg.dot(mesh.positions.astype(np.float64), plane[:3]) + float(plane[3])
    kept = heights >= 0.0
    if kept.all():
        return mesh
    ends, numbers = _cut_edges(mesh.faces, kept, heights)
    cut = _faces(mesh, kept, ends, numbers)
    lines, points = mesh.lines[kept[mesh.lines].all(axis=1)], mesh.points[kept[mesh.points]]
    if not (len(cut.corners) or len(lines) or len(points)):
        return None
    low, high = (heights[ends[:, k]] for k in (0, 1))
    edges = _CutEdges(ends, low / (low - high))
    return _part(mesh, cut, edges, lines.astype(np.int64), points.astype(np.int64))


def with_only(mesh: Mesh, faces: NDArray[np.bool_]) -> Mesh:
    """Return a mesh with some faces of another, (F,) bool, and no other vertices than theirs."""
    mesh = mesh.with_creases()
    rows = np.flatnonzero(faces)
    kept = _Cut(mesh.faces[rows].astype(np.int64), rows, _visible_edges(mesh, rows))
    nothing = np.zeros(0, np.int64)
    uncut = _CutEdges(nothing.reshape(0, 2), np.zeros(0))
    return _part(mesh, kept, uncut, nothing.reshape(0, 2), nothing)


def _visible_edges(mesh: Mesh, faces: NDArray[np.intp] | slice) -> NDArray[np.bool_]:
    """Return which edges of some faces are visible, (F, 3)."""
    if mesh.edge_visible is None:
        return np.ones(mesh.faces[faces].shape, bool)
    return mesh.edge_visible[faces]


def _cut_edges(
    faces: NDArray[np.int32], kept: NDArray[np.bool_], heights: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the ends of cut edges (E, 2), lower first; and of each side its edge, (F, 3), or -1.

    A side begins at its face's corner of the same number.
    """
    begins = faces.astype(np.int64)
    ends = np.roll(begins, -1, axis=1)
    crossed = (kept[begins] != kept[ends]) & np.isfinite(heights[begins] - heights[ends])
    low = np.where(kept[begins], ends, begins)[crossed]
    high = np.where(kept[begins], begins, ends)[crossed]
    keys, inverse = np.unique(low * len(heights) + high, return_inverse=True)
    numbers = np.full(faces.shape, -1, np.int64)
    numbers[crossed] = inverse.reshape(-1)
    return np.stack([keys // len(heights), keys % len(heights)], axis=1), numbers


def _faces(
    mesh: Mesh, kept: NDArray[np.bool_], ends: NDArray[np.int64], numbers: NDArray[np.int64]
) -> _Cut:
    """Return the faces of a side."""
    inside = kept[mesh.faces]
    count, crossings = inside.sum(axis=1), (numbers >= 0).sum(axis=1)
    visible = _visible_edges(mesh, slice(None))
    whole = np.flatnonzero(count == 3)
    one = np.flatnonzero((count == 1) & (crossings == 2))
    two = np.flatnonzero((count == 2) & (crossings == 2))
    # From the corner that is alone on its side: the corners, their sides' edges and visibility.
    a, ab, ca = _turned(mesh.faces, numbers, inside[one], one)
    a_visible = _turned_rows(visible, inside[one], one)
    hidden = np.zeros(len(one), bool)
    tips = np.stack([a[:, 0], ab, ca], axis=1)
    tip_visible = np.stack([a_visible[:, 0], hidden, a_visible[:, 2]], axis=1)
    b, side_b, side_c = _turned(mesh.faces, numbers, ~inside[two], two)
    b_visible = _turned_rows(visible, ~inside[two], two)
    hidden = np.zeros(len(two), bool)
    near = np.stack([side_b, b[:, 1], b[:, 2]], axis=1)
    near_visible = np.stack([b_visible[:, 0], b_visible[:, 1], hidden], axis=1)
    far = np.stack([side_b, b[:, 2], side_c], axis=1)
    far_visible = np.stack([hidden, b_visible[:, 2], hidden], axis=1)
    return _Cut(
        np.concatenate([mesh.faces[whole].astype(np.int64), tips, near, far]),
        np.concatenate([whole, one, two, two]),
        np.concatenate([visible[whole], tip_visible, near_visible, far_visible]),
    )


def _turned(
    faces: NDArray[np.int32],
    numbers: NDArray[np.int64],
    alone: NDArray[np.bool_],
    rows: NDArray[np.intp],
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return faces from the corner that is alone on, and the vertices on the sides next to it."""
    corners = _turned_rows(faces.astype(np.int64), alone, rows)
    sides = _turned_rows(numbers, alone, rows)
    return corners, _on_edge(sides[:, 0]), _on_edge(sides[:, 2])


def _turned_rows(table: Any, alone: NDArray[np.bool_], rows: NDArray[np.intp]) -> NDArray[Any]:
    first = np.argmax(alone, axis=1)
    turned: NDArray[Any] = np.take_along_axis(
        table[rows], (first[:, np.newaxis] + np.arange(3)) % 3, axis=1
    )
    return turned


def _on_edge(numbers: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the vertices on cut edges: negative, as the count of the others is open."""
    return -1 - numbers


def _part(
    mesh: Mesh,
    cut: _Cut,
    edges: _CutEdges,
    lines: NDArray[np.int64],
    points: NDArray[np.int64],
) -> Mesh:
    """Return the mesh of a side, with the vertices that it uses."""
    count = len(mesh.positions)
    corners = np.where(cut.corners < 0, count - 1 - cut.corners, cut.corners)
    used, places = np.unique(
        np.concatenate([corners.reshape(-1), lines.reshape(-1), points]), return_inverse=True
    )
    places = places.reshape(-1)
    faces, rest = places[: corners.size].reshape(-1, 3), places[corners.size :]
    own, made = used[used < count], used[used >= count] - count
    crossed = edges.some(made)

    def rows(array: NDArray[Any]) -> NDArray[Any]:
        return np.concatenate([array[own], _between(array, crossed)])

    normals = rows(mesh.normals) if len(mesh.faces) else None
    attributes: dict[str, Any] = {name: rows(array) for name, array in attributes_of(mesh).items()}
    with floats_are_linear():
        return Mesh(
            rows(mesh.positions),
            faces,
            normals=normals,
            materials=mesh.materials,
            material_ids=mesh.material_ids[cut.faces],
            lines=rest[: lines.size].reshape(-1, 2),
            points=rest[lines.size :],
            edge_visible=cut.visible,
            position_ids=_position_ids(mesh, own, crossed.ends),
            name=mesh.name,
            **attributes,
        )


def _position_ids(
    mesh: Mesh, own: NDArray[np.int64], ends: NDArray[np.int64]
) -> NDArray[np.int64] | None:
    """Return which vertices of a side are one point, its own and those on cut edges."""
    ids = mesh.position_ids
    if ids is None or not len(ids):
        return None
    low, high = (ids[ends[:, k]].astype(np.int64) for k in (0, 1))
    first = int(ids.max()) + 1
    cuts = first + np.unique(low * first + high, return_inverse=True)[1].reshape(-1)
    numbers: NDArray[np.int64] = np.unique(
        np.concatenate([ids[own].astype(np.int64), cuts]), return_inverse=True
    )[1]
    return numbers.reshape(-1)


def _between(array: NDArray[Any], edges: _CutEdges) -> NDArray[Any]:
    """Return the rows of an array where edges are cut."""
    low, high = (array[edges.ends[:, k]].astype(np.float64) for k in (0, 1))
    between = low + (high - low) * edges.share.reshape(-1, *[1] * (array.ndim - 1))
    return (np.rint(between) if array.dtype == np.uint8 else between).astype(array.dtype)
