"""The cut faces of a section: triangles that hide what is behind them, and hatching.

In: outlines in a plane across an axis, directed. Out: triangles and lines inside: where the winding
number is not zero. The plane is swept: between two levels at which no outline has a vertex, the
inside is a row of trapezoids.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..sheet.cutting import Outline, Plane, gaps_of

#: More crossings of levels with outlines take too much time and memory.
MOST_CROSSINGS = 3_000_000


class Cap(NamedTuple):
    """A cut part.

    Attributes
    ----------
    node : int
        Its id.
    outline : (N, 2, 3) float64
    triangles : (T, 3, 3) float64
    hatching : (H, 2, 3) float64
    """

    node: int
    outline: NDArray[np.float64]
    triangles: NDArray[np.float64]
    hatching: NDArray[np.float64]


@np.errstate(all="ignore")
def cap_of(outline: Outline, plane: Plane, spacing: float) -> Cap | None:
    """Return the cut of a node; without triangles and hatching if its outline cannot be closed.

    Parameters
    ----------
    outline : Outline
    plane : Plane
    spacing : float
        World units between lines of the hatching.

    Returns
    -------
    Cap or None
        None where the outline is too intricate to be filled.
    """
    gaps = gaps_of(outline.segments)
    nothing = np.zeros((0, 3, 3)), np.zeros((0, 2, 3))
    if gaps is None:
        return Cap(outline.node, outline.segments, *nothing)
    closed = np.concatenate([outline.segments, gaps])
    flat = closed[..., [(plane.axis + 1) % 3, (plane.axis + 2) % 3]]
    triangles = _triangles(flat)
    sign = -1.0 if outline.node % 2 else 1.0
    hatching = _hatching(flat, sign, spacing)
    if triangles is None or hatching is None:
        return None
    back = (_in_space(found, plane) for found in (triangles, hatching))
    return Cap(outline.node, outline.segments, *back)


def _in_space(flat: NDArray[np.float64], plane: Plane) -> NDArray[np.float64]:
    places = np.empty((*flat.shape[:-1], 3))
    places[..., plane.axis] = plane.coordinate
    places[..., (plane.axis + 1) % 3], places[..., (plane.axis + 2) % 3] = (
        flat[..., 0],
        flat[..., 1],
    )
    return places


def _inner(
    segments: NDArray[np.float64], levels: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]] | None:
    """Return stretches of level lines inside outlines: level, segments at their left and right.

    Parameters
    ----------
    segments : (N, 2, 2) float64
        Ends x, y.
    levels : (L,) float64
        Ascending heights y.
    """
    low, high = segments[..., 1].min(axis=1), segments[..., 1].max(axis=1)
    first, last = (np.searchsorted(levels, ends) for ends in (low, high))
    counts = last - first
    if counts.sum() > MOST_CROSSINGS:
        return None
    number = np.repeat(np.arange(len(segments)), counts)
    level = np.arange(len(number)) - np.repeat(np.cumsum(counts) - counts - first, counts)
    order = np.lexsort([number, across(segments[number], levels[level]), level])
    number, level = number[order], level[order]
    turns = np.cumsum(np.where(segments[number, 1, 1] > segments[number, 0, 1], 1, -1))
    inside = np.flatnonzero((turns[:-1] != 0) & (level[:-1] == level[1:]))
    return level[inside], number[inside], number[inside + 1]


def across(segments: NDArray[np.float64], levels: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return x where segments (N, 2, 2) are at heights (N,), within their own."""
    a, b = segments[:, 0], segments[:, 1]
    share = (levels - a[:, 1]) / (b[:, 1] - a[:, 1])
    return a[:, 0] + (b[:, 0] - a[:, 0]) * np.clip(share, 0.0, 1.0)


def _triangles(segments: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return triangles (T, 3, 2) that fill outlines."""
    heights = np.unique(segments[..., 1])
    if len(heights) < 2:
        return np.zeros((0, 3, 2))
    middles = (heights[1:] + heights[:-1]) * 0.5
    found = _inner(segments, middles)
    if found is None:
        return None
    level, left, right = found
    corners = [
        np.stack([across(segments[side], heights[level + up]), heights[level + up]], axis=1)
        for up in (0, 1)
        for side in (left, right)
    ]
    made = [np.stack([corners[k] for k in three], axis=1) for three in ((0, 1, 3), (0, 3, 2))]
    return np.concatenate(made)


def _hatching(
    segments: NDArray[np.float64], sign: float, spacing: float
) -> NDArray[np.float64] | None:
    """Return lines (H, 2, 2) at 45 degrees inside outlines."""
    half = np.sqrt(0.5)
    turned = np.stack(
        [
            (segments[..., 0] + segments[..., 1] * sign) * half,
            (segments[..., 1] - segments[..., 0] * sign) * half,
        ],
        axis=-1,
    )
    heights = turned[..., 1]
    first, last = np.ceil(heights.min() / spacing), np.floor(heights.max() / spacing)
    if not last - first < MOST_CROSSINGS:
        return None
    levels = np.arange(first, last + 1) * spacing
    found = _inner(turned, levels)
    if found is None:
        return None
    level, left, right = found
    y = levels[level]
    ends = np.stack([across(turned[left], y), across(turned[right], y)], axis=1)
    rows = y[:, np.newaxis]
    return np.stack([(ends - rows * sign) * half, (ends * sign + rows) * half], axis=-1)
