"""The edges of a mesh that a line drawing may show, whatever the view.

In: the arrays of a mesh. Out: its triangles without what is broken, and each of their edges once,
with the triangles at both sides and whether it is a crease or a border. Vertices at exactly the
same place are one point, as for creases.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._native import drawing as native
from ..._native import loaders
from ...base import linalg
from .line_kinds import BORDER, CREASE

#: What is within this share of the largest coordinate from a plane lies on it, and triangles that
#: are no higher have no direction of their own.
_THICKNESS = 2.0**-21
#: Cosine of the angle between normals that count as one.
_ONE_NORMAL = 0.9999
#: So often a flat triangle's neighbour is looked for behind another flat one.
_FLAT_STEPS = 8


class MeshEdges(NamedTuple):
    """The triangles and edges of a mesh.

    Attributes
    ----------
    positions : (P, 3) float64
        Each point once, in object space.
    faces : (F, 3) int32
        Finite triangles of three points, each once.
    sources : (F,) int64
        Their numbers in ``mesh.faces``.
    enclosing : (F,) int8
        1 for a triangle of a body that encloses a volume with its fronts outside, -1 with its
        backs, else 0.
    ends : (E, 2) int32
        The points of each edge.
    beside : (E, 2) int32
        The triangles at its sides, -1 for none.
    turned : (E,) uint8
        Whether these have opposite winding.
    kinds : (E,) int8
        `BORDER` for an edge of one triangle, `CREASE` for a sharp one or one of more than two,
        -1 for one that is a line only as an outline.
    lines : (L, 2) int32
        The mesh's own lines.
    """

    positions: NDArray[np.float64]
    faces: NDArray[np.int32]
    sources: NDArray[np.int64]
    enclosing: NDArray[np.int8]
    ends: NDArray[np.int32]
    beside: NDArray[np.int32]
    turned: NDArray[np.uint8]
    kinds: NDArray[np.int8]
    lines: NDArray[np.int32]


def _open_what_crosses_itself(
    enclosing: NDArray[np.int8], positions: NDArray[np.float64], faces: NDArray[np.int32]
) -> None:
    """Let bodies that run through themselves enclose nothing: parts of them may be inside out."""
    pairs = native.cross_surfaces(positions, faces, None, thickness_of(positions), 1)["faces"]
    if not len(pairs):
        return
    bodies = native.find_bodies(faces, len(positions))
    first, second = bodies[pairs].T
    enclosing[np.isin(bodies, first[first == second])] = 0


@np.errstate(all="ignore")
def mesh_edges(arrays: dict[str, Any], crease_angle: float) -> MeshEdges:
    """Return the triangles and edges of a mesh.

    Parameters
    ----------
    arrays : dict
        Those of a mesh, as `arrays_of` returns them.
    crease_angle : float
        Radians: triangles that meet at more than this angle have a crease between them, unless the
        mesh has normals of its own that do not break there.
    """
    points, first = loaders.number_rows(arrays["positions"].view(np.uint32), True)
    positions = arrays["positions"][first].astype(np.float64)
    is_finite = np.isfinite(positions).all(axis=1)
    positions[~is_finite] = 0.0  # nothing that is drawn uses them
    faces, sources = _sound_faces(points[arrays["faces"]], is_finite)
    normals, is_flat = face_normals(positions, faces)
    if is_flat.any():
        needed = _needed_faces(positions, faces, is_flat)
        faces, sources = np.ascontiguousarray(faces[needed]), sources[needed]
        normals, is_flat = normals[needed], is_flat[needed]
    sides = native.find_sides(faces, len(positions))
    ends, beside, turned = native.unfold_sides(faces, sides)
    enclosing = native.find_enclosing(positions, faces, sides)
    if enclosing.any():
        _open_what_crosses_itself(enclosing, positions, faces)
    uses = np.ascontiguousarray(sides["uses"])
    is_needless = None
    if is_flat.any():
        is_needless = _see_through_flat_faces(sides, beside, faces, positions, is_flat)
    sharp = native.find_cosines(normals, beside, turned) < float(linalg.cos(crease_angle))
    sharp &= uses == 2
    if is_needless is not None:
        sharp &= ~is_flat[beside].any(axis=1)
    candidates = np.flatnonzero(sharp)
    if arrays["edge_visible"] is not None:
        sharp[candidates] &= _shown(sides[candidates], arrays["edge_visible"][sources])
    if arrays["_given_normals"] is not None:
        corners = arrays["faces"][sources].reshape(-1)
        sharp[candidates] &= _broken(sides[candidates], faces, arrays["_given_normals"][corners])
    kinds = np.where(sharp | (uses > 2), np.int8(CREASE), np.int8(-1))
    kinds[uses == 1] = BORDER
    if is_needless is not None:
        kept = ~is_needless
        ends, beside, turned, kinds = ends[kept], beside[kept], turned[kept], kinds[kept]
    lines = arrays["lines"]
    lines = np.zeros((0, 2), np.int32) if lines is None else points[lines]
    return MeshEdges(
        positions,
        faces,
        sources,
        enclosing,
        ends,
        beside,
        turned,
        kinds,
        lines[is_finite[lines].all(axis=1)],
    )


def thickness_of(positions: NDArray[np.float64]) -> float:
    """Return the distance within which points (P, 3) count as one: coordinates have 24 bits."""
    return _THICKNESS * float(np.abs(positions).max(initial=0.0))


def face_normals(
    positions: NDArray[np.float64], faces: NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return the unit normals of triangles, (F, 3), and which are too flat to have one."""
    normals = native.find_normals(positions, faces, thickness_of(positions))
    return normals, ~normals.any(axis=1)


