"""The cut faces of a section: triangles that hide what is behind them, and hatching.

In: outlines in a plane across an axis, directed. Out: triangles and lines inside: where the winding
number is not zero.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.measuring.cutting import Outline, Plane, gaps_of
from ...model.measuring.filling import MOST_CROSSINGS, across, fill, inner_stretches


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
    triangles = fill(flat)
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
    found = inner_stretches(turned, levels)
    if found is None:
        return None
    level, left, right = found
    y = levels[level]
    ends = np.stack([across(turned[left], y), across(turned[right], y)], axis=1)
    rows = y[:, np.newaxis]
    return np.stack([(ends - rows * sign) * half, (ends * sign + rows) * half], axis=-1)
