"""Local frames for buildings: an origin on the ground, a direction to the right, and outward.

In: frames and arrays of lengths s (to the right), y (up) and o (outward), one number per quad.
Out: corners of quads (N, 4, 3) float64, counter-clockwise from the front. Facades, boxes, roofs and
bridges use these coordinates, independent of their orientation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

#: One length for all frames, or an array with one for each.
Lengths: TypeAlias = float | np.ndarray


@dataclass(frozen=True)
class Frames:
    """N frames: origins x, y, z and the direction (dx, dz) to the right, which has length 1.

    Outward is (-dz, dx), towards a viewer for whom right is on the right. Each is (N,) float64.
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    dx: np.ndarray
    dz: np.ndarray

    def __getitem__(self, index: np.ndarray) -> Frames:
        return Frames(self.x[index], self.y[index], self.z[index], self.dx[index], self.dz[index])

    def __len__(self) -> int:
        return len(self.x)


def frames(
    x: Lengths, z: Lengths, dx: Lengths = 1.0, dz: Lengths = 0.0, y: Lengths = 0.0
) -> Frames:
    """Return frames of numbers or arrays, broadcast against each other."""
    arrays = np.broadcast_arrays(*(np.atleast_1d(np.asarray(a, np.float64)) for a in (x, y, z)))
    count = len(arrays[0])
    way = (np.broadcast_to(np.asarray(a, np.float64), count) for a in (dx, dz))
    return Frames(*arrays, *way)


def quads(
    frame: Frames, s: Sequence[Lengths], y: Sequence[Lengths], o: Sequence[Lengths]
) -> np.ndarray:
    """Return quads of given corners: s, y, o each four numbers or arrays."""
    count = len(frame)
    corners = np.empty((count, 4, 3))
    for k in range(4):
        corners[:, k, 0] = frame.x + frame.dx * s[k] - frame.dz * o[k]
        corners[:, k, 1] = frame.y + y[k]
        corners[:, k, 2] = frame.z + frame.dz * s[k] + frame.dx * o[k]
    return corners


def front(
    frame: Frames, s0: Lengths, s1: Lengths, y0: Lengths, y1: Lengths, o: Lengths
) -> np.ndarray:
    """Return upright quads, seen from outside."""
    return quads(frame, (s0, s1, s1, s0), (y0, y0, y1, y1), (o, o, o, o))


def back(
    frame: Frames, s0: Lengths, s1: Lengths, y0: Lengths, y1: Lengths, o: Lengths
) -> np.ndarray:
    """Return upright quads, seen from behind."""
    return quads(frame, (s1, s0, s0, s1), (y0, y0, y1, y1), (o, o, o, o))


def top(
    frame: Frames, s0: Lengths, s1: Lengths, y: Lengths, o0: Lengths, o1: Lengths
) -> np.ndarray:
    """Return level quads, seen from above; o0 is farther in than o1."""
    return quads(frame, (s0, s1, s1, s0), (y, y, y, y), (o1, o1, o0, o0))


def bottom(
    frame: Frames, s0: Lengths, s1: Lengths, y: Lengths, o0: Lengths, o1: Lengths
) -> np.ndarray:
    """Return level quads, seen from below."""
    return quads(frame, (s0, s1, s1, s0), (y, y, y, y), (o0, o0, o1, o1))


def left(
    frame: Frames, s: Lengths, y0: Lengths, y1: Lengths, o0: Lengths, o1: Lengths
) -> np.ndarray:
    """Return upright quads across the frame, seen from the left."""
    return quads(frame, (s, s, s, s), (y0, y0, y1, y1), (o0, o1, o1, o0))


def right(
    frame: Frames, s: Lengths, y0: Lengths, y1: Lengths, o0: Lengths, o1: Lengths
) -> np.ndarray:
    """Return upright quads across the frame, seen from the right."""
    return quads(frame, (s, s, s, s), (y0, y0, y1, y1), (o1, o0, o0, o1))


def box(
    frame: Frames,
    s0: Lengths,
    s1: Lengths,
    y0: Lengths,
    y1: Lengths,
    o0: Lengths,
    o1: Lengths,
    sides: str = "ftlrb",
) -> np.ndarray:
    """Return sides of boxes by kind: front, top, left, right, back, underside (u)."""
    made = {
        "f": lambda: front(frame, s0, s1, y0, y1, o1),
        "b": lambda: back(frame, s0, s1, y0, y1, o0),
        "t": lambda: top(frame, s0, s1, y1, o0, o1),
        "u": lambda: bottom(frame, s0, s1, y0, o0, o1),
        "l": lambda: left(frame, s0, y0, y1, o0, o1),
        "r": lambda: right(frame, s1, y0, y1, o0, o1),
    }
    return np.concatenate([made[side]() for side in sides])


def each(counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return, for counts (N,), the owner of each item, and its number within the owner."""
    owner = np.repeat(np.arange(len(counts)), counts)
    return owner, np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
