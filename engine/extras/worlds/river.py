"""The river: banks with pavements and parapets, quays below with ramps, water, and bridges.

In: a `Patchwork`, frames at the corners of the river's tiles. Out: quads. A bank is defined once,
as seen from its street: s runs to the water, o along the street; the other bank uses a reversed
frame.
"""

from __future__ import annotations

import numpy as np

from .frames import Frames, box, each, left, quads, right, top
from .hashing import unit_floats
from .patchwork import Patchwork
from .plan import EDGE, KERB, PITCH
from .streets import add_markings
from .surfaces import NUMBER

CURB, QUAY, WATER = 0.15, -4.4, -5.2
#: Distance from the street's middle to the water.
BRINK = EDGE + 4.5
_PARAPET = 1.15
_GAP = 20.0, 23.0
_RAMP_END, _RAMP_WIDTH = 46.0, 2.2
_ARCHES, _STEPS = 3, 8
_SPRING, _CROWN = -4.0, -1.0
_BRIDGE = 300


def has_bridge(seed: int, line: np.ndarray) -> np.ndarray:
    """Return whether a bridge continues street number ``line`` along X."""
    return (unit_floats(seed, _BRIDGE, line) < 0.5) | (line == 0)


def add_river(patch: Patchwork, tile: Frames, starts: np.ndarray, ends: np.ndarray) -> None:
    """Add the river's tiles; ``starts`` and ``ends`` (N,) bool say where they have bridges."""
    turned = _turned(tile)
    patch.add(top(tile, BRINK, PITCH - BRINK, WATER, 0.0, PITCH), NUMBER["water"])
    _add_bank(patch, tile, starts, ends)
    _add_bank(patch, turned, ends, starts)
    add_markings(patch, tile)
    _add_half_bridges(patch, tile[starts])
    _add_half_bridges(patch, turned[ends])


def _turned(tile: Frames) -> Frames:
    return Frames(tile.x + PITCH, tile.y, tile.z + PITCH, -tile.dx, -tile.dz)


def _add_bank(patch: Patchwork, bank: Frames, starts: np.ndarray, ends: np.ndarray) -> None:
    """Add the street, its pavement, the wall, and the quay with its ramp."""
    stone, wall = NUMBER["stone"], NUMBER["masonry"]
    far = PITCH - KERB
    patch.add(top(bank, 0.0, KERB, 0.0, 0.0, PITCH), NUMBER["asphalt"])
    for flags, o0, o1 in ((starts, 0.0, KERB), (ends, far, PITCH)):
        material = np.where(flags, NUMBER["asphalt"], stone)
        patch.add(top(bank, KERB, EDGE, np.where(flags, 0.0, CURB), o0, o1), material)
    patch.add(top(bank, KERB, EDGE, CURB, KERB, far), stone)
    patch.add(left(bank, KERB, 0.0, CURB, KERB, far), NUMBER["trim"])
    patch.add(right(bank, EDGE, QUAY, CURB, 0.0, PITCH), wall)
    patch.add(top(bank, EDGE, BRINK, QUAY, 0.0, PITCH), stone)
    patch.add(right(bank, BRINK, WATER - 1.0, QUAY, 0.0, PITCH), wall)
    for o0, o1 in ((EDGE, _GAP[0]), (_GAP[1], PITCH - EDGE)):
        patch.add(box(bank, EDGE - 0.3, EDGE, CURB, _PARAPET, o0, o1, "ftlrb"), wall)
    for flags, o0, o1 in ((starts, 0.0, EDGE), (ends, PITCH - EDGE, PITCH)):
        shut = bank[~flags]
        patch.add(box(shut, EDGE - 0.3, EDGE, CURB, _PARAPET, o0, o1, "ftlrb"), wall)
    _add_ramp(patch, bank)


