"""Houses: facades, roofs, balconies, awnings and chimneys from the plan's table.

In: `plan.Houses`. Out: quads in a `Patchwork`, and in `house_quads` the quads of each house.
"""

from __future__ import annotations

import numpy as np

from .facades import (
    AWNING_QUADS,
    BALCONY_QUADS,
    GROUND,
    STOREY,
    Facades,
    add_awnings,
    add_balconies,
    add_flats,
    add_plains,
    add_reliefs,
    flat_quads,
    relief_quads,
)
from .frames import Frames, Lengths, each
from .patchwork import Patchwork
from .plan import DEPTH, Houses
from .roofs import (
    CHIMNEY_QUADS,
    DORMER_QUADS,
    FLAT,
    GABLE,
    HIP,
    MANSARD,
    ROOF_QUADS,
    add_chimneys,
    add_roofs,
    dormers,
)
from .surfaces import numbers

_WALLS = numbers(
    "plaster cream",
    "brick red",
    "plaster ochre",
    "masonry",
    "plaster white",
    "brick brown",
    "plaster rose",
    "plaster grey",
    "brick yellow",
    "plaster green",
)
_COVERS = numbers("roof tiles", "roof slate", "roof tiles", "roof slate", "roof copper")
_AWNINGS = numbers("awning red", "awning green", "awning blue")
_MASONRY, _WINDOW = numbers("masonry", "window")


def _digit(value: np.ndarray, place: int, choices: int) -> np.ndarray:
    """Return 0..choices-1 from a number in [0, 1); different places give different choices."""
    scaled = value * (1009.0, 1013.0, 1019.0, 1021.0, 1031.0, 1033.0)[place]
    return ((scaled - np.floor(scaled)) * choices).astype(np.int64)


def _roof_kinds(houses: Houses) -> np.ndarray:
    kinds = np.array([GABLE, MANSARD, FLAT, GABLE, MANSARD, GABLE, FLAT, MANSARD])
    kind = kinds[_digit(houses.roof, 0, len(kinds))]
    return np.where((houses.corner != 0) & (kind == GABLE), HIP, kind)


def _has_shop(houses: Houses) -> np.ndarray:
    return _digit(houses.style, 1, 5) < 2


def _has_awning(houses: Houses) -> np.ndarray:
    return _has_shop(houses) & (_digit(houses.style, 2, 3) > 0)


def _balcony_rows(houses: Houses) -> np.ndarray:
    """Return how many storeys have balconies: every second from the second on, on some houses."""
    return np.where(_digit(houses.style, 3, 4) == 0, houses.storeys // 2, 0)


def house_quads(houses: Houses) -> np.ndarray:
    """Return how many quads `add_houses` makes of each house, (N,)."""
    deep = np.full(len(houses.width), DEPTH)
    is_corner = houses.corner != 0
    kind = _roof_kinds(houses)
    return (
        relief_quads(houses.width, houses.storeys)
        + flat_quads(houses.width, houses.storeys)
        + np.where(is_corner, relief_quads(deep, houses.storeys), 1)
        + 1
        + ROOF_QUADS[kind]
        + DORMER_QUADS * dormers(kind, houses.width)
        + CHIMNEY_QUADS
        + BALCONY_QUADS * _balcony_rows(houses)
        + AWNING_QUADS * _has_awning(houses)
    )


def add_houses(patch: Patchwork, houses: Houses, seed: int) -> None:
    """Add houses."""
    fronts = _facades(houses, houses.front, houses.width)
    backs = _facades(houses, _moved(houses.front, houses.width, -DEPTH, turns=2), houses.width)
    deep = np.full(len(houses.width), DEPTH)
    lefts = _facades(houses, _moved(houses.front, 0.0, -DEPTH, turns=1), deep)
    rights = _facades(houses, _moved(houses.front, houses.width, 0.0, turns=3), deep)
    on_left, on_right = houses.corner == -1, houses.corner == 1
    add_reliefs(patch, fronts, seed)
    add_flats(patch, backs, seed)
    for sides, seen in ((lefts, on_left), (rights, on_right)):
        add_reliefs(patch, sides[seen], seed)
        add_plains(patch, sides[~seen])
    _add_ornaments(patch, houses, fronts)
    _add_tops(patch, houses)


def _facades(houses: Houses, frame: Frames, width: np.ndarray) -> Facades:
    shop = _has_shop(houses)
    wall = _WALLS[_digit(houses.style, 0, len(_WALLS))]
    half = 0.5 + 0.12 * _digit(houses.style, 4, 3)
    return Facades(
        frame, width, houses.storeys, wall, np.where(shop, _MASONRY, wall), half, shop
    )  # fmt: skip


def _moved(frame: Frames, s: Lengths, o: Lengths, turns: int) -> Frames:
    """Return frames at (s, o) of others, turned left by quarter turns as seen from above."""
    x = frame.x + frame.dx * s - frame.dz * o
    z = frame.z + frame.dz * s + frame.dx * o
    dx, dz = frame.dx, frame.dz
    for _ in range(turns):
        dx, dz = -dz, dx
    return Frames(x, frame.y, z, dx, dz)


def _add_ornaments(patch: Patchwork, houses: Houses, fronts: Facades) -> None:
    if patch.tolerance >= 1.4:
        return
    owner, number = each(_balcony_rows(houses))
    add_balconies(patch, fronts[owner], 2 * number + 1)
    chosen = np.flatnonzero(_has_awning(houses))
    add_awnings(patch, fronts[chosen], _AWNINGS[_digit(houses.style[chosen], 5, 3)])


def _add_tops(patch: Patchwork, houses: Houses) -> None:
    eaves = Frames(
        houses.front.x,
        houses.front.y + (GROUND + STOREY * houses.storeys),
        houses.front.z,
        houses.front.dx,
        houses.front.dz,
    )
    cover = _COVERS[_digit(houses.roof, 1, len(_COVERS))]
    pane = np.full(len(cover), _WINDOW)
    wall = _WALLS[_digit(houses.style, 0, len(_WALLS))]
    add_roofs(patch, eaves, houses.width, _roof_kinds(houses), cover, wall, pane)
    s = np.where(_digit(houses.roof, 2, 2) == 0, 1.0, houses.width - 1.0)
    o = -4.0 - 0.5 * _digit(houses.roof, 3, 11)
    add_chimneys(patch, eaves, s, o, 5.2 + 0.25 * _digit(houses.roof, 4, 4))
