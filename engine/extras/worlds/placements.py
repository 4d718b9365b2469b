"""Places small things on each kind of tile.

In: a seed, tiles' coordinates and kinds. Out: for each template, the tiles and the places (x, y, z,
scale, cosine and sine of the rotation). They depend only on the seed and the tile's coordinates.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...base import linalg
from .frames import Lengths
from .furniture import CARS, TREES, template
from .hashing import unit_floats
from .plan import DEPTH, EDGE, HOUSES, KERB, LAND, PARK, PITCH, PLAZA, RIVER, TOWERS

_LAMP, _STREET_TREE, _CAR, _COURT, _GROVE, _SQUARE, _TURN, _SIZE, _WOOD = range(500, 509)
_TURNS = 16
_COSINES, _SINES = linalg.unit_circle(_TURNS)
_CURB = 0.15
_LAMPS_ALONG = (21.0, 51.0)
_TREES_ALONG = (13.0, 28.0, 36.0, 44.0, 59.0)
_SLOTS = np.arange(13.0, 57.0, 5.5)
_GROVE_SIDE = 7

Places = dict[str, tuple[np.ndarray, np.ndarray]]


def placements(seed: int, i: np.ndarray, j: np.ndarray, kinds: np.ndarray) -> Places:
    """Return name of the template -> (tiles (N,) int, places (N, 6) float64), by tile."""
    things = _Things(seed, i, j)
    _line_streets(things, kinds)
    _plant_courts(things, np.flatnonzero(kinds == HOUSES))
    _plant_parks(things, np.flatnonzero(kinds == PARK))
    _furnish_plazas(things, np.flatnonzero(kinds == PLAZA))
    _plant_open_plots(things, np.flatnonzero(kinds == TOWERS))
    return things.sorted()


def wood(seed: int, i: np.ndarray, j: np.ndarray, triangles: int) -> Places:
    """Return places of trees on meadows with about this many triangles, up to one tree."""
    if not len(i):
        return {}
    things = _Things(seed, i, j)
    count = triangles // min(len(template(name).faces) for name in TREES)
    number, tile = np.divmod(np.arange(count), len(i))
    x, z = (1.0 + (PITCH - 2.0) * things.chance(_WOOD, tile, number, k) for k in range(2))
    sizes = np.array([len(template(name).faces) for name in TREES])
    kept = np.cumsum(sizes[things.tree_kinds(tile, number, _WOOD)]) <= triangles
    things.add_trees(tile[kept], x[kept], z[kept], -0.1, number[kept], _WOOD)
    return things.sorted()


class _Things:
    """Collects placed things; positions are relative to the tile."""

    def __init__(self, seed: int, i: np.ndarray, j: np.ndarray) -> None:
        self.seed, self.i, self.j = seed, i, j
        self._found: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {}

    def chance(self, channel: int, tile: np.ndarray, *numbers: int | np.ndarray) -> np.ndarray:
        """Return random numbers in [0, 1) for the tiles."""
        return unit_floats(self.seed, channel, self.i[tile], self.j[tile], *numbers)

    def add(
        self,
        name: str,
        tile: np.ndarray,
        x: Lengths,
        z: Lengths,
        y: float = _CURB,
        scale: Lengths = 1.0,
        cosine: Lengths = 1.0,
        sine: Lengths = 0.0,
    ) -> None:
        if len(tile):
            x, z = self.i[tile] * PITCH + x, self.j[tile] * PITCH + z
            parts = np.broadcast_arrays(x, y, z, scale, cosine, sine)
            place = np.stack([np.asarray(part, np.float64) for part in parts], axis=1)
            self._found.setdefault(name, []).append((tile, place))

    def add_trees(
        self,
        tile: np.ndarray,
        x: np.ndarray,
        z: np.ndarray,
        y: float,
        number: np.ndarray,
        channel: int,
    ) -> None:
        """Add trees of all kinds and sizes, randomly rotated."""
        kind = self.tree_kinds(tile, number, channel)
        scale = 0.75 + 0.6 * self.chance(_SIZE, tile, number, channel)
        turn = (self.chance(_TURN, tile, number, channel) * _TURNS).astype(np.int64)
        for k, name in enumerate(TREES):
            m = kind == k
            way = _COSINES[turn[m]], _SINES[turn[m]]
            self.add(name, tile[m], x[m], z[m], y, scale[m], *way)

    def tree_kinds(self, tile: np.ndarray, number: np.ndarray, channel: int) -> np.ndarray:
        """Return indices of `TREES`: round and wide ones are twice as frequent."""
        kind = (self.chance(channel, tile, number, 7) * 6.0).astype(np.int64)
        return np.array([0, 0, 1, 1, 2, 3])[kind]

    def sorted(self) -> Places:
        places = {}
        for name, found in self._found.items():
            tile = np.concatenate([tile for tile, _ in found])
            order = np.argsort(tile, kind="stable")
            places[name] = tile[order], np.concatenate([place for _, place in found])[order]
        return places


def _along_sides(tiles: np.ndarray, along: ArrayLike, inward: float) -> tuple[np.ndarray, ...]:
    """Return points on the four sides of tiles: tile, side, number, x, z, and street direction."""
    along = np.asarray(along)
    tile = np.repeat(tiles, 4 * len(along))
    side = np.tile(np.repeat(np.arange(4), len(along)), len(tiles))
    number = np.tile(np.arange(len(along)), 4 * len(tiles))
    t = along[number]
    x = np.choose(side, np.broadcast_arrays(inward, PITCH - inward, t, t))
    z = np.choose(side, np.broadcast_arrays(t, t, inward, PITCH - inward))
    return tile, side, number, x, z


def _line_streets(things: _Things, kinds: np.ndarray) -> None:
    """Add lamps, trees and parked cars along streets; the river has streets on two sides."""
    tiles = np.arange(len(kinds))
    tile, side, number, x, z = _along_sides(tiles, _LAMPS_ALONG, KERB + 0.7)
    kept = (kinds[tile] != RIVER) | (side < 2)
    things.add("lamp", tile[kept], x[kept], z[kept])

    tile, side, number, x, z = _along_sides(tiles, _TREES_ALONG, KERB + 1.1)
    avenue = things.chance(_STREET_TREE, tile, side) < 0.6
    kept = avenue & (things.chance(_STREET_TREE, tile, side, number) < 0.85)
    kept &= (kinds[tile] != RIVER) | (side < 2)
    kind = (things.chance(_STREET_TREE, tile, side, 99) * 2.0).astype(np.int64)
    turn = (things.chance(_TURN, tile, side, number) * _TURNS).astype(np.int64)
    for k, name in enumerate(("round tree", "poplar")):
        m = kept & (kind == k)
        scale = 0.72 + 0.2 * things.chance(_SIZE, tile[m], side[m], number[m])
        way = _COSINES[turn[m]], _SINES[turn[m]]
        things.add(name, tile[m], x[m], z[m], _CURB, scale, *way)

    tile, side, number, x, z = _along_sides(tiles, _SLOTS, KERB - 1.15)
    kept = things.chance(_CAR, tile, side, number) < 0.32
    kept &= (kinds[tile] != RIVER) | (side < 2)
    color = (things.chance(_CAR, tile, side, number, 1) * len(CARS)).astype(np.int64)
    for k, name in enumerate(CARS):
        m = kept & (color == k)
        # Right-hand traffic: towards -Z on the low side of X, towards +Z on the high one, and so
        # on.
        cosine = np.choose(side[m], (1.0, -1.0, 0.0, 0.0))
        sine = np.choose(side[m], (0.0, 0.0, -1.0, 1.0))
        things.add(name, tile[m], x[m], z[m], 0.0, 1.0, cosine, sine)


def _scatter(
    things: _Things, tiles: np.ndarray, count: int, channel: int, low: float, high: float
) -> tuple[np.ndarray, ...]:
    """Return ``count`` random points in the square from ``low`` to ``high`` of each tile."""
    tile = np.repeat(tiles, count)
    number = np.tile(np.arange(count), len(tiles))
    x, z = (low + (high - low) * things.chance(channel, tile, number, k) for k in range(2))
    return tile, number, x, z


def _plant_courts(things: _Things, tiles: np.ndarray) -> None:
    inset = EDGE + DEPTH + 2.5
    tile, number, x, z = _scatter(things, tiles, 5, _COURT, inset, PITCH - inset)
    things.add_trees(tile, x, z, _CURB, number, _COURT)


def _plant_parks(things: _Things, tiles: np.ndarray) -> None:
    """Add a grove on a jittered grid that avoids paths and pond, and benches at the pond."""
    count = _GROVE_SIDE * _GROVE_SIDE
    tile = np.repeat(tiles, count)
    number = np.tile(np.arange(count), len(tiles))
    step = LAND / _GROVE_SIDE
    x, z = (
        EDGE + step * (cell + 0.15 + 0.7 * things.chance(_GROVE, tile, number, k))
        for k, cell in enumerate((number % _GROVE_SIDE, number // _GROVE_SIDE))
    )
    a, b = np.abs(x - PITCH / 2), np.abs(z - PITCH / 2)
    free = (a > 2.6) & (b > 2.6) & (a * a + b * b > 196.0)
    free &= things.chance(_GROVE, tile, number, 2) < 0.8
    things.add_trees(tile[free], x[free], z[free], _CURB, number[free], _GROVE)
    for dx, dz, cosine, sine in ((0, -1, 1, 0), (0, 1, -1, 0), (-1, 0, 0, 1), (1, 0, 0, -1)):
        for aside in (-2.6, 2.6):
            at = PITCH / 2 + 12.4 * dx + aside * abs(dz), PITCH / 2 + 12.4 * dz + aside * abs(dx)
            things.add("bench", tiles, *at, _CURB + 0.04, 1.0, float(cosine), float(sine))


def _furnish_plazas(things: _Things, tiles: np.ndarray) -> None:
    """Add a church on every second plaza, fountains on others; trees and benches around them."""
    has_church = things.chance(_SQUARE, tiles) < 0.5
    has_church |= (things.i[tiles] == -1) & (things.j[tiles] == -2)
    middle = PITCH / 2
    things.add("church", tiles[has_church], middle, middle - 2.0)
    things.add("fountain", tiles[~has_church], middle, middle)
    for number in range(24):
        side, step = divmod(number, 6)
        t, edge = EDGE + 7.0 + step * 8.4, EDGE + 4.5
        x, z = ((t, edge), (t, PITCH - edge), (edge, t), (PITCH - edge, t))[side]
        scale = 0.8 + 0.2 * things.chance(_SIZE, tiles, number)
        things.add("round tree", tiles, x, z, _CURB, scale)
    for x, z, cosine, sine in ((0, -1, 1, 0), (0, 1, -1, 0), (-1, 0, 0, 1), (1, 0, 0, -1)):
        for aside in (-12.0, 12.0):
            at = middle + 20.0 * x + aside * abs(z), middle + 20.0 * z + aside * abs(x)
            things.add("bench", tiles, *at, _CURB, 1.0, float(cosine), float(sine))


def _plant_open_plots(things: _Things, tiles: np.ndarray) -> None:
    """Add rows of trees between towers."""
    middle = PITCH / 2
    for number in range(8):
        t = EDGE + 3.0 + number * (LAND - 6.0) / 7.0
        for x, z in ((t, middle), (middle, t)):
            scale = 0.7 + 0.2 * things.chance(_SIZE, tiles, number)
            things.add("round tree", tiles, x, z, _CURB, scale)
