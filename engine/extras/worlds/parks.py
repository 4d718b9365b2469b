"""Paths and ponds of parks, as quads over the grass.

In: a `Patchwork`, frames at the corners of park tiles. Out: quads.
"""

from __future__ import annotations

import numpy as np

from ...base import linalg
from .frames import Frames, top
from .patchwork import Patchwork
from .plan import EDGE, PITCH
from .surfaces import NUMBER

_LEVEL = 0.19
_SIDES = 24
_POND, _RIM, _WALK = 9.0, 9.6, 13.5


def add_parks(patch: Patchwork, tile: Frames) -> None:
    """Add a central pond, a path around it, and paths to the four streets."""
    middle, gravel = PITCH / 2, NUMBER["gravel"]
    # Paths end inside the circular path, whose corners are closer to the middle than its radius.
    inner = middle - _WALK + 0.3, middle + _WALK - 0.3
    for o0, o1 in ((EDGE, inner[0]), (inner[1], PITCH - EDGE)):
        patch.add(top(tile, middle - 1.5, middle + 1.5, _LEVEL, o0, o1), gravel)
        patch.add(top(tile, o0, o1, _LEVEL, middle - 1.5, middle + 1.5), gravel)
    patch.add(_annulus(tile, _RIM, _WALK, _LEVEL, _LEVEL), gravel)
    patch.add(_annulus(tile, _RIM - 0.4, _RIM, 0.5, 0.5), NUMBER["trim"])
    patch.add(_annulus(tile, _RIM, _RIM, 0.5, _LEVEL), NUMBER["masonry"])
    patch.add(_annulus(tile, _RIM - 0.4, _RIM - 0.4, 0.3, 0.5), NUMBER["masonry"])
    patch.add(_discs(tile, _RIM - 0.4, 0.3), NUMBER["water"])


def _annulus(
    tile: Frames, inner: float, outer: float, y_inner: float, y_outer: float
) -> np.ndarray:
    """Return quads between two circles around the middle of each tile, facing up or outward."""
    x, z = linalg.unit_circle(_SIDES)
    x1, z1 = np.roll(x, -1), np.roll(z, -1)
    corners = np.empty((len(tile), _SIDES, 4, 3))
    radii = (inner, outer, outer, inner)
    heights = (y_inner, y_outer, y_outer, y_inner)
    for k, (a, b) in enumerate(((x, z), (x, z), (x1, z1), (x1, z1))):
        corners[:, :, k, 0] = (tile.x + PITCH / 2)[:, np.newaxis] + a * radii[k]
        corners[:, :, k, 1] = heights[k]
        corners[:, :, k, 2] = (tile.z + PITCH / 2)[:, np.newaxis] - b * radii[k]
    return corners.reshape(-1, 4, 3)


def _discs(tile: Frames, radius: float, y: float) -> np.ndarray:
    """Return polygons around the middle of each tile as quads, like fans of paired triangles."""
    x, z = linalg.unit_circle(_SIDES)
    corners = np.zeros((len(tile), _SIDES // 2, 4, 3))
    for k in range(3):
        corners[:, :, 1 + k, 0] = radius * np.roll(x, -k)[::2]
        corners[:, :, 1 + k, 2] = -radius * np.roll(z, -k)[::2]
    corners[..., 0] += (tile.x + PITCH / 2)[:, np.newaxis, np.newaxis]
    corners[..., 1] = y
    corners[..., 2] += (tile.z + PITCH / 2)[:, np.newaxis, np.newaxis]
    return corners.reshape(-1, 4, 3)
