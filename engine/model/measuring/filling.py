"""Fills outlines in a plane with triangles, by a sweep.

In: directed segments of closed outlines. Out: what is inside, where the winding number is not zero.
Between two levels at which no outline has a vertex, the inside is a row of trapezoids.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

#: More crossings of levels with outlines take too much time and memory.
MOST_CROSSINGS = 3_000_000


def inner_stretches(
    segments: NDArray[np.float64], levels: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]] | None:
    """Return stretches of level lines inside outlines: level, segments at their left and right.

    Parameters
    ----------
    segments : (N, 2, 2) float64
        Ends x, y.
    levels : (L,) float64
        Ascending heights y.

    Returns
    -------
    tuple or None
        None where there are too many crossings.
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


@np.errstate(all="ignore")
def fill(segments: NDArray[np.float64], margin: float = 0.0) -> NDArray[np.float64] | None:
    """Return triangles that fill outlines, counter-clockwise.

    Parameters
    ----------
    segments : (N, 2, 2) float64
        Ends x, y of closed outlines.
    margin : float
        How far each trapezoid reaches beyond its sides, so that no gap shows between neighbours.

    Returns
    -------
    (T, 3, 2) float64, or None
        None where the outlines are too intricate.
    """
    heights = np.unique(segments[..., 1])
    if len(heights) < 2:
        return np.zeros((0, 3, 2))
    found = inner_stretches(segments, (heights[1:] + heights[:-1]) * 0.5)
    if found is None:
        return None
    level, left, right = found
    corners = [
        np.stack(
            [
                across(segments[sides], heights[level + up]) + aside * margin,
                heights[level + up] + (2 * up - 1) * margin,
            ],
            axis=1,
        )
        for up in (0, 1)
        for sides, aside in ((left, -1), (right, 1))
    ]
    made = [np.stack([corners[k] for k in three], axis=1) for three in ((0, 1, 3), (0, 3, 2))]
    return np.concatenate(made)
