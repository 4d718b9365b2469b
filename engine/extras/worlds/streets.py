"""The ground of a tile: carriageways with markings, pavements, the block's land, a meadow.

In: a `Patchwork`, frames at the corners of tiles where x and z are least. Out: quads. A tile has
half of each of the four streets round it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .frames import Frames, box, each, frames, top
from .patchwork import Patchwork
from .plan import EDGE, KERB, PITCH
from .surfaces import NUMBER

_CURB = 0.15
_PAINT = 0.02
_DASHES = 9
_STRIPES = 4


def corners(i: np.ndarray, j: np.ndarray) -> Frames:
    """Return frames at the tiles' corners, to the right along +X and outward along +Z."""
    return frames(i * PITCH, j * PITCH)


def add_ground(patch: Patchwork, tile: Frames, land: np.ndarray) -> None:
    """Add streets, pavements and land of tiles; ``land`` are material numbers."""
    patch.add(top(tile, 0.0, PITCH, -0.3, 0.0, PITCH), NUMBER["soil"])
    far, out = PITCH - KERB, PITCH - EDGE
    _ring(patch, tile, (0.0, KERB, far, PITCH), 0.0, NUMBER["asphalt"])
    _ring(patch, tile, (KERB, EDGE, out, far), _CURB, NUMBER["stone"])
    patch.add(box(tile, KERB, far, 0.0, _CURB, KERB, far, "fblr"), NUMBER["trim"])
    patch.add(top(tile, EDGE, out, _CURB, EDGE, out), land)
    add_markings(patch, tile)
    # The streets along X are the same in frames turned by a quarter, whose right is -Z.
    turned = Frames(tile.x, tile.y, tile.z + PITCH, 0.0 * tile.dx, -tile.dx)
    add_markings(patch, turned)


def _ring(patch: Patchwork, tile: Frames, edges: Sequence[float], y: float, material: int) -> None:
    """Return four level quads between two squares."""
    a, b, c, d = edges
    patch.add(top(tile, a, d, y, a, b), material)
    patch.add(top(tile, a, d, y, c, d), material)
    patch.add(top(tile, a, b, y, b, c), material)
    patch.add(top(tile, c, d, y, b, c), material)


def add_markings(patch: Patchwork, tile: Frames) -> None:
    """Mark the streets along Z: a dashed middle line on the first, and pedestrian crossings."""
    paint = NUMBER["marking"]
    owner, number = each(np.full(len(tile), _DASHES))
    start = 10.5 + 6.0 * number
    patch.add(top(tile[owner], -0.08, 0.08, _PAINT, start, start + 3.0), paint)
    owner, number = each(np.full(len(tile), 2 * _STRIPES))
    near = 0.45 + 1.2 * (number % _STRIPES)
    along = np.where(number < _STRIPES, KERB + 0.4, PITCH - KERB - 3.2)
    for s in (near, PITCH - near - 0.6):
        patch.add(top(tile[owner], s, s + 0.6, _PAINT, along, along + 2.8), paint)


def add_meadow(patch: Patchwork, tile: Frames) -> None:
    """Add open land."""
    patch.add(top(tile, 0.0, PITCH, -0.05, 0.0, PITCH), NUMBER["grass"])
