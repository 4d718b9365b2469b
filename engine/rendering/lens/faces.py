"""The faces of a lens: the pinhole pictures around the camera that cover what it sees.

In: the directions in which pixels look. Out: for each pixel the face that shows it and its place
there, at focal length 1. One face ahead covers narrow lenses, the six faces of a cube along the
camera's axes the others (docs/exactness, R201). Turning to a face only swaps and negates
coordinates, so that it is exact.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

#: Right, up and back of each face in camera space: ahead, right, left, up, down, behind.
CUBE: NDArray[np.float64] = np.array(
    [
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
        [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
        [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
        [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
        [[-1, 0, 0], [0, 1, 0], [0, 0, -1]],
    ],
    np.float64,
)
#: Tangent of the greatest angle from the axis, across or up, at which one face is enough.
_NARROW = 1.75


class Places(NamedTuple):
    """Where pixels look.

    Attributes
    ----------
    face : (H, W) int8
        Row of `CUBE`; -1 for pixels that see nothing.
    x, y : (H, W) float64
        To the right and down from the face's axis, at focal length 1.
    """

    face: NDArray[np.int8]
    x: Floats
    y: Floats


def _along(axis: Floats, rays: Floats) -> Floats:
    """Return the components of rays along a signed axis of the camera."""
    number = int(np.flatnonzero(axis)[0])
    return rays[..., number] if axis[number] > 0.0 else -rays[..., number]


def places_on(face: int, rays: Floats) -> tuple[Floats, Floats]:
    """Return where rays meet a face, x to the right and y down; NaN for rays away from it."""
    right, up, back = CUBE[face]
    ahead = -_along(back, rays)
    with np.errstate(all="ignore"):
        ahead = np.where(ahead > 0.0, ahead, np.nan)
        return _along(right, rays) / ahead, -_along(up, rays) / ahead


def is_narrow(rays: Floats) -> bool:
    """Return whether one face ahead shows all rays, (H, W, 3); NaN where there is none."""
    seen = np.isfinite(rays[..., 0])
    x, y = places_on(0, rays)
    with np.errstate(invalid="ignore"):
        fits = (np.abs(x) <= _NARROW) & (np.abs(y) <= _NARROW)
    return bool(seen.any() and fits[seen].all())


def places_of(rays: Floats, narrow: bool) -> Places:
    """Return where rays look, (H, W, 3): each on the face whose axis is the nearest."""
    seen = np.isfinite(rays[..., 0])
    if narrow:
        face = np.where(seen, 0, -1).astype(np.int8)
    else:
        ahead = np.stack([-_along(axes[2], rays) for axes in CUBE])
        face = np.where(seen, np.argmax(np.where(seen, ahead, 0.0), axis=0), -1).astype(np.int8)
    x, y = np.zeros(face.shape), np.zeros(face.shape)
    for number in range(len(CUBE)):
        shown = face == number
        if shown.any():
            x[shown], y[shown] = places_on(number, rays[shown])
    return Places(face, x, y)
