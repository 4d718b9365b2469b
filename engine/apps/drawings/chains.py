"""Chains pieces of lines into polylines, so that dashes run through and files are small.

In: segments on paper. Out: polylines through them, in whole thousandths of a millimetre. At a point
where more than two segments meet, a polyline goes straight on, or ends.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

#: Places on paper are multiples of this part of a millimetre.
STEPS = 1000
#: Cosine of the largest turn at a point where more than two segments meet.
_STRAIGHT = 0.9


def chained(ends: NDArray[np.float64]) -> list[list[tuple[int, int]]]:
    """Return polylines through segments (N, 2, 2) in millimetres, in `STEPS` of these.

    Closed ones end where they begin. Segments shorter than a step are left out.
    """
    steps = np.rint(ends * STEPS).astype(np.int64)
    steps = steps[(steps[:, 0] != steps[:, 1]).any(axis=1)]
    if not len(steps):
        return []
    places, numbers = np.unique(steps.reshape(-1, 2), axis=0, return_inverse=True)
    graph = _Graph([(x, y) for x, y in places.tolist()], numbers.reshape(-1, 2).tolist())
    return [_without_needless(line) for line in graph.polylines()]


class _Graph:
    """Points joined by segments, each of which is taken once."""

    def __init__(self, places: list[tuple[int, int]], segments: list[list[int]]) -> None:
        self._places, self._segments = places, segments
        self._free = [True] * len(segments)
        self._at: list[list[int]] = [[] for _ in places]
        for number, (first, second) in enumerate(segments):
            self._at[first].append(number)
            self._at[second].append(number)

    def polylines(self) -> Iterator[list[tuple[int, int]]]:
        """Yield the polylines; those with ends begin at their first one."""
        ends = (number for number, at in enumerate(self._at) if len(at) != 2)
        for point in (*ends, *range(len(self._places))):
            for segment in self._at[point]:
                if self._free[segment]:
                    yield self._follow(point, segment)

    def _follow(self, start: int, segment: int) -> list[tuple[int, int]]:
        backward = self._walk(start, segment)
        forward = self._next(start, backward[1]) if len(self._at[start]) > 2 else None
        if forward is not None and backward[0] != backward[-1]:
            backward = self._walk(start, forward)[:0:-1] + backward
        return [self._places[point] for point in backward]

    def _walk(self, point: int, segment: int | None) -> list[int]:
        points = [point]
        while segment is not None:
            self._free[segment] = False
            first, second = self._segments[segment]
            before, point = point, second if point == first else first
            points.append(point)
            segment = self._next(point, before)
        return points

    def _next(self, point: int, before: int) -> int | None:
        """Return the free segment that goes on from a point as one came to it."""
        free = [number for number in self._at[point] if self._free[number]]
        if len(self._at[point]) <= 2:
            return free[0] if free else None
        x, y = self._places[point]
        way = x - self._places[before][0], y - self._places[before][1]
        found, straightest = None, _STRAIGHT
        for number in free:
            first, second = self._segments[number]
            other = self._places[second if point == first else first]
            cosine = _cosine(way, (other[0] - x, other[1] - y))
            if cosine > straightest:
                found, straightest = number, cosine
        return found


def _cosine(a: tuple[int, int], b: tuple[int, int]) -> float:
    squares = (a[0] * a[0] + a[1] * a[1]) * (b[0] * b[0] + b[1] * b[1])
    cosine: float = (a[0] * b[0] + a[1] * b[1]) / squares**0.5
    return cosine


def _without_needless(line: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return a polyline without points exactly on the way from one to another."""
    kept = line[:1]
    for here, after in zip(line[1:], line[2:], strict=False):
        ax, ay = here[0] - kept[-1][0], here[1] - kept[-1][1]
        bx, by = after[0] - here[0], after[1] - here[1]
        if ax * by != ay * bx or ax * bx + ay * by < 0:
            kept.append(here)
    return [*kept, line[-1]]
