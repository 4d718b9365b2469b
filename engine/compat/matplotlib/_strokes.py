"""Lines of any width as triangles: joins, caps and dashes, as Agg draws them.

In: points of many polylines, *runs*, one after the other, in pixels. Out: triangles whose corners
are points, moved by multiples of half the width; so one outline serves lines and markers of all
sizes. Neighbouring quads share mitred ends, so that clear lines are not blended twice along a
curve.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

_ROUND_TURN = 0.5  # cosines below it: a turn gets a join of its own
_MITER_TURN = -0.75


class Stroke(NamedTuple):
    """Triangles along lines.

    Attributes
    ----------
    point : (V,) int
        The point that a corner belongs to.
    offset : (V, 2) float64
        Where the corner lies beside it, in half widths.
    triangles : (T, 3) int32
    """

    point: np.ndarray
    offset: np.ndarray
    triangles: np.ndarray


def stroke(places: np.ndarray, runs: np.ndarray, closed: np.ndarray, cap: str, join: str) -> Stroke:
    """Return the triangles of lines.

    Parameters
    ----------
    places : (P, 2) float64
        Pixels; neighbours of a run differ. A closed run ends with its first point.
    runs : (P,) int
        The run of each point, in order.
    closed : (P,) bool
        Whether a point's run is closed.
    cap : {"butt", "projecting", "round"}
    join : {"round", "miter", "bevel"}
    """
    if len(places) < 2:
        return Stroke(np.empty(0, int), np.empty((0, 2)), np.empty((0, 3), np.int32))
    goes_on = runs[1:] == runs[:-1]
    segment = np.flatnonzero(goes_on)
    along = places[segment + 1] - places[segment]
    along /= np.sqrt(along[:, 0] ** 2 + along[:, 1] ** 2)[:, None]
    normal = np.stack([-along[:, 1], along[:, 0]], 1)
    before, after = _neighbours(len(places), segment, runs, closed)
    has_both = (before >= 0) & (after >= 0)
    cosine = np.ones(len(places))
    cosine[has_both] = (normal[before[has_both]] * normal[after[has_both]]).sum(1)
    sharp = has_both & (cosine < (_MITER_TURN if join == "miter" else _ROUND_TURN))
    mild = has_both & ~sharp
    miter = np.zeros((len(places), 2))
    miter[mild] = (normal[before[mild]] + normal[after[mild]]) / (1.0 + cosine[mild])[:, None]
    parts = [_quads(segment, normal, along, mild, miter, before, after, cap)]
    turns = np.flatnonzero(sharp & _first_of_closed(runs, closed))
    if len(turns):
        parts.append(_joins(turns, normal[before[turns]], normal[after[turns]], join))
    if cap == "round":
        parts += _round_caps(normal, along, before, after)
    return _together(parts)


def _neighbours(count: int, segment: np.ndarray, runs: np.ndarray, closed: np.ndarray):
    """Return the segment before and after each point, -1 where there is none."""
    before, after = np.full(count, -1), np.full(count, -1)
    number = np.arange(len(segment))
    before[segment + 1] = number
    after[segment] = number
    first = np.flatnonzero(closed & (before < 0))
    last = np.flatnonzero(closed & (after < 0))
    keep = np.isin(runs[first], runs[last])
    first = first[keep]
    if len(first) == len(last):
        before[first], after[last] = before[last], after[first]
    return before, after


def _first_of_closed(runs: np.ndarray, closed: np.ndarray) -> np.ndarray:
    """Return whether a join is drawn at a point: a closed run has one where it ends and begins."""
    ends = np.append(runs[1:] != runs[:-1], True)
    return ~(closed & ends)


def _quads(segment, normal, along, mild, miter, before, after, cap) -> Stroke:
    count = len(segment)
    offset = np.empty((count, 4, 2))
    for at, points, others, way in ((0, segment, before, -1.0), (2, segment + 1, after, 1.0)):
        side = np.where(mild[points, None], miter[points], normal)
        push = np.zeros((count, 1))
        if cap == "projecting":
            push[others[points] < 0] = way
        offset[:, at] = side + push * along
        offset[:, at + 1] = push * along - side
    point = np.stack([segment, segment, segment + 1, segment + 1], 1)
    corner = 4 * np.arange(count, dtype=np.int32)[:, None, None]
    triangles = (corner + np.array([[0, 1, 2], [1, 3, 2]], np.int32)).reshape(-1, 3)
    return Stroke(point.ravel(), offset.reshape(-1, 2), triangles)


def _joins(points, incoming, outgoing, join: str) -> Stroke:
    """Fill the outer side of sharp turns."""
    cross = incoming[:, 0] * outgoing[:, 1] - incoming[:, 1] * outgoing[:, 0]
    side = np.where(cross > 0, -1.0, 1.0)[:, None]
    along = np.stack([incoming[:, 1], -incoming[:, 0]], 1)
    steps = 0 if join == "bevel" else 3
    return _fans(points, _arc(side * incoming, side * outgoing, along, steps))


def _round_caps(normal, along, before, after) -> list[Stroke]:
    first, last = (
        np.flatnonzero((before < 0) & (after >= 0)),
        np.flatnonzero((before >= 0) & (after < 0)),
    )
    a, b = after[first], before[last]
    return [
        _fans(first, _arc(normal[a], -normal[a], -along[a], 3)),
        _fans(last, _arc(normal[b], -normal[b], along[b], 3)),
    ]


def _arc(start: np.ndarray, end: np.ndarray, middle: np.ndarray, steps: int) -> np.ndarray:
    """Return directions from start to end, (N, 2**steps + 1, 2); middle: that of half turns."""
    directions = [start, end]
    for step in range(steps):
        finer = [directions[0]]
        for one, other in zip(directions[:-1], directions[1:], strict=True):
            half = one + other
            length = np.sqrt(half[:, 0] ** 2 + half[:, 1] ** 2)[:, None]
            half = np.where(
                length > 1e-3, half / np.maximum(length, 1e-3), middle if step == 0 else one
            )
            finer += [half, other]
        directions = finer
    return np.stack(directions, 1)


def _fans(points: np.ndarray, arc: np.ndarray) -> Stroke:
    count, corners = arc.shape[:2]
    offset = np.concatenate([np.zeros((count, 1, 2)), arc], 1)
    k = np.arange(1, corners, dtype=np.int32)
    fan = np.stack([np.zeros_like(k), k, k + 1], 1)
    first = (corners + 1) * np.arange(count, dtype=np.int32)[:, None, None]
    return Stroke(
        np.repeat(points, corners + 1), offset.reshape(-1, 2), (first + fan).reshape(-1, 3)
    )


def _together(parts: list[Stroke]) -> Stroke:
    starts = np.cumsum([0, *(len(part.point) for part in parts)])
    triangles = [
        part.triangles + np.int32(start) for part, start in zip(parts, starts[:-1], strict=True)
    ]
    return Stroke(
        np.concatenate([part.point for part in parts]),
        np.concatenate([part.offset for part in parts]),
        np.concatenate(triangles),
    )


def cut(places: np.ndarray, runs: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Leave out what is not finite, and points that repeat the one before.

    Returns the places, the runs, and the numbers of the points that are left; what was left out
    as not finite separates runs.
    """
    finite = np.isfinite(places).all(1)
    new = np.ones(len(places), bool)
    new[1:] = (runs[1:] != runs[:-1]) | ~finite[1:] | ~finite[:-1]
    runs = np.cumsum(new)
    kept = np.flatnonzero(finite)
    places, runs = places[kept], runs[kept]
    step = np.abs(places[1:, :2] - places[:-1, :2]).max(1, initial=0.0)
    differs = np.ones(len(places), bool)
    differs[1:] = (step > 1e-6) | (runs[1:] != runs[:-1])
    return places[differs], runs[differs], kept[differs]


