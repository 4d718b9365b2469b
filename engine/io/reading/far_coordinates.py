"""Moves coordinates far from the origin, as in maps, near it (R144).

In: positions in float64, as in a file. Out: positions that 32-bit floats hold precisely, and their
origin in the file's coordinates.
"""

from __future__ import annotations

import math

import numpy as np

# At this distance from the origin, in model sizes, a float has lost seven of its 24 bits.
_FAR = 128.0


def origin_near(low: np.ndarray, high: np.ndarray, far: float = _FAR) -> np.ndarray | None:
    """Return an origin for a box, (3,) float64; None if the box is near the usual one.

    Near means less than ``far`` times its size away. The origin is a multiple of a power of two,
    which keeps rounding small.
    """
    size, reach = float((high - low).max()), float(np.maximum(np.abs(low), np.abs(high)).max())
    if not 0.0 < far * size < reach < math.inf:
        return None
    step = 2.0 ** math.ceil(math.log2(size))
    return np.rint((low + high) * (0.5 / step)) * step


@np.errstate(all="ignore")
def moved_near(positions: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """Return positions relative to a nearby origin.

    Parameters
    ----------
    positions : (V, 3) float

    Returns
    -------
    positions : (V, 3) float
        The same if the origin does not move.
    pose : (4, 4) float64 or None
        Moves them back to the file's coordinates.
    """
    finite = positions[np.isfinite(positions).all(axis=1)]
    if not len(finite):
        return positions, None
    low, high = finite.min(axis=0).astype(np.float64), finite.max(axis=0).astype(np.float64)
    origin = origin_near(low, high)
    if origin is None:
        return positions, None
    pose = np.eye(4)
    pose[:3, 3] = origin
    return positions.astype(np.float64, copy=False) - origin, pose
