"""Draws the lines of a drawing: silhouettes and edges of surfaces.

In: what a panel shows: ids, depths and normals of its pixels. Out: the panel's colours, darker
along lines of one pixel. Where there would be nothing but lines, they fade.
"""

from __future__ import annotations

import numpy as np

#: Cosine of the smallest angle between normals that counts as an edge.
_CREASE = 0.88
#: Depths that deviate from a plane by more than this many pixels belong to two surfaces.
_JUMP = 3.5
#: Darkness of lines, of 256.
_DARKNESS = 165
#: Half side of the square in which lines are counted; the fractions at which they start to fade,
#: and vanish.
_NEAR, _MANY, _TOO_MANY = 5, 0.42, 0.75


def draw_outlines(
    color: np.ndarray,
    ids: np.ndarray,
    depth: np.ndarray,
    normals: np.ndarray | None,
    scale: float | None,
) -> None:
    """Darken the lines of a drawing, in place.

    Parameters
    ----------
    color : (H, W, 4) uint8
    ids : (H, W) int
        What is the same thing; -1 where there is nothing.
    depth : (H, W) float32
        World units.
    normals : (H, W, 3) float32 or None
        Without them creases have no lines.
    scale : float or None
        Pixels per world unit; None with perspective, where depths do not tell planes.
    """
    lines = np.zeros(ids.shape, bool)
    _mark_ends(lines, ids, depth)
    if scale is not None:
        _mark_jumps(lines, ids, depth, np.float32(_JUMP / scale))
    if normals is not None:
        _mark_creases(lines, ids, normals)
    strength = _strength(lines)
    rows, columns = np.nonzero(strength)
    kept = (256 - strength[rows, columns].astype(np.uint32))[:, np.newaxis]
    color[rows, columns, :3] = (color[rows, columns, :3] * kept) >> 8


def _mark_ends(lines: np.ndarray, ids: np.ndarray, depth: np.ndarray) -> None:
    """Mark the nearer of two neighbours that belong to different things."""
    for here, there in _neighbours():
        differ = ids[here] != ids[there]
        is_here = (ids[here] >= 0) & ((ids[there] < 0) | (depth[here] < depth[there]))
        lines[here] |= differ & is_here
        lines[there] |= differ & ~is_here & (ids[there] >= 0)


def _mark_jumps(lines: np.ndarray, ids: np.ndarray, depth: np.ndarray, jump: np.float32) -> None:
    """Mark surfaces in front of a more distant surface."""
    for before, here, after in _rows_of_three():
        # How much farther away both sides are than a plane through here would have them.
        bend = (depth[before] - depth[here]) + (depth[after] - depth[here])
        same = (ids[before] == ids[here]) & (ids[after] == ids[here]) & (ids[here] >= 0)
        lines[here] |= same & (bend > jump)


def _mark_creases(lines: np.ndarray, ids: np.ndarray, normals: np.ndarray) -> None:
    x, y, z = np.ascontiguousarray(np.moveaxis(normals, -1, 0))
    for here, there in _neighbours():
        cosine = x[here] * x[there] + y[here] * y[there] + z[here] * z[there]
        lines[here] |= (cosine < np.float32(_CREASE)) & (ids[here] == ids[there]) & (ids[here] >= 0)


def _neighbours():
    everything = slice(None)
    yield (everything, slice(None, -1)), (everything, slice(1, None))
    yield (slice(None, -1), everything), (slice(1, None), everything)


def _rows_of_three():
    everything = slice(None)
    three = slice(None, -2), slice(1, -1), slice(2, None)
    yield tuple((everything, part) for part in three)
    yield tuple((part, everything) for part in three)


def _strength(lines: np.ndarray) -> np.ndarray:
    """Return the darkness of each pixel's line, of 256: less among many, in integers."""
    side = 2 * _NEAR + 1
    sums = np.zeros((lines.shape[0] + side, lines.shape[1] + side), np.int32)
    inside = slice(_NEAR + 1, -_NEAR)
    sums[inside, inside] = lines
    for axis in (0, 1):
        np.cumsum(sums, axis=axis, dtype=np.int32, out=sums)
    count = sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]
    many, too_many = (int(share * side * side) for share in (_MANY, _TOO_MANY))
    left = np.clip(too_many - count, 0, too_many - many)
    return np.where(lines, left * _DARKNESS // (too_many - many), 0).astype(np.uint16)
