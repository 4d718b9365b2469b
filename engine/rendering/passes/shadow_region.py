"""The region of a directional light's map in which a picture looks up shadows.

In: the camera's view, the box around what casts or receives shadows, and the map's axes. Out: the
frustum of a narrow light that shines on what the camera sees; what lies outside throws no shadow
there. Sources: Sutherland and Hodgman 1974 (clipping); Williams et al. 2003 (light's view of what
is seen).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from operator import mul
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...base.linalg.single import Vector, cross, dot
from ...model.scene.lights import DirectionalLight, DirectLight
from ...model.scene.shadow_casting import shadow_reach
from .._view import View
from .shadow_views import ShadowViews

#: How much wider than the camera's the frustum is: samples lie where rounded corners put them.
_WIDER = 17.0 / 16.0
#: The share of a map's side by which rounded places may be off.
_SPARE = 1.0 / 64.0
#: A region of a greater share of what the map shows is not worth it.
_WORTH = 0.75

#: The faces of a box, by the numbers of its corners, of which the last coordinate changes first.
_FACES = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))

Point: TypeAlias = Sequence[float]
#: In a map's clip space.
Place: TypeAlias = tuple[float, float]
#: What a map shows in its clip space, as half-planes (see `_clip`).
_SQUARE = ((1.0, 0.0, 1.0), (-1.0, 0.0, 1.0), (0.0, 1.0, 1.0), (0.0, -1.0, 1.0))


class Lookups(NamedTuple):
    """The places at which a picture looks up a map.

    Attributes
    ----------
    view : View
    box : tuple of 2 tuples of 3 float
        Around everything that casts or receives shadows.
    margin : float
        How far around a sample a map is looked up, in the map's clip space.
    """

    view: View
    box: tuple[tuple[float, ...], ...]
    margin: float


def lookups_of(
    light: DirectLight, views: ShadowViews, view: View, bounds: NDArray[np.float64]
) -> list[Lookups | None]:
    """Return where a picture looks up each map of a light; None for anywhere.

    What soft shadows depend on is not only near their samples (R227).
    """
    if not isinstance(light, DirectionalLight) or light.shadow_softness > 0.0:
        return [None] * len(views.maps)
    box, reach = tuple(map(tuple, bounds.tolist())), shadow_reach(light)
    found: list[Lookups | None] = []
    for scale, _, _ in views.places:
        moved = abs(light.shadow_normal_bias) * scale + 1.25 * reach * math.sqrt(2.0)
        found.append(
            Lookups(view, box, 2.0 * (moved + math.sqrt(2.0) * reach) / views.size + 2.0 * _SPARE)
        )
    return found


def _clip(polygon: Sequence[Point], plane: Sequence[float]) -> list[Point]:
    """Return what a half-space leaves of a convex polygon: where (point, 1) times it is >= 0."""
    kept: list[Point] = []
    heights = [sum(map(mul, plane, (*corner, 1.0))) for corner in polygon]
    for k, (corner, height) in enumerate(zip(polygon, heights, strict=True)):
        before, low = polygon[k - 1], heights[k - 1]
        if (low < 0.0) != (height < 0.0):
            share = low / (low - height)
            kept.append([a + (b - a) * share for a, b in zip(before, corner, strict=True)])
        if height >= 0.0:
            kept.append(corner)
    return kept


def _centre(x: list[float], y: list[float], w: list[float]) -> list[float] | None:
    """Return the point through which a projection's rays go; None without perspective."""
    across, up, away = ((row[0], row[1], row[2]) for row in (x, y, w))
    crossed = cross(up, away), cross(away, across), cross(across, up)
    volume = dot(across, crossed[0])
    if volume == 0.0:
        return None
    rises = x[3], y[3], w[3]
    return [-dot(rises, parts) / volume for parts in zip(*crossed, strict=True)]


def _seen_corners(view: View, corners: Sequence[Point]) -> list[Point]:
    """Return points whose convex hull holds what the camera sees of a box."""
    x, y, _, w = view.clip_from_world.tolist()
    planes = [
        [_WIDER * part + sign * other for part, other in zip(w, row, strict=True)]
        for row in (x, y)
        for sign in (1.0, -1.0)
    ]
    points: list[Point] = []
    for numbers in _FACES:
        face: Sequence[Point] = [corners[number] for number in numbers]
        for plane in planes:
            face = _clip(face, plane)
        points += face
    eye = _centre(x, y, w)
    if eye is not None and all(
        low <= at <= high for low, at, high in zip(corners[0], eye, corners[-1], strict=True)
    ):
        points.append(eye)  # the frustum's only corner that no face has
    return points


