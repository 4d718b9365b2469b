"""Outlines of paths as points: curves evaluated, subpaths apart.

In: a matplotlib path. Out: its subpaths as arrays of points, and whether each is closed.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.path import Path


class Outline(NamedTuple):
    """A subpath: its points, and whether its end is its beginning."""

    points: np.ndarray
    is_closed: bool


def outlines_of(vertices: np.ndarray, codes: np.ndarray | None, steps: int) -> list[Outline]:
    """Return the subpaths of a path of any dimension.

    Parameters
    ----------
    vertices : (N, D) float
    codes : (N,) int or None
        `Path.codes`.
    steps : int
        Pieces that a curve is cut into.
    """
    if codes is None:
        return [Outline(vertices, False)] if len(vertices) else []
    found: list[Outline] = []
    points: list[np.ndarray] = []
    k = 0
    while k < len(codes):
        code, size = int(codes[k]), int(Path.NUM_VERTICES_FOR_CODE.get(codes[k], 1))
        if code == Path.STOP:
            break
        if code == Path.CLOSEPOLY:
            _end(found, points, True)
        elif code == Path.MOVETO or not points:
            _end(found, points, False)
            points = [vertices[k]]
        else:
            points += _curve(points[-1], vertices[k : k + size], steps)
        if code == Path.CLOSEPOLY:
            points = []
        k += size
    _end(found, points, False)
    return found


def _end(found: list[Outline], points: list[np.ndarray], is_closed: bool) -> None:
    if len(points) > 1:
        if is_closed and (points[0] == points[-1]).all():
            points = points[:-1]
        found.append(Outline(np.array(points, float), is_closed))


def _curve(start: np.ndarray, controls: np.ndarray, steps: int) -> list[np.ndarray]:
    """Return the points after the start, by de Casteljau."""
    if len(controls) == 1:
        return [controls[0]]
    found = []
    for step in range(1, steps + 1):
        t, row = step / steps, [start, *controls]
        while len(row) > 1:
            row = [a + t * (b - a) for a, b in zip(row[:-1], row[1:], strict=True)]
        found.append(row[0])
    return found


def has_curves(codes: np.ndarray | None) -> bool:
    return codes is not None and bool(np.isin(codes, (Path.CURVE3, Path.CURVE4)).any())
