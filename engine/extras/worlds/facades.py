"""Walls with openings: the street fronts, the backs and the sides of houses.

In: a `Patchwork`, and `Facades`: frames with what varies from one to the next. Out: quads, and in
`relief_quads` and `flat_quads` how many they are. Windows of a relief stand back behind the wall;
behind them a wall without openings keeps the sky from showing through where quads of different
sizes meet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .frames import Frames, back, bottom, box, each, front, left, quads, right, top
from .hashing import unit_floats
from .patchwork import Patchwork
from .surfaces import NUMBER, numbers

GROUND, STOREY = 4.0, 3.2
_BAY = 2.9
_RECESS, _PANE, _BEFORE = 0.22, 0.15, 0.04
_SILL, _HEAD = 0.85, 2.65
_LIT, _DOOR = 200, 201
_LIT_SHARE = 0.16
_PANES = numbers("window", "window lit", "shop window", "shop window lit", "door")


@dataclass(frozen=True)
class Facades:
    """N facades: frames at their left ends, and for each: (N,) width in metres, storeys above the
    ground floor, material numbers of wall and ground floor, half width of windows, and whether the
    ground floor is a shop.
    """

    frame: Frames
    width: np.ndarray
    storeys: np.ndarray
    wall: np.ndarray
    ground: np.ndarray
    half: np.ndarray
    shop: np.ndarray

    def __getitem__(self, index: np.ndarray) -> Facades:
        return Facades(*(getattr(self, name)[index] for name in self.__dataclass_fields__))

    @property
    def bays(self) -> np.ndarray:
        return np.maximum(1, (self.width / _BAY).astype(np.int64))

    @property
    def height(self) -> np.ndarray:
        return GROUND + STOREY * self.storeys


def relief_quads(width: np.ndarray, storeys: np.ndarray) -> np.ndarray:
    """Return how many quads `add_reliefs` makes for facades of given widths and storeys."""
    bays = np.maximum(1, (width / _BAY).astype(np.int64))
    return 9 * bays + storeys * (2 + 6 * bays) + 12


def flat_quads(width: np.ndarray, storeys: np.ndarray) -> np.ndarray:
    """Return how many quads `add_flats` makes."""
    return 1 + np.maximum(1, (width / _BAY).astype(np.int64)) * (storeys + 1)


def add_reliefs(patch: Patchwork, facades: Facades, seed: int) -> None:
    """Add street fronts: recessed openings, a string course, a cornice.

    At coarser detail the wall has no openings, and panes in front of it.
    """
    frame, width, height = facades.frame, facades.width, facades.height
    trim = NUMBER["trim"]
    if _is_level(patch):
        patch.add(front(frame, 0.0, width, 0.0, GROUND, 0.0), facades.ground)
        patch.add(front(frame, 0.0, width, GROUND, height, 0.0), facades.wall)
    else:
        patch.add(front(frame, 0.0, width, 0.0, height, -_RECESS), facades.wall)
    _add_ground_floor(patch, facades, seed)
    _add_upper_floors(patch, facades, seed)
    if not _is_level(patch):
        patch.add(box(frame, 0.0, width, GROUND - 0.30, GROUND, 0.0, 0.12, "ftulr"), trim)
    patch.add(box(frame, -0.1, width + 0.1, height - 0.40, height, 0.0, 0.40, "ftulr"), trim)


def _is_level(patch: Patchwork) -> bool:
    return patch.tolerance >= _RECESS


def _add_ground_floor(patch: Patchwork, facades: Facades, seed: int) -> None:
    """Add the ground floor: each bay is a wall cell around its opening; one is the door."""
    bays = facades.bays
    owner, bay = each(bays)
    frame, pitch = facades.frame[owner], (facades.width / bays)[owner]
    shop, ground = facades.shop[owner], facades.ground[owner]
    chance = unit_floats(seed, _DOOR, _metres(facades.frame.x), _metres(facades.frame.z))
    door = bay == (chance * bays).astype(np.int64)[owner]
    half = np.where(door, 0.8, np.where(shop, pitch * 0.5 - 0.35, facades.half[owner]))
    sill = np.where(door, 0.06, np.where(shop, 0.45, _SILL))
    head = np.where(door, 2.7, np.where(shop, 3.1, _HEAD))
    s0, s1 = bay * pitch, (bay + 1) * pitch
    a, b = s0 + pitch * 0.5 - half, s0 + pitch * 0.5 + half
    walls = (
        front(frame, s0, s1, 0.0, sill, 0.0),
        front(frame, s0, s1, head, GROUND, 0.0),
        front(frame, s0, a, sill, head, 0.0),
        front(frame, b, s1, sill, head, 0.0),
    )
    for wall in () if _is_level(patch) else walls:
        patch.add(wall, ground)
    kind = np.where(door, 4, 2 * shop + _lit(seed, frame, bay, 0))
    _add_openings(patch, frame, a, b, sill, head, ground, _PANES[kind])


def _add_upper_floors(patch: Patchwork, facades: Facades, seed: int) -> None:
    """Add the upper floors: wall bands below the rows of windows, piers, and a last band."""
    owner, storey = each(facades.storeys)
    frame, width, wall = facades.frame[owner], facades.width[owner], facades.wall[owner]
    floor = GROUND + STOREY * storey
    bays, half = facades.bays[owner], facades.half[owner]
    pitch = width / bays
    if not _is_level(patch):
        under = np.where(storey == 0, GROUND, floor - STOREY + _HEAD)
        patch.add(front(frame, 0.0, width, under, floor + _SILL, 0.0), wall)
        height = facades.height
        last = np.where(facades.storeys == 0, GROUND, height - STOREY + _HEAD)
        patch.add(front(facades.frame, 0.0, facades.width, last, height, 0.0), facades.wall)

        which, pier = each(bays + 1)
        edge = pier * pitch[which] + pitch[which] * 0.5
        s0 = np.where(pier == 0, 0.0, edge - pitch[which] + half[which])
        s1 = np.where(pier == bays[which], width[which], edge - half[which])
        low = floor[which]
        patch.add(front(frame[which], s0, s1, low + _SILL, low + _HEAD, 0.0), wall[which])

    which, bay = each(bays)
    middle, low = (bay + 0.5) * pitch[which], floor[which]
    a, b = middle - half[which], middle + half[which]
    pane = _PANES[_lit(seed, frame[which], bay, storey[which] + 1)]
    _add_openings(patch, frame[which], a, b, low + _SILL, low + _HEAD, wall[which], pane)


def _add_openings(
    patch: Patchwork,
    frame: Frames,
    a: np.ndarray,
    b: np.ndarray,
    sill: np.ndarray,
    head: np.ndarray,
    wall: np.ndarray,
    pane: np.ndarray,
) -> None:
    """Add recessed panes, and the four sides of each hole in the wall."""
    if _is_level(patch):
        patch.add(front(frame, a, b, sill, head, _BEFORE), pane)
        return
    patch.add(front(frame, a, b, sill, head, -_PANE), pane)
    patch.add(right(frame, a, sill, head, -_RECESS, 0.0), wall)
    patch.add(left(frame, b, sill, head, -_RECESS, 0.0), wall)
    patch.add(top(frame, a, b, sill, -_RECESS, 0.0), NUMBER["trim"])
    patch.add(bottom(frame, a, b, head, -_RECESS, 0.0), wall)


def add_flats(patch: Patchwork, facades: Facades, seed: int) -> None:
    """Add backs: a wall with panes in front of it."""
    patch.add(front(facades.frame, 0.0, facades.width, 0.0, facades.height, 0.0), facades.wall)
    owner, number = each(facades.bays * (facades.storeys + 1))
    bays = facades.bays[owner]
    storey, bay = number // bays, number % bays
    frame, pitch = facades.frame[owner], facades.width[owner] / bays
    middle, half = (bay + 0.5) * pitch, facades.half[owner]
    low = np.where(storey == 0, 0.2, GROUND + STOREY * (storey - 1))
    pane = _PANES[_lit(seed, frame, bay, storey)]
    patch.add(front(frame, middle - half, middle + half, low + _SILL, low + _HEAD, _BEFORE), pane)


def add_plains(patch: Patchwork, facades: Facades) -> None:
    """Add walls without openings: one quad each."""
    patch.add(front(facades.frame, 0.0, facades.width, 0.0, facades.height, 0.0), facades.wall)


#: Quads of a balcony and of an awning.
BALCONY_QUADS, AWNING_QUADS = 9, 4


def add_balconies(patch: Patchwork, facades: Facades, storey: np.ndarray) -> None:
    """Add a balcony along each facade at the floor of an upper storey."""
    floor, end = GROUND + STOREY * storey, facades.width - 0.6
    patch.add(box(facades.frame, 0.6, end, floor - 0.15, floor, 0.0, 0.95, "ftulr"), NUMBER["trim"])
    rail = facades.frame, floor, floor + 0.85
    metal = NUMBER["metal"]
    patch.add(front(rail[0], 0.6, end, *rail[1:], 0.92), metal)
    patch.add(back(rail[0], 0.6, end, *rail[1:], 0.92), metal)
    patch.add(left(rail[0], 0.6, *rail[1:], 0.0, 0.92), metal)
    patch.add(right(rail[0], end, *rail[1:], 0.0, 0.92), metal)


def add_awnings(patch: Patchwork, facades: Facades, material: np.ndarray) -> None:
    """Add a slanted awning over each ground floor, visible from above and below."""
    frame, end = facades.frame, facades.width - 0.4
    s, o = (0.4, end, end, 0.4), (1.4, 1.4, 0.13, 0.13)
    cloth = quads(frame, s, (2.9, 2.9, 3.6, 3.6), o)
    patch.add(cloth, material)
    patch.add(cloth[:, ::-1], material)
    patch.add(front(frame, 0.4, end, 2.62, 2.9, 1.4), material)
    patch.add(back(frame, 0.4, end, 2.62, 2.9, 1.4), material)


def _lit(seed: int, frame: Frames, bay: np.ndarray, storey: int | np.ndarray) -> np.ndarray:
    """Return 1 for lit windows, else 0."""
    chance = unit_floats(seed, _LIT, _metres(frame.x), _metres(frame.z), bay, storey)
    return (chance < _LIT_SHARE).astype(np.int64)


def _metres(coordinate: np.ndarray) -> np.ndarray:
    return np.floor(coordinate).astype(np.int64)
