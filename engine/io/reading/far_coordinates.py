"""Coordinates far from the origin, as maps have them: the origin is moved near the model (R144).

In: positions in float64, as a file has them. Out: positions that 32-bit floats hold finely, and
where their origin is in the file's coordinates.
"""

from __future__ import annotations

import math

import numpy as np

# A model farther from the origin than so many times its size has lost seven bits of a float's 24.
_FAR = 128.0


def origin_near(low: np.ndarray, high: np.ndarray, far: float = _FAR) -> np.ndarray | None:
    """Return an origin for what lies in a box, (3,) float64; None where the usual one is near.

    Near is what is less than ``far`` times its size away. The origin is a multiple of a power of
    two, so that little is rounded.
    """
    size, reach = float((high - low).max()), float(np.maximum(np.abs(low), np.abs(high)).max())
    if not 0.0 < far * size < reach < math.inf:
        return None
    step = 2.0 ** math.ceil(math.log2(size))
    return np.rint((low + high) * (0.5 / step)) * step


@np.errstate(all="ignore")
def moved_near(positions: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
    """Return positions seen from an origin near them.

    Parameters
    ----------
    positions : (V, 3) float

    Returns
    -------
    positions : (V, 3) float
        The same where the origin stays.
    pose : (4, 4) float64 or None
        Takes them back to where they are in the file.
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
