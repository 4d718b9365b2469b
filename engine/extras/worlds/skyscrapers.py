"""Towers: ribbons of glass, fins over glass, or a grid of windows; with setbacks and crowns.

In: `plan.Towers`. Out: quads in a `Patchwork`, and in `tower_quads` how many each tower has. A
tower is one or two sections, one on the other; a section has four sides and a flat roof.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .facades import GROUND, STOREY, Facades, add_reliefs, relief_quads
from .frames import Frames, bottom, box, each, frames, front, top
from .patchwork import Patchwork
from .plan import Towers
from .surfaces import NUMBER, numbers

_LOBBY, _FLOOR = 5.0, 3.6
_RIBBON, _FIN, _GRID = range(3)
_GLASS = numbers("tower glass", "tower glass dark", "tower glass bronze")
_STONE = numbers("concrete", "plaster white", "masonry", "plaster grey")
_FIN_PITCH = 2.2
_SETBACK = 2.0


@dataclass(frozen=True)
class _Sections:
    """N sections: tower, middle x, z, half widths, base height, storeys, whether it is upper."""

    tower: np.ndarray
    x: np.ndarray
    z: np.ndarray
    a: np.ndarray
    b: np.ndarray
    foot: np.ndarray
    storeys: np.ndarray
    upper: np.ndarray


def _style(towers: Towers) -> np.ndarray:
    return (towers.style * 3.0).astype(np.int64)


def _second(towers: Towers) -> np.ndarray:
    """Return storeys of the upper section: a third for high towers; none for others."""
    return np.where((towers.storeys > 14) & (_style(towers) != _GRID), towers.storeys // 3, 0)


def _sections(towers: Towers) -> _Sections:
    upper = _second(towers)
    lower = towers.storeys - upper
    tower = np.arange(len(towers.x))
    high = np.flatnonzero(upper)
    foot = np.where(_style(towers) == _GRID, GROUND + STOREY * lower, _LOBBY + _FLOOR * lower)
    return _Sections(
        np.concatenate([tower, high]),
        np.concatenate([towers.x, towers.x[high]]),
        np.concatenate([towers.z, towers.z[high]]),
        np.concatenate([towers.a, towers.a[high] - _SETBACK]),
        np.concatenate([towers.b, towers.b[high] - _SETBACK]),
        np.concatenate([np.zeros(len(tower)), foot[high]]),
        np.concatenate([lower, upper[high]]),
        np.concatenate([np.zeros(len(tower), bool), np.ones(len(high), bool)]),
    )


def tower_quads(towers: Towers) -> np.ndarray:
    """Return how many quads `add_towers` makes of each tower, (N,)."""
    sections, quads = _sections(towers), np.zeros(len(towers.x), np.int64)
    style = _style(towers)[sections.tower]
    for width in (2.0 * sections.a, 2.0 * sections.b):
        side = np.select(
            [style == _RIBBON, style == _FIN],
            [1 + 4 * sections.storeys + 6, 1 + sections.storeys + 3 * _fins(width)],
            relief_quads(width, sections.storeys),
        )
        np.add.at(quads, sections.tower, 2 * side)
    np.add.at(quads, sections.tower, 1 + 16)
    return quads + 10


def _fins(width: np.ndarray) -> np.ndarray:
    return (width / _FIN_PITCH).astype(np.int64) + 1


def add_towers(patch: Patchwork, towers: Towers, seed: int) -> None:
    """Add towers."""
    sections = _sections(towers)
    style = _style(towers)[sections.tower]
    glass = _GLASS[(towers.style * 97.0).astype(np.int64) % 3][sections.tower]
    stone = _STONE[(towers.style * 89.0).astype(np.int64) % 4][sections.tower]
    for turn in range(4):
        frame, width = _side(sections, turn)
        lobby = np.where(sections.upper, 0.0, _LOBBY)
        chosen = np.flatnonzero(style != _GRID)
        patch.add(
            front(frame[chosen], 0.0, width[chosen], 0.0, lobby[chosen] + 0.01, -0.4), glass[chosen]
        )
        for kind, add in ((_RIBBON, _add_ribbons), (_FIN, _add_fins)):
            k = np.flatnonzero(style == kind)
            add(patch, frame[k], width[k], lobby[k], sections.storeys[k], glass[k], stone[k])
        k = np.flatnonzero(style == _GRID)
        shop = np.ones(len(k), bool)
        half = np.full(len(k), 0.9)
        wall = stone[k]
        grid = Facades(frame[k], width[k], sections.storeys[k], wall, wall, half, shop)
        add_reliefs(patch, grid, seed)
    _add_roofs(patch, sections, style, stone)
    _add_crowns(patch, towers)


def _side(sections: _Sections, turn: int) -> tuple[Frames, np.ndarray]:
    """Return frames of one side of each section, and its width."""
    dx, dz = ((1, 0), (0, -1), (-1, 0), (0, 1))[turn]
    along, across = (sections.a, sections.b) if dz == 0 else (sections.b, sections.a)
    x = sections.x - dx * along - dz * across
    z = sections.z - dz * along + dx * across
    return frames(x, z, dx, dz, 0.15 + sections.foot), 2.0 * along


def _add_ribbons(
    patch: Patchwork,
    frame: Frames,
    width: np.ndarray,
    lobby: np.ndarray,
    storeys: np.ndarray,
    glass: np.ndarray,
    stone: np.ndarray,
) -> None:
    """Add recessed bands of glass between bands of stone, and a pillar at each end."""
    owner, storey = each(storeys)
    f, w, low = frame[owner], width[owner], (lobby[owner] + _FLOOR * storey)
    recess = 0.0 if patch.tolerance >= 0.3 else 0.3
    patch.add(front(f, 0.0, w, low + 1.1, low + _FLOOR, -recess), glass[owner])
    patch.add(front(f, 0.0, w, low, low + 1.1, 0.0), stone[owner])
    if recess:
        patch.add(top(f, 0.0, w, low + 1.1, -0.3, 0.0), stone[owner])
        patch.add(bottom(f, 0.0, w, low, -0.3, 0.0), stone[owner])
    height = lobby + _FLOOR * storeys
    patch.add(box(frame, 0.0, 0.9, 0.0, height, -0.4, 0.05, "flr"), stone)
    patch.add(box(frame, width - 0.9, width, 0.0, height, -0.4, 0.05, "flr"), stone)


def _add_fins(
    patch: Patchwork,
    frame: Frames,
    width: np.ndarray,
    lobby: np.ndarray,
    storeys: np.ndarray,
    glass: np.ndarray,
    stone: np.ndarray,
) -> None:
    """Add full-height glass behind upright fins."""
    if patch.tolerance >= 0.65:
        patch.add(front(frame, 0.0, width, lobby, lobby + _FLOOR * storeys, -0.3), glass)
        return
    owner, storey = each(storeys)
    low = lobby[owner] + _FLOOR * storey
    patch.add(front(frame[owner], 0.0, width[owner], low, low + _FLOOR, -0.3), glass[owner])
    count = _fins(width)
    owner, number = each(count)
    middle = 0.2 + number * ((width - 0.4) / (count - 1))[owner]
    height = (lobby + _FLOOR * storeys)[owner]
    fins = box(frame[owner], middle - 0.2, middle + 0.2, 0.0, height, -0.3, 0.35, "flr")
    patch.add(fins, stone[owner])


def _add_roofs(patch: Patchwork, sections: _Sections, style: np.ndarray, stone: np.ndarray) -> None:
    """Add a roof and parapets to each section."""
    grid = style == _GRID
    height = np.where(
        grid,
        GROUND + STOREY * sections.storeys,
        np.where(sections.upper, 0.0, _LOBBY) + _FLOOR * sections.storeys,
    )
    frame, width = _side(sections, 0)
    depth = 2.0 * sections.b
    patch.add(top(frame, 0.0, width, height, -depth, 0.0), NUMBER["roof gravel"])
    for turn in range(4):
        frame, width = _side(sections, turn)
        patch.add(box(frame, 0.0, width, height - 0.5, height + 1.0, -0.4, 0.05, "ftub"), stone)


def _add_crowns(patch: Patchwork, towers: Towers) -> None:
    """Add the crowns of the highest roofs: machines, and a mast."""
    second = _second(towers)
    foot = np.where(_style(towers) == _GRID, GROUND, _LOBBY)
    foot = foot + np.where(_style(towers) == _GRID, STOREY, _FLOOR) * towers.storeys
    frame = frames(towers.x, towers.z, y=0.15 + foot)
    size = np.where(second > 0, 2.5, 4.0)
    patch.add(box(frame, -size, size, 0.0, 3.0, -size, size), NUMBER["concrete"])
    mast = np.where(towers.storeys > 20, 16.0, 5.0)
    patch.add(box(frame, -0.15, 0.15, 3.0, 3.0 + mast, -0.15, 0.15), NUMBER["metal"])