def _add_ramp(patch: Patchwork, bank: Frames) -> None:
    """Add a landing behind the gap in the parapet, and a ramp down along the wall."""
    stone, wall = NUMBER["stone"], NUMBER["masonry"]
    edge, (o0, o1), o2 = EDGE + _RAMP_WIDTH, _GAP, _RAMP_END
    patch.add(top(bank, EDGE, edge, CURB, o0, o1), stone)
    s, y = (EDGE, edge, edge, EDGE), (QUAY, QUAY, CURB, CURB)
    patch.add(quads(bank, s, y, (o2, o2, o1, o1)), stone)
    patch.add(right(bank, edge, QUAY, CURB, o0, o1), wall)
    middle = 0.5 * (o1 + o2)
    y = (QUAY, QUAY, CURB, QUAY)
    patch.add(quads(bank, (edge,) * 4, y, (middle, o1, o1, o2)), wall)
    patch.add(box(bank, EDGE, edge, QUAY, CURB, o0, o1, "b"), wall)
    patch.add(box(bank, edge - 0.2, edge, CURB, _PARAPET, o0, o1, "tlrb"), wall)


def _add_half_bridges(patch: Patchwork, bank: Frames) -> None:
    """Add half of a bridge, from the middle of its street to its parapet."""
    stone, wall = NUMBER["stone"], NUMBER["masonry"]
    end = PITCH - EDGE
    patch.add(top(bank, EDGE, end, 0.0, 0.0, KERB), NUMBER["asphalt"])
    patch.add(top(bank, EDGE, end, CURB, KERB, EDGE), stone)
    patch.add(box(bank, KERB, PITCH - KERB, 0.0, CURB, KERB, EDGE, "b"), NUMBER["trim"])
    patch.add(box(bank, EDGE, end, CURB, _PARAPET, EDGE - 0.3, EDGE, "ftlr"), wall)
    for near, far in ((EDGE, BRINK), (PITCH - BRINK, end)):
        patch.add(box(bank, near, far, _CROWN, CURB, 0.0, EDGE, "fu"), wall)
    owner, step = each(np.full(len(bank), _ARCHES * _STEPS))
    frame, span = bank[owner], (PITCH - 2.0 * BRINK) / _ARCHES
    arch, step = step // _STEPS, step % _STEPS
    t0, t1 = step / _STEPS, (step + 1) / _STEPS
    s0, s1 = (BRINK + span * (arch + t) for t in (t0, t1))
    y0, y1 = _arch(t0), _arch(t1)
    face = quads(frame, (s0, s1, s1, s0), (y0, y1, CURB, CURB), (EDGE,) * 4)
    patch.add(face, wall)
    vault = quads(frame, (s0, s1, s1, s0), (y0, y1, y1, y0), (0.0, 0.0, EDGE, EDGE))
    patch.add(vault, wall)
    owner, number = each(np.full(len(bank), _ARCHES - 1))
    middle = BRINK + span * (number + 1)
    pier = box(bank[owner], middle - 0.8, middle + 0.8, WATER - 1.0, -3.0, 0.0, EDGE + 0.2, "flr")
    patch.add(pier, wall)


def _arch(t: np.ndarray) -> np.ndarray:
    """Return the height of an arch, t from 0 to 1."""
    return _SPRING + (_CROWN - _SPRING) * (4.0 * t * (1.0 - t))


def add_wild_river(patch: Patchwork, tile: Frames) -> None:
    """Add the river between meadows."""
    patch.add(top(tile, BRINK, PITCH - BRINK, WATER, 0.0, PITCH), NUMBER["water"])
    for bank in (tile, _turned(tile)):
        patch.add(top(bank, 0.0, EDGE, -0.05, 0.0, PITCH), NUMBER["grass"])
        s, y, o = (EDGE, BRINK, BRINK, EDGE), (-0.05, WATER, WATER, -0.05), (PITCH, PITCH, 0.0, 0.0)
        patch.add(quads(bank, s, y, o), NUMBER["grass"])
