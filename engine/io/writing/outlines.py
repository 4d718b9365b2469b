"""Reassembles the polygons of a mesh from their triangles.

In: faces whose hidden edges define the polygons. Out: the corners of each polygon, starting where
readers must start to get the same triangles. A polygon that readers would cut differently (for
example with odd flags or mixed materials) is returned as its triangles.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...model.geometry.mesh import Mesh
from ..reading.triangulation import triangulate

# Polygons that are not fans are reassembled in Python, and tried from each corner, which takes
# quadratic time.
_MAX_CLIPPED = 500
_MAX_TRIES = 300_000


class Outlines(NamedTuple):
    """Polygons.

    Attributes
    ----------
    sizes : (P,) int64
        The number of corners of each polygon.
    corners : (C,) int32
        Vertex indices, polygon after polygon.
    first_faces : (P,) int64
        The first triangle of each polygon.
    lost_edges : int
        How many triangles with hidden edges are returned as triangles; these edges become visible.
    """

    sizes: np.ndarray
    corners: np.ndarray
    first_faces: np.ndarray
    lost_edges: int = 0


def polygon_outlines(mesh: Mesh, states: np.ndarray | None = None) -> Outlines:
    """Return the polygons of a mesh, in face order.

    Parameters
    ----------
    mesh : Mesh
    states : (F, K) int array, optional
        Values that all triangles of a polygon must share.
    """
    count = len(mesh.faces)
    if mesh.edge_visible is None or mesh.edge_visible.all():
        return Outlines(np.full(count, 3), mesh.faces.ravel(), np.arange(count))
    is_fan, fans = _fans(mesh.faces, mesh.edge_visible)
    polygons = np.where(is_fan, fans + count, mesh.polygons)
    first = np.flatnonzero(np.r_[True, polygons[1:] != polygons[:-1]])
    triangles = np.diff(np.r_[first, count])
    is_mixed = _mixed(states, first)
    found: dict[int, np.ndarray] = {}
    for number in np.unique(triangles[triangles > 1]).tolist():
        members = first[(triangles == number) & ~is_mixed]
        rows = mesh.faces[members[:, np.newaxis] + np.arange(number)]
        fan = is_fan[members]
        whole = np.concatenate([rows[fan, 0, :2], rows[fan, :, 2]], axis=1)
        found.update(zip(members[fan].tolist(), whole, strict=True))
        for face, polygon in zip(members[~fan].tolist(), rows[~fan], strict=True):
            outline = _outline(polygon.tolist()) if number <= _MAX_CLIPPED else None
            if outline is not None:
                found[face] = outline
    _turn(mesh, found)
    outlines = _joined(mesh.faces, first, triangles, found)
    alone = outlines.first_faces[outlines.sizes == 3]
    return outlines._replace(lost_edges=int((~mesh.edge_visible[alone]).any(axis=1).sum()))


def _mixed(states: np.ndarray | None, first: np.ndarray) -> np.ndarray:
    """Return which polygons have triangles of different states."""
    if states is None:
        return np.zeros(len(first), bool)
    differs = np.r_[False, (states[1:] != states[:-1]).any(axis=1)]
    differs[first] = False
    return np.add.reduceat(differs, first) > 0


def _fans(faces: np.ndarray, visible: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return which faces are part of a complete fan, and the number of each face's run."""
    goes_on = (faces[1:, 0] == faces[:-1, 0]) & (faces[1:, 1] == faces[:-1, 2])
    goes_on &= ~visible[1:, 0] & ~visible[:-1, 2]
    starts = np.r_[True, ~goes_on]
    ends = np.r_[~goes_on, True]
    run = np.cumsum(starts) - 1
    wrong = ~visible[:, 1] | (starts & ~visible[:, 0]) | (ends & ~visible[:, 2])
    is_whole = np.bincount(run, wrong) == 0
    return is_whole[run], run


def _outline(triangles: list[list[int]]) -> np.ndarray | None:
    """Undo ear clipping: each triangle except the last adds its middle corner."""
    outline = list(triangles[-1])
    for a, b, c in reversed(triangles[:-1]):
        for place, corner in enumerate(outline):
            if corner == a and outline[(place + 1) % len(outline)] == c:
                outline.insert(place + 1, b)
                break
        else:
            return None
    return np.array(outline, np.int32)


def _turn(mesh: Mesh, found: dict[int, np.ndarray]) -> None:
    """Rotate each outline so that cutting it gives the mesh's triangles, or drop it."""
    positions = mesh.positions.astype(np.float64)
    faces = list(found)
    differing = [
        face
        for face, same in zip(faces, _cuts_alike(mesh, positions, faces, found), strict=True)
        if not same
    ]
    tries = _MAX_TRIES
    for face in differing:
        outline = found.pop(face)
        tries -= len(outline) ** 2
        if tries < 0:
            continue
        turned = {k: np.roll(outline, -k) for k in range(len(outline))}
        alike = _cuts_alike(mesh, positions, [face] * len(turned), turned)
        match = np.flatnonzero(alike)
        if len(match):
            found[face] = turned[int(match[0])]


def _cuts_alike(
    mesh: Mesh, positions: np.ndarray, faces: list[int], outlines: dict[int, np.ndarray]
) -> np.ndarray:
    """Return whether each outline is cut into the triangles that start at a face."""
    if not outlines:
        return np.zeros(0, bool)
    sizes = np.array([len(outline) for outline in outlines.values()])
    corners = np.concatenate(list(outlines.values()))
    cut = triangulate(sizes, positions[corners])
    before = np.cumsum(sizes - 2) - (sizes - 2)
    rows = np.array(faces)[cut.polygons] + np.arange(len(cut.polygons)) - before[cut.polygons]
    same = (corners[cut.corners] == mesh.faces[rows]).all(axis=1)
    if cut.edge_visible is not None and mesh.edge_visible is not None:
        same &= (cut.edge_visible == mesh.edge_visible[rows]).all(axis=1)
    return np.bincount(cut.polygons, ~same, len(sizes)) == 0


def _joined(
    faces: np.ndarray, first: np.ndarray, triangles: np.ndarray, found: dict[int, np.ndarray]
) -> Outlines:
    """Return outlines, and the triangles of polygons without one, in face order."""
    sizes, corners, first_faces = [], [], []
    for face, number in zip(first.tolist(), triangles.tolist(), strict=True):
        outline = found.get(face)
        if outline is not None:
            sizes.append(len(outline))
            corners.append(outline)
            first_faces.append(face)
        else:
            sizes += [3] * number
            corners.append(faces[face : face + number].ravel())
            first_faces += range(face, face + number)
    return Outlines(np.array(sizes), np.concatenate(corners), np.array(first_faces))