def _area_of(corners: list[Place]) -> float:
    """Return twice the area of a convex polygon."""
    return sum(_area(corners[0], b, c) for b, c in itertools.pairwise(corners[1:]))


def _hull(points: list[Place]) -> list[Place]:
    """Return the corners of the convex hull, counter-clockwise."""
    corners: list[Place] = []
    for run in (sorted(set(points)), sorted(set(points), reverse=True)):
        half: list[Place] = []
        for point in run:
            while len(half) > 1 and _area(half[-2], half[-1], point) <= 0.0:
                half.pop()
            half.append(point)
        corners += half[:-1]
    return corners


def _shown(rows: list[list[float]], points: Sequence[Point]) -> list[Place]:
    """Return the corners of what a map shows of the convex hull of points."""
    hull: Sequence[Point] = _hull([_place(rows, point) for point in points])
    for plane in _SQUARE:
        hull = _clip(hull, plane)
    return _hull([(x, y) for x, y in hull])


def _place(rows: list[list[float]], point: Point) -> Place:
    """Return where a point is in a map's clip space."""
    x, y = (dot(row[:3], point) + row[3] for row in rows)
    return x, y


def _area(a: Place, b: Place, c: Place) -> float:
    """Return twice the area of a triangle, positive if it is counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _corner_beyond(a: Place, b: Place, c: Place, d: Place) -> Place | None:
    """Return where a convex polygon's edges ab and cd meet beyond edge bc, if they do."""
    rise, height = _area(a, b, d) - _area(a, b, c), _area(a, b, c)
    if rise <= 0.0:
        return None
    share = height / rise
    return c[0] + (c[0] - d[0]) * share, c[1] + (c[1] - d[1]) * share


def _quadrilateral(corners: list[Place]) -> list[Place] | None:
    """Return a quadrilateral around a convex polygon, if it has as many corners.

    Edge after edge is left out, always the one that adds the least area.
    """
    while len(corners) > 4:
        best = None
        for k in range(len(corners)):
            a, b, c, d = (corners[(k + i) % len(corners)] for i in range(4))
            beyond = _corner_beyond(a, b, c, d)
            if beyond is not None:
                added = _area(c, b, beyond)
                best = min(best, (added, k, beyond)) if best else (added, k, beyond)
        if best is None:
            return None
        _, k, beyond = best
        left_out = [(k + i) % len(corners) for i in (1, 2)]
        corners[left_out[0]] = beyond
        del corners[left_out[1]]
    return corners if len(corners) == 4 else None


def _half_planes(corners: list[Place], margin: float) -> list[Vector]:
    """Return a, b, c of each edge, with a*x + b*y + c >= 0 up to a margin outside."""
    found = []
    for (x, y), (next_x, next_y) in zip(corners, corners[1:] + corners[:1], strict=True):
        a, b = y - next_y, next_x - x
        found.append((a, b, margin * math.sqrt(a * a + b * b) - (a * x + b * y)))
    return found


def _determinant(a: Vector, b: Vector, c: Vector) -> float:
    return dot(a, cross(b, c))


def _frustum_of(sides: list[Vector]) -> list[list[float]]:
    """Return the rows x, y and w of the projection whose frustum four half-planes bound.

    Opposite sides become w + x and w - x, w + y and w - y, times factors by which both sums are
    the same 2w.
    """
    volumes = [abs(_determinant(*sides[:k], *sides[k + 1 :])) for k in range(4)]
    left, low, right, high = (
        [part * volume for part in side] for side, volume in zip(sides, volumes, strict=True)
    )
    return [
        [p - q for p, q in zip(left, right, strict=True)],
        [p - q for p, q in zip(low, high, strict=True)],
        [p + q for p, q in zip(left, right, strict=True)],
    ]


def region_of(lookups: Lookups, clip_from_world: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return the frustum of what may throw shadows on what a camera sees.

    Parameters
    ----------
    lookups : Lookups
    clip_from_world : (4, 4) float64
        That of the map, which has no perspective.

    Returns
    -------
    (4, 4) float64 or None
        As ``clip_from_world``; None if it would hold most of what the map shows.
    """
    view, box, margin = lookups
    rows = clip_from_world[:2].tolist()
    ends = list(itertools.product(*zip(*box, strict=True)))
    corners = _quadrilateral(_shown(rows, _seen_corners(view, ends)))
    if corners is None or not _area_of(corners) < _WORTH * _area_of(_shown(rows, ends)):
        return None
    across, down = clip_from_world[:2]
    found = np.zeros((4, 4))
    for row, (a, b, c) in zip((0, 1, 3), _frustum_of(_half_planes(corners, margin)), strict=True):
        found[row] = across * a + down * b
        found[row, 3] += c
    return found