def _sound_faces(
    faces: NDArray[np.int32], is_finite: NDArray[np.bool_]
) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Return the finite triangles of three points, each once, and their numbers."""
    a, b, c = np.ascontiguousarray(faces.T)
    kept = np.flatnonzero(
        (a != b) & (b != c) & (c != a) & is_finite[a] & is_finite[b] & is_finite[c]
    )
    if len(kept) < len(faces):
        faces, a, b, c = faces[kept], a[kept], b[kept], c[kept]
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    rows = np.stack([low, a ^ b ^ c ^ low ^ high, high], axis=1)
    if loaders.rows_repeat(rows.view(np.uint32), False):
        once = loaders.number_rows(rows.view(np.uint32), False)[1]
        faces, kept = faces[once], kept[once]
    return np.ascontiguousarray(faces), kept


def _needed_faces(
    positions: NDArray[np.float64], faces: NDArray[np.int32], is_flat: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Return which triangles are not flat, or close a gap between others."""
    needed = ~is_flat
    sides = native.find_sides(np.ascontiguousarray(faces[needed]), len(positions))
    gaps = sides[sides["uses"] == 1]
    flat = np.flatnonzero(~needed)
    ends = np.sort(np.stack([faces[flat], np.roll(faces[flat], -1, axis=1)], axis=-1), axis=-1)
    keys = ends[..., 0].astype(np.int64) * len(positions) + ends[..., 1]
    open_keys = gaps["low"].astype(np.int64) * len(positions) + gaps["high"]
    needed[flat] = np.isin(keys, open_keys).any(axis=1)
    return needed


def _following(sides: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return the corners at which sides 3 f + k end."""
    return sides + np.where(sides % 3 == 2, -2, 1)


def _shown(sides: NDArray[np.void], edge_visible: NDArray[np.bool_]) -> NDArray[np.bool_]:
    flags = edge_visible.reshape(-1)
    return flags[sides["first"]] | flags[sides["second"]]


def _broken(
    sides: NDArray[np.void], faces: NDArray[np.int32], normals: NDArray[np.float32]
) -> NDArray[np.bool_]:
    """Return at which edges normals of corners (3 F, 3) differ between two triangles."""
    corners = faces.reshape(-1)
    first, second = sides["first"], sides["second"]
    same_way = corners[first] == corners[second]
    starts = np.where(same_way, second, _following(second))
    ends = np.where(same_way, _following(second), second)
    pairs = (first, starts), (_following(first), ends)
    broken = np.zeros(len(sides), bool)
    for one, other in pairs:
        a, b = (normals[corner].astype(np.float64) for corner in (one, other))
        broken |= linalg.dot(a, b) < _ONE_NORMAL * linalg.length(a) * linalg.length(b)
    return broken


def _see_through_flat_faces(
    sides: NDArray[np.void],
    beside: NDArray[np.int32],
    faces: NDArray[np.int32],
    positions: NDArray[np.float64],
    is_flat: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Put the neighbour behind it in place of each flat triangle, in ``beside``.

    A flat triangle is but its longest side. Its two others border on what is behind that one.

    Returns
    -------
    (E,) bool
        The longest sides, which separate nothing.
    """
    needless = np.zeros(len(sides), bool)
    flat = np.flatnonzero(is_flat)
    if not len(flat):
        return needless
    edge_of = np.full(3 * len(faces), -1)
    edge_of[sides["first"]] = np.arange(len(sides))
    second = sides["uses"] > 1
    edge_of[sides["second"][second]] = np.flatnonzero(second)
    corners = positions[faces[flat]]
    lengths = linalg.length(np.roll(corners, -1, axis=1) - corners)
    longest = edge_of[3 * flat + lengths.argmax(axis=1)]
    through = np.arange(len(faces))
    known = longest >= 0
    own, edges = flat[known], longest[known]
    pair = beside[edges]
    through[own] = np.where(pair[:, 0] == own, pair[:, 1], pair[:, 0])
    needless[edges] = sides["uses"][edges] == 2
    own = beside[:, 0].copy()
    for _ in range(_FLAT_STEPS):
        kept = beside >= 0
        beside[kept] = through[beside[kept]]
    # Where nothing is behind a flat triangle, the other one comes first, or it stays itself.
    open_ones = np.flatnonzero(beside[:, 0] < 0)
    beside[open_ones] = beside[open_ones, ::-1]
    beside[:, 0] = np.where(beside[:, 0] < 0, own, beside[:, 0])
    return needless
