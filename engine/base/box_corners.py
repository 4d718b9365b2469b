"""The eight corners of boxes.

In: boxes as their low and high ends. Out: their corners, in the order of three bits: bit 0 of a
corner's number is its end along x, bit 1 along y, bit 2 along z.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Of each corner, which end it takes along each axis: (8, 3) of 0 and 1.
CORNER_ENDS = np.arange(8)[:, np.newaxis] >> np.arange(3) & 1


def box_corners(boxes: NDArray[Any]) -> NDArray[Any]:
    """Return the corners, (..., 8, 3), of boxes, (..., 2, 3): low and high."""
    return np.asarray(boxes)[..., CORNER_ENDS, np.arange(3)]
