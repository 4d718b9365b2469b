"""Markers: a path, drawn once as triangles, then moved to many places at its own size.

In: a path, sizes, colours and widths of edges. Out: triangles that face the reader, as deep as the
marker's place.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from matplotlib.path import Path

from ...io.reading.triangulation import triangulate
from ._outlines import outlines_of
from ._pile import Pile
from ._strokes import Stroke, stroke
from ._view import View


class _Shape(NamedTuple):
    """Triangles of a marker of size 1: corners, offsets in half widths of the edge, triangles."""

    corner: np.ndarray
    offset: np.ndarray
    triangles: np.ndarray


class Shapes(NamedTuple):
    """A marker of size 1: its inside, its inside and edge in one, its edge alone."""

    fill: _Shape
    whole: _Shape
    edge: _Shape


def shapes_of(path, transform, pixels: float, cap: str, join: str) -> Shapes:
    """Return the triangles of a marker whose largest size is so many pixels."""
    vertices = transform.transform(path.vertices)
    reach = np.abs(vertices).max(initial=0.0) * pixels
    steps = int(np.clip(np.ceil(np.sqrt(reach / 2)), 1, 8))
    codes = None if path.codes is None else path.codes.tobytes()
    return _shapes(vertices.tobytes(), codes, steps, cap, join)


@lru_cache(maxsize=64)
def _shapes(places: bytes, path_codes: bytes | None, steps: int, cap: str, join: str) -> Shapes:
    vertices = np.frombuffer(places, float).reshape(-1, 2)
    codes = None if path_codes is None else np.frombuffer(path_codes, Path.code_type)
    outlines = outlines_of(vertices * (1.0, -1.0), codes, steps)
    fills, wholes, edges = [], [], []
    for points, is_closed in outlines:
        line = np.append(points, points[:1], 0) if is_closed else points
        differs = np.append(True, np.abs(np.diff(line, axis=0)).max(1, initial=0.0) > 1e-9)
        line = line[differs]
        if len(line) < 2:
            continue
        runs = np.zeros(len(line), int)
        edge = stroke(line, runs, np.full(len(line), is_closed), cap, join)
        edges.append(_Shape(line[edge.point], edge.offset, edge.triangles))
        corners = line[:-1] if is_closed else line
        if len(corners) > 2:
            triangles = _inside(corners)
            fills.append(_Shape(corners, np.zeros_like(corners), triangles))
            wholes.append(_Shape(corners, _outward(corners), triangles))
    return Shapes(_joined(fills), _joined(wholes), _joined(edges))


def _inside(corners: np.ndarray) -> np.ndarray:
    flat = np.append(corners, np.zeros((len(corners), 1)), 1)
    return triangulate(np.array([len(corners)]), flat).corners


def _outward(corners: np.ndarray) -> np.ndarray:
    """Return how corners move when the polygon grows by a half width."""
    following = np.roll(corners, -1, 0)
    area = (corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]).sum()
    step = following - corners
    step /= np.sqrt(step[:, 0] ** 2 + step[:, 1] ** 2)[:, None]
    normal = np.stack([step[:, 1], -step[:, 0]], 1) * (1.0 if area > 0 else -1.0)
    before = np.roll(normal, 1, 0)
    cosine = (normal * before).sum(1)
    return (normal + before) / np.maximum(1.0 + cosine, 0.5)[:, None]


def _joined(shapes: list[_Shape]) -> _Shape:
    if not shapes:
        return _Shape(np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 3), np.int32))
    starts = np.cumsum([0, *(len(one.corner) for one in shapes)])
    return _Shape(
        np.concatenate([one.corner for one in shapes]),
        np.concatenate([one.offset for one in shapes]),
        np.concatenate(
            [one.triangles + np.int32(k) for one, k in zip(shapes, starts[:-1], strict=True)]
        ),
    )


def draw_markers(
    pile: Pile,
    view: View,
    shapes: Shapes,
    places: np.ndarray,
    sizes: np.ndarray,
    widths: np.ndarray,
    faces: np.ndarray,
    edges: np.ndarray,
) -> None:
    """Add markers to a pile.

    Parameters
    ----------
    places : (N, 3) float64
        On the screen, in the order of painting.
    sizes, widths : (N,) float
        Of the markers and of the lines round them, pixels.
    faces, edges : (N, 4) uint8
    """
    sizes, widths = np.broadcast_to(sizes, len(places)), np.broadcast_to(widths, len(places))
    radii = sizes * 0.5 + widths * 0.5
    places = pile.lifted(places, radii)
    has_edge = (edges[:, 3] > 0) & (widths > 0)
    # An edge of the same colour makes a marker larger; a clear one is blended once.
    is_whole = has_edge & (faces == edges).all(1) & (len(shapes.fill.corner) > 0)
    has_face = (faces[:, 3] > 0) & ~is_whole
    # The first of equal depth is in front.
    for shape, shown, colors in (
        (shapes.edge, has_edge & ~is_whole, edges),
        (shapes.whole, is_whole, faces),
        (shapes.fill, has_face, faces),
    ):
        if shown.any() and len(shape.corner):
            everywhere = shown.all()
            pick = slice(None) if everywhere else shown
            _put(pile, shape, places[pick], sizes[pick], widths[pick], colors[pick])


def _put(pile: Pile, shape: _Shape, places, sizes, widths, colors) -> None:
    corners = len(shape.corner)
    out = np.empty((len(places), corners, 3))
    for k in (0, 1):
        np.multiply.outer(sizes, shape.corner[:, k], out=out[..., k])
        if shape.offset.any():
            out[..., k] += np.multiply.outer(0.5 * widths, shape.offset[:, k])
        out[..., k] += places[:, k, None]
    out[..., 2] = places[:, 2, None]
    first = corners * np.arange(len(places), dtype=np.int32)[::-1, None, None]
    pile.add(
        out.reshape(-1, 3), np.repeat(colors, corners, 0), (first + shape.triangles).reshape(-1, 3)
    )


def edge_of(stroked: Stroke, places: np.ndarray, half_width: np.ndarray) -> np.ndarray:
    """Return the corners of a stroke on the screen, (V, 3)."""
    corners = places[stroked.point]
    corners[:, :2] += stroked.offset * half_width[stroked.point, None]
    return corners
