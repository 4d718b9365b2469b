"""Draws a picture of the differences between two pictures.

In:  what was expected, as it is shown, and a `Difference`. Out: (H, W, 4) uint8, opaque: what was
     expected in pale grey, and over it each pixel that differs, yellow where it is little, red
     where it is much. A pale halo surrounds them, so that a single pixel is found, too.
"""

from __future__ import annotations

import numpy as np

from .comparison import Difference

_HALO = np.array((255, 178, 198), np.float32)
_LITTLE, _MUCH = np.array((255, 190, 0), np.float32), np.array((214, 0, 40), np.float32)
_LUMA = np.array((0.2126, 0.7152, 0.0722), np.float32)
_PALE = np.float32(0.22 / 255)  # remaining opacity of the expected picture, per alpha code
_SIDES_PER_HALO = 160


def difference_picture(shown: np.ndarray, difference: Difference) -> np.ndarray:
    """Return the picture of a difference.

    Parameters
    ----------
    shown : (H, W, 4) uint8 array
        What was expected; it may be smaller than the difference.
    difference : Difference
    """
    height, width = difference.mask.shape
    grey = np.full((height, width, 1), 255.0, np.float32)
    red, green, blue, alpha = (shown[..., channel].astype(np.float32) for channel in range(4))
    darkness = 255 - (red * _LUMA[0] + green * _LUMA[1] + blue * _LUMA[2])
    grey[: shown.shape[0], : shown.shape[1], 0] = 255 - alpha * darkness * _PALE
    picture = np.repeat(grey, 3, axis=2)
    picture[_widened(difference.mask, max(2, max(height, width) // _SIDES_PER_HALO))] = _HALO
    # The square root spreads small differences, which are most frequent.
    amount = np.sqrt(difference.amount[difference.mask])[:, np.newaxis]
    picture[difference.mask] = _LITTLE + amount * (_MUCH - _LITTLE)
    opaque = np.full((height, width, 1), 255, np.uint8)
    return np.concatenate([(picture + 0.5).astype(np.uint8), opaque], axis=2)


def _widened(mask: np.ndarray, distance: int) -> np.ndarray:
    """Return the pixels of squares around those of a mask."""
    for axis in (0, 1):
        padding = [(distance + 1, distance) if side == axis else (0, 0) for side in (0, 1)]
        sums = np.cumsum(np.pad(mask, padding), axis=axis, dtype=np.int32)
        length, step = mask.shape[axis], 2 * distance + 1
        mask = sums.take(range(step, step + length), axis) > sums.take(range(length), axis)
    return mask
