"""Clips triangles by planes.

In: places in the world, planes as rows of four: what is kept has a x + b y + c z + d >= 0. Out: the
rest. Every edge that crosses a plane is cut at one point, found from its lower to its higher vertex
whatever triangle asks, so that neighbours stay joined to the bit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...base import linalg

#: More than the share of its terms by which a sum of a few of them is wrong.
_ROUNDING = 2.0**-48


def _heights(places: NDArray[np.float64], plane: NDArray[np.float64]) -> NDArray[np.float64]:
    heights: NDArray[np.float64] = linalg.dot(places, plane[:3]) + plane[3]
    return heights


def are_before(bounds: NDArray[np.float64], planes: NDArray[np.float64]) -> bool:
    """Return whether a box (2, 3) is surely wholly on the side of planes (K, 4) that is kept."""
    low, high = bounds.tolist()
    for *normal, offset in planes.tolist():
        least = size = 0.0
        for share, a, b in zip(normal, low, high, strict=True):
            ends = share * a, share * b
            least += min(ends)
            size += max(map(abs, ends))
        if not least + offset > _ROUNDING * (size + abs(offset)):
            return False
    return True


@np.errstate(all="ignore")
def clip_triangles(
    places: NDArray[np.float64], faces: NDArray[np.int32], planes: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int64]]:
    """Return what is left of triangles: places, triangles, and where these came from.

    Parameters
    ----------
    places : (V, 3) float64
    faces : (F, 3) int32
    planes : (K, 4) float64
    """
    sources = np.arange(len(faces))
    for plane in planes:
        inside = _heights(places, plane) >= 0.0
        corners = inside[faces]
        count = corners.sum(axis=1)
        if (count == 3).all():
            continue
        cut = np.flatnonzero((count == 1) | (count == 2))
        whole = np.flatnonzero(count == 3)
        places, made, of = _cut(places, faces[cut], corners[cut], plane)
        faces = np.concatenate([faces[whole], made])
        sources = np.concatenate([sources[whole], sources[cut[of]]])
    return places, faces, sources


def _cut(
    places: NDArray[np.float64],
    faces: NDArray[np.int32],
    inside: NDArray[np.bool_],
    plane: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int64]]:
    """Return the places with new ones behind, what is left of triangles, and their sources."""
    is_single = inside.sum(axis=1) == 1
    # The corner that is alone on its side comes first.
    alone = np.argmax(inside == is_single[:, np.newaxis], axis=1)
    turned = np.take_along_axis(faces, (alone[:, np.newaxis] + np.arange(3)) % 3, axis=1)
    crossing = np.concatenate([turned[:, (0, 1)], turned[:, (0, 2)]])
    pairs, numbers = np.unique(np.sort(crossing, axis=1), axis=0, return_inverse=True)
    low, high = places[pairs[:, 0]], places[pairs[:, 1]]
    at_low, at_high = _heights(low, plane), _heights(high, plane)
    share = (at_low / (at_low - at_high))[:, np.newaxis]
    made = (numbers.reshape(2, -1) + len(places)).astype(np.int32)
    first, second = made
    single, double = np.flatnonzero(is_single), np.flatnonzero(~is_single)
    left = np.concatenate(
        [
            np.stack([turned[single, 0], first[single], second[single]], axis=1),
            np.stack([first[double], turned[double, 1], turned[double, 2]], axis=1),
            np.stack([first[double], turned[double, 2], second[double]], axis=1),
        ]
    )
    places = np.concatenate([places, low + (high - low) * share])
    return places, left, np.concatenate([single, double, double])