def finer(
    places: np.ndarray, runs: np.ndarray, most: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cut segments into pieces of at most so many pixels; depths are linear on the screen.

    Returns places, runs, and the number of the point at which a piece begins.
    """
    if len(places) < 2:
        return places, runs, np.arange(len(places))
    step = places[1:] - places[:-1]
    length = np.sqrt(step[:, 0] ** 2 + step[:, 1] ** 2)
    pieces = np.clip(np.ceil(length / most), 1, 4096).astype(int)
    pieces[runs[1:] != runs[:-1]] = 1
    pieces = np.append(pieces, 1)
    source = np.repeat(np.arange(len(places)), pieces)
    part = np.arange(len(source)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    share = part / pieces[source]
    forward = np.append(step, np.zeros((1, places.shape[1])), 0)
    return places[source] + share[:, None] * forward[source], runs[source], source


def dashed(
    places: np.ndarray, runs: np.ndarray, pattern: np.ndarray, start: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cut runs into dashes.

    Parameters
    ----------
    places : (P, 3) float64
    runs : (P,) int
    pattern : (2 N,) float64
        Lengths of dashes and gaps, pixels.
    start : float
        How far into the pattern a run begins, pixels.

    Returns
    -------
    places, runs
        Of the dashes.
    source : (Q,) int
        The point from which each came, or at which its segment begins.
    """
    found: list[tuple[np.ndarray, np.ndarray]] = []
    borders = np.flatnonzero(np.diff(runs)) + 1
    for first, last in zip(np.append(0, borders), np.append(borders, len(runs)), strict=True):
        found += _dashes_of(places[first:last], int(first), pattern, start)
    if not found:
        return places[:0], runs[:0], np.empty(0, int)
    numbers = np.repeat(np.arange(len(found)), [len(one) for one, _ in found])
    return (
        np.concatenate([one for one, _ in found]),
        numbers,
        np.concatenate([source for _, source in found]),
    )


def _dashes_of(places, first: int, pattern, start: float) -> list[tuple[np.ndarray, np.ndarray]]:
    step = places[1:, :2] - places[:-1, :2]
    reach = np.append(0.0, np.cumsum(np.sqrt(step[:, 0] ** 2 + step[:, 1] ** 2)))
    period = pattern.sum()
    if len(places) < 2 or not period > 0:
        return []
    ends = np.cumsum(pattern)
    begins = np.append(0.0, ends[:-1])[::2]
    count = int(np.ceil((reach[-1] + start) / period)) + 1
    shift = period * np.arange(min(count, 100_000))[:, None] - start
    ons, offs = (shift + begins).ravel(), (shift + ends[::2]).ravel()
    found = []
    for on, off in zip(np.maximum(ons, 0.0), np.minimum(offs, reach[-1]), strict=True):
        if off > on:
            inner = np.flatnonzero((reach > on) & (reach < off))
            at = np.concatenate([[on], reach[inner], [off]])
            dash = np.stack([np.interp(at, reach, places[:, k]) for k in range(3)], 1)
            source = np.clip(np.searchsorted(reach, at, "right") - 1, 0, len(places) - 1)
            found.append((dash, first + source))
    return found
