"""Roofs of houses: gables, hips, mansards with dormers, flat roofs; and chimneys.

In: a `Patchwork`, frames at the left end of the street fronts at the height of the eaves, widths,
all `plan.DEPTH` deep. Out: quads, and how many a house gets. A gable's triangle is a quad with a
corner in the middle of its base, so that neither of its two triangles is empty.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .frames import Frames, Lengths, box, each, front, left, quads, right, top
from .patchwork import Patchwork
from .plan import DEPTH
from .surfaces import NUMBER

GABLE, HIP, MANSARD, FLAT = range(4)
#: Quads of each kind of roof, without dormers and chimneys.
ROOF_QUADS = np.array([4, 4, 5, 18])
DORMER_QUADS, CHIMNEY_QUADS = 4, 5
_EAVES = 0.40
_DORMER_PITCH = 3.4


def dormers(kind: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Return the number of dormers of each roof."""
    return np.where(kind == MANSARD, (width / _DORMER_PITCH).astype(np.int64), 0)


def add_roofs(
    patch: Patchwork,
    frame: Frames,
    width: np.ndarray,
    kind: np.ndarray,
    cover: np.ndarray,
    wall: np.ndarray,
    pane: np.ndarray,
) -> None:
    """Add a roof to each house.

    Parameters
    ----------
    frame : Frames
        N, at the eaves.
    width, kind : (N,) arrays
        Metres; GABLE, HIP, MANSARD or FLAT.
    cover, wall, pane : (N,) arrays
        Material numbers of the roof, of the walls at its ends and of dormer windows.
    """
    for which, add in enumerate((_add_gables, _add_hips, _add_mansards, _add_flats)):
        chosen = np.flatnonzero(kind == which)
        add(patch, frame[chosen], width[chosen], cover[chosen], wall[chosen])
    owner, number = each(dormers(kind, width))
    middle = (number + 0.5) * (width / np.maximum(1, dormers(kind, width)))[owner]
    _add_dormers(patch, frame[owner], middle, cover[owner], pane[owner])


def _add_slopes(
    patch: Patchwork,
    frame: Frames,
    s: Sequence[Lengths],
    ridge: float,
    rise: float,
    cover: np.ndarray,
) -> None:
    """Add two slopes: from the eaves s[0]..s[1] up to a ridge s[2]..s[3], at ``ridge`` inward."""
    a, b, c, d = s
    y = (0.0, 0.0, rise, rise)
    patch.add(quads(frame, (a, b, d, c), y, (_EAVES, _EAVES, -ridge, -ridge)), cover)
    far = -DEPTH - _EAVES, ridge - DEPTH
    patch.add(quads(frame, (b, a, c, d), y, (far[0], far[0], far[1], far[1])), cover)


def _add_gables(
    patch: Patchwork, frame: Frames, width: np.ndarray, cover: np.ndarray, wall: np.ndarray
) -> None:
    rise = 4.2
    _add_slopes(patch, frame, (0.0, width, 0.0, width), DEPTH / 2, rise, cover)
    y = (0.0, 0.0, rise, 0.0)
    middle = -DEPTH / 2
    patch.add(quads(frame, (0.0,) * 4, y, (middle, 0.0, middle, -DEPTH)), wall)
    patch.add(quads(frame, (width,) * 4, y, (middle, -DEPTH, middle, 0.0)), wall)


def _add_hips(
    patch: Patchwork, frame: Frames, width: np.ndarray, cover: np.ndarray, wall: np.ndarray
) -> None:
    rise, inset = 3.8, np.minimum(4.5, width * 0.4)
    low, high = -_EAVES, width + _EAVES
    _add_slopes(patch, frame, (low, high, inset, width - inset), DEPTH / 2, rise, cover)
    y, middle = (0.0, 0.0, rise, 0.0), -DEPTH / 2
    near, far = _EAVES, -DEPTH - _EAVES
    patch.add(quads(frame, (low, low, inset, low), y, (middle, near, middle, far)), cover)
    apex = width - inset
    patch.add(quads(frame, (high, high, apex, high), y, (middle, far, middle, near)), cover)


def _add_mansards(
    patch: Patchwork, frame: Frames, width: np.ndarray, cover: np.ndarray, wall: np.ndarray
) -> None:
    rise, inset = 2.7, 1.2
    _add_slopes(patch, frame, (0.0, width, 0.0, width), inset, rise, cover)
    patch.add(top(frame, 0.0, width, rise, inset - DEPTH, -inset), NUMBER["roof gravel"])
    y = (0.0, 0.0, rise, rise)
    patch.add(quads(frame, (0.0,) * 4, y, (-DEPTH, 0.0, -inset, inset - DEPTH)), wall)
    patch.add(quads(frame, (width,) * 4, y, (0.0, -DEPTH, inset - DEPTH, -inset)), wall)


def _add_flats(
    patch: Patchwork, frame: Frames, width: np.ndarray, cover: np.ndarray, wall: np.ndarray
) -> None:
    """Add a flat roof behind parapets, with a hut on it."""
    patch.add(top(frame, 0.0, width, 0.0, -DEPTH, 0.0), NUMBER["roof gravel"])
    for o in (0.0, 0.3 - DEPTH):
        patch.add(box(frame, 0.0, width, 0.0, 0.8, o - 0.3, o, "ftb"), wall)
    for s in (0.0, width - 0.3):
        patch.add(box(frame, s, s + 0.3, 0.0, 0.8, 0.3 - DEPTH, -0.3, "ltr"), wall)
    hut = width * 0.35, width * 0.35 + 3.0, 0.0, 2.6, -8.5, -5.0
    patch.add(box(frame, *hut), NUMBER["concrete"])


def _add_dormers(
    patch: Patchwork, frame: Frames, middle: np.ndarray, cover: np.ndarray, pane: np.ndarray
) -> None:
    a, b, low, high, o = middle - 0.7, middle + 0.7, 0.45, 2.15, -0.12
    patch.add(front(frame, a, b, low, high, o), pane)
    patch.add(left(frame, a, low, high, -1.4, o), cover)
    patch.add(right(frame, b, low, high, -1.4, o), cover)
    patch.add(top(frame, a - 0.1, b + 0.1, high, -1.4, o + 0.1), cover)


def add_chimneys(
    patch: Patchwork, frame: Frames, s: np.ndarray, o: np.ndarray, height: np.ndarray
) -> None:
    """Add a chimney at s, o of each frame, ``height`` above the eaves."""
    brick = NUMBER["brick red"]
    patch.add(box(frame, s - 0.5, s + 0.5, 0.0, height, o - 0.35, o + 0.35), brick)
