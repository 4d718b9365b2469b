"""The plan of the city: blocks, houses and towers on each tile, as tables of numbers.

In: a seed and the tiles' coordinates (i, j), which count pitches of `PITCH` metres from the middle.
Out: kinds, and tables of houses and towers. Everything is a function of the seed and of (i, j)
alone: a larger city of a seed holds the smaller ones, tile for tile.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .frames import Frames, frames
from .hashing import unit_floats

#: Metres between the middles of adjacent streets, which is the side of a tile.
PITCH = 72.0
#: Half the carriageway, and the distance at which the pavement ends and the block begins.
KERB, EDGE = 5.0, 8.5
LAND = PITCH - 2.0 * EDGE
DEPTH = 13.0
#: The column of tiles with the river.
RIVER_COLUMN = 1

HOUSES, TOWERS, PARK, PLAZA, RIVER = range(5)
_FIXED = {
    (-2, -1): PARK,
    (-2, 0): PARK,
    (-1, -2): PLAZA,
    (-1, -1): HOUSES,
    (-1, 0): HOUSES,
    (0, -1): HOUSES,
    (0, 0): HOUSES,
    (0, 1): TOWERS,
}
#: Side of the squares of tiles that have towers in their middle.
_QUARTER = 11
_TOWER_REACH = 3.0

# Channels of the hash, one for each purpose.
_KIND, _MIDDLE, _LOT, _STOREYS, _STYLE, _ROOF, _PLOT = range(100, 107)


def tile_kinds(seed: int, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """Return the kind of each tile: HOUSES, TOWERS, PARK, PLAZA or RIVER, (N,) int."""
    chance = unit_floats(seed, _KIND, i, j)
    towers = 0.03 + 0.85 * np.maximum(0.0, 1.0 - _middle_distance(seed, i, j) / _TOWER_REACH)
    kinds = np.select(
        [chance < 0.07, chance < 0.12, chance > 1.0 - towers], [PARK, PLAZA, TOWERS], HOUSES
    )
    for (a, b), kind in _FIXED.items():
        kinds[(i == a) & (j == b)] = kind
    kinds[i == RIVER_COLUMN] = RIVER
    return kinds


def _middle_distance(seed: int, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """Return the distance in tiles between each tile and the middle of its quarter."""
    a, b = i // _QUARTER, j // _QUARTER
    across = _QUARTER * (0.25 + 0.5 * unit_floats(seed, _MIDDLE, a, b, 0)) + a * _QUARTER - i
    along = _QUARTER * (0.25 + 0.5 * unit_floats(seed, _MIDDLE, a, b, 1)) + b * _QUARTER - j
    return np.sqrt(across * across + along * along)


@dataclass(frozen=True)
class Houses:
    """A table of N houses in rows along streets.

    Attributes
    ----------
    tile : (N,) int
        Which of the tiles each stands on.
    front : Frames
        At the left end of the street front, on the pavement's level.
    width : (N,) float
        Along the street; all are `DEPTH` deep.
    storeys : (N,) int
        Above the ground floor.
    corner : (N,) int
        -1 where the left side faces a street as well, 1 the right side, 0 neither.
    style, roof : (N,) float
        In [0, 1): what it looks like.
    """

    tile: np.ndarray
    front: Frames
    width: np.ndarray
    storeys: np.ndarray
    corner: np.ndarray
    style: np.ndarray
    roof: np.ndarray


#: Rows of houses round a block: origin (in block lands) and direction of the front, lots in the
#: row, and whether its ends are corners. The first two span the block, the others lie between.
_ROWS = (
    ((1.0, 0.0), (-1.0, 0.0), 4, True),
    ((0.0, 1.0), (1.0, 0.0), 4, True),
    ((0.0, 0.0), (0.0, 1.0), 2, False),
    ((1.0, 1.0), (0.0, -1.0), 2, False),
)


def houses(seed: int, i: np.ndarray, j: np.ndarray) -> Houses:
    """Return the houses of tiles of kind HOUSES."""
    rows = [_row(seed, i, j, number, *row) for number, row in enumerate(_ROWS)]
    columns = [np.concatenate(column) for column in zip(*rows, strict=True)]
    order = np.argsort(columns[0], kind="stable")
    tile, x, z, dx, dz, width, corner, lot = (column[order] for column in columns)
    a, b = i[tile], j[tile]
    block = unit_floats(seed, _STOREYS, a, b)
    storeys = 2 + (3.2 * block + 3.0 * unit_floats(seed, _STOREYS, a, b, lot)).astype(np.int64)
    return Houses(
        tile,
        frames(x, z, dx, dz, 0.15),
        width,
        storeys,
        corner,
        unit_floats(seed, _STYLE, a, b, lot),
        unit_floats(seed, _ROOF, a, b, lot),
    )


def _row(
    seed: int,
    i: np.ndarray,
    j: np.ndarray,
    number: int,
    origin: tuple[float, float],
    way: tuple[float, float],
    lots: int,
    has_corners: bool,
) -> tuple[np.ndarray, ...]:
    """Return one row of houses on every tile: tile, x, z, dx, dz, width, corner and lot of each."""
    length = LAND if has_corners else LAND - 2.0 * DEPTH
    start = 0.0 if has_corners else DEPTH
    share = [0.75 + 0.5 * unit_floats(seed, _LOT, i, j, number, k) for k in range(lots)]
    ends = np.cumsum(np.stack(share, axis=1), axis=1)
    ends = ends * (length / ends[:, -1:])
    ends[:, -1] = length
    begins = np.concatenate([np.zeros((len(i), 1)), ends[:, :-1]], axis=1)
    x = i[:, np.newaxis] * PITCH + EDGE + origin[0] * LAND + way[0] * (start + begins)
    z = j[:, np.newaxis] * PITCH + EDGE + origin[1] * LAND + way[1] * (start + begins)
    corner = np.zeros(lots, np.int64)
    if has_corners:
        corner[0], corner[-1] = -1, 1
    tile = np.repeat(np.arange(len(i)), lots)
    lot = np.tile(np.arange(lots) + 10 * number, len(i))
    ways = (np.full(len(tile), part) for part in way)
    width = (ends - begins).ravel()
    return tile, x.ravel(), z.ravel(), *ways, width, np.tile(corner, len(i)), lot


@dataclass(frozen=True)
class Towers:
    """A table of N towers: tile, middle (x, z), half widths a along X and b along Z, storeys, style
    in [0, 1)."""

    tile: np.ndarray
    x: np.ndarray
    z: np.ndarray
    a: np.ndarray
    b: np.ndarray
    storeys: np.ndarray
    style: np.ndarray


def towers(seed: int, i: np.ndarray, j: np.ndarray) -> Towers:
    """Return the towers of tiles of kind TOWERS: two or three on each."""
    tile = np.repeat(np.arange(len(i)), 4)
    plot = np.tile(np.arange(4), len(i))
    a, b = i[tile], j[tile]
    chance = [unit_floats(seed, _PLOT, a, b, plot, k) for k in range(6)]
    quarter = LAND / 4.0
    x = a * PITCH + EDGE + quarter * (1 + 2 * (plot % 2))
    z = b * PITCH + EDGE + quarter * (1 + 2 * (plot // 2))
    # One of the four plots stays open, a different one on each tile.
    open_plot = (unit_floats(seed, _PLOT, a, b) * 4.0).astype(np.int64)
    kept = plot != open_plot
    height = 8.0 + 30.0 * chance[2] * chance[3] + 8.0 * chance[4]
    sizes = 7.5 + 4.0 * chance[0], 7.5 + 4.0 * chance[1], height.astype(np.int64)
    return Towers(*(column[kept] for column in (tile, x, z, *sizes, chance[5])))
