"""Views of shadow maps: the projection of each map, and the lookup of samples in it.

In: a light, its pose, the box around the scene, and for directional lights the camera's view. Out:
`ShadowViews`: matrices to draw each map with (R95, R96 of docs/exactness), and the numbers by which
the core looks up samples in it (R92). These are float32, so the matrices are computed from the
rounded values. Sources for cascades: Zhang et al. 2006 (parallel-split shadow maps); Valient 2008
(spherical bounds that move by whole texels).
"""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.linalg.single import cross, dot, length, normalize
from ...model.scene.lights import AreaLight, DirectionalLight, PointLight, SpotLight
from ...model.scene.shadow_casting import (
    LEAST_MAP,
    MOST_MAP,
    shadow_margin,
    shadow_reach,
    widest_radius,
)
from .._view import View

_RATIO = 4.0  # each cascade reaches this many times as far as the one before
_PLAY = 1.0 / 8.0  # of a map's side: the step by which it follows the camera
_WIDEST = 10.0  # tangent of the widest angle of a spot light's map
_WIDEST_AHEAD = 4.0  # the same of an area light's, which gets 6 % of its light to what lies beyond
_NEAREST = 2.0**-12  # of the farthest: nearer objects cast no shadow of a point or spot light
#: Right, down and ahead.
Axes = Sequence[Sequence[float]]
#: The faces of a point light's cube, +x, -x, +y, -y, +z, -z.
_FACES: Sequence[Axes] = (
    ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0)),
    ((0.0, 0.0, -1.0), (0.0, -1.0, 0.0), (-1.0, 0.0, 0.0)),
    ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
    ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),
    ((-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)),
)


class MapView(NamedTuple):
    """The matrices to draw one map with."""

    clip_from_world: NDArray[np.float64]
    view_from_world: NDArray[np.float64]
    eye: tuple[float, float, float, float]


class ShadowViews(NamedTuple):
    """The maps of one light.

    Attributes
    ----------
    maps : list of MapView
    places : list of (float, float, float)
        Scale, x and y of `e3d_shadow_map`.
    axes : Axes
        For point lights those of the first map, which are not read.
    depth : (float, float)
    margin : int
    size : int
        Texels a side.
    """

    maps: list[MapView]
    places: list[tuple[float, float, float]]
    axes: Axes
    depth: tuple[float, float]
    margin: int
    size: int


def _single(value: float) -> float:
    return float(np.float32(value))


def _over(a: float, b: float) -> float:
    """Return a quotient as IEEE has it: for a camera whose projection collapses depths."""
    return a / b if b else float(np.divide(a, b))


def _scaled(v: Sequence[float], by: float) -> list[float]:
    return [part * by for part in v]


def _rounded_up(value: float, steps: int) -> float:
    """Round up to a few values per power of two, so that small changes usually have no effect."""
    if not value > 0.0:
        return 1.0
    mantissa, exponent = math.frexp(value)
    return math.ldexp(math.ceil(mantissa * 2 * steps) / (2 * steps), exponent)


def _axes_along(ahead: Sequence[float]) -> Axes:
    """Return unit vectors right, down and ahead, rounded to float32."""
    x, y, z = ahead
    up = (0.0, 0.0, 1.0) if abs(y) > 0.999 else (0.0, 1.0, 0.0)
    right = normalize(cross((x, y, z), up))
    down = cross((x, y, z), right)
    rounded: Axes = np.array([right, down, (x, y, z)], np.float32).tolist()
    return rounded


def _extent(axis: Sequence[float], bounds: NDArray[np.float64]) -> tuple[float, float]:
    """Return the extent of a box along an axis."""
    low, high = bounds.tolist()
    middle = dot(axis, [(a + b) * 0.5 for a, b in zip(low, high, strict=True)])
    reach = dot(
        [abs(part) for part in axis], [(b - a) * 0.5 for a, b in zip(low, high, strict=True)]
    )
    return middle - reach, middle + reach


def _view_of(axes: Axes, position: Sequence[float]) -> list[list[float]]:
    """Return view_from_world of an eye that looks ahead."""
    right, down, ahead = axes
    rows = list(right), [-part for part in down], [-part for part in ahead]
    return [[*row, -dot(row, position)] for row in rows] + [[0.0, 0.0, 0.0, 1.0]]


# Directional lights

#: A part of the view that is smaller, as a share of the scene, is a point: it has no map.
_LEAST_PART = 2.0**-40
#: Texels or depths a world unit, of scenes as small as the least numbers: what float32 holds.
_MOST_SCALE = 2.0**127


class _Square(NamedTuple):
    """The square that a map covers: texels per world unit, and its centre."""

    scale: float
    column: int
    row: int


def _square(side: float, middle: tuple[float, float], inside: int, play: float) -> _Square:
    """Return a square of a given side, snapped to the step, for a map with given inner texels."""
    scale = _single(min((inside - 1) / (side * (1.0 + play)), _MOST_SCALE))
    step = max(int(side * play * scale), 1)
    column, row = (round(at * scale / step) * step for at in middle)
    return _Square(scale, column, row)


class Slice(NamedTuple):
    """A part of the camera's view, between two depths.

    Attributes
    ----------
    end : float
        The farther depth.
    side : float
        Of a square around its sphere.
    middle : tuple of 3 float
        The sphere's centre.
    box : (2, 3) float64
        Its least and greatest world coordinates.
    """

    end: float
    side: float
    middle: tuple[float, ...]
    box: NDArray[np.float64]


class Sight(NamedTuple):
    """What the camera sees.

    Attributes
    ----------
    view : View
    slices : list of Slice
        Those in which something is, the nearest first.
    texels : float
        As many texels in a row show the last slice, if they are as wide as pixels at its end.
    beyond : float
        The depth up to which the map of the scene has to show as much; 0 for any depth.
    """

    view: View
    slices: list[Slice]
    texels: float
    beyond: float


def sight_of(view: View, bounds: NDArray[np.float64], count: int) -> Sight:
    """Return the parts of the camera's view that ``count - 1`` maps of their own may show.

    The depths are fractions of the scene's diagonal, so that they do not change when the camera
    moves. Anything farther is left to the map of the whole scene.
    """
    near, far = view.depth_range(bounds)
    reach = length(bounds[1] - bounds[0])
    ends = [reach * _RATIO ** (k - count) for k in range(1, count)]
    starts = [0.0, *ends[:-1]]
    if view.eye[3] == 0.0:  # without perspective, distant objects are not smaller
        starts, ends = [near], [near + _rounded_up(far - near, 1)]
    if count == 1 or reach == 0.0:
        return Sight(view, [], 0.0, 0.0)
    slices = _slices(view, list(zip(starts, ends, strict=False)))
    last = slices[-1]
    texels = last.side * view.pixels_at(last.end)
    return Sight(view, [one for one in slices if one.end >= near], texels, _RATIO * last.end)


def _slices(view: View, depths: list[tuple[float, float]]) -> list[Slice]:
    """Return the camera's view between pairs of depths."""
    world_from_view = linalg.inverse(view.view_from_world).tolist()[:3]
    found = []
    for end, points, middle, radius in _parts(view.projection.tobytes(), tuple(depths)):
        world, *around = (
            tuple(dot(row[:3], at) + row[3] for row in world_from_view) for at in (middle, *points)
        )
        sides = list(zip(*around, strict=True))
        box = np.array([[min(side) for side in sides], [max(side) for side in sides]])
        found.append(Slice(end, 2.0 * radius, world, box))
    return found


class _Part(NamedTuple):
    """A slice in view space: its farther depth, its corners, and a sphere around them."""

    end: float
    corners: list[list[float]]
    middle: list[float]
    radius: float


@functools.lru_cache(16)
def _parts(projection: bytes, depths: tuple[tuple[float, float], ...]) -> list[_Part]:
    """Return what a projection shows between pairs of depths, wherever the camera is."""
    view_from_clip = linalg.inverse(np.frombuffer(projection).reshape(4, 4)).tolist()
    places = [(x, y) for x in (-1.0, 1.0) for y in (-1.0, 1.0)]
    lines = [[_unproject(view_from_clip, x, y, z) for z in (-1.0, 0.0)] for x, y in places]
    found = []
    for start, end in depths:
        corners = [_at_depth(line, depth) for depth in (start, end) for line in lines]
        found.append(_Part(end, corners, *_sphere(corners)))
    return found


def _size_for(light: DirectionalLight, sight: Sight, whole: float) -> int:
    """Return the maps' side: where a map serves the farthest, its texels are as wide as pixels.

    It depends on no place of the camera, so that texels keep their width as it moves.
    """
    margin = shadow_margin(light)
    wanted = max(sight.texels, whole * sight.view.pixels_at(sight.beyond))
    texels = math.ceil(_rounded_up(min(wanted, MOST_MAP), 2)) + 2 * margin
    return max(min(texels, light.shadow_map_size), LEAST_MAP, 4 * margin)


def _unproject(view_from_clip: Axes, x: float, y: float, z: float) -> list[float]:
    *point, w = (dot(row[:3], (x, y, z)) + row[3] for row in view_from_clip)
    return [_over(part, w) for part in point]


def _at_depth(line: list[list[float]], depth: float) -> list[float]:
    """Return the point at a view-space depth on the line through two points."""
    first, second = line
    share = _over(-depth - first[2], second[2] - first[2])
    return [a + (b - a) * share for a, b in zip(first, second, strict=True)]


def _mean(points: list[list[float]]) -> list[float]:
    """Return the middle of four points."""
    return [(((0.0 + a) + b) + c + d) / 4.0 for a, b, c, d in zip(*points, strict=True)]


def _difference(a: Sequence[float], b: Sequence[float]) -> list[float]:
    return [one - other for one, other in zip(a, b, strict=True)]


def _sphere(points: list[list[float]]) -> tuple[list[float], float]:
    """Return centre and radius of a small sphere around four points and four others behind them."""
    front, back = _mean(points[:4]), _mean(points[4:])
    wide = [
        max(length(_difference(p, at)) for p in of)
        for of, at in ((points[:4], front), (points[4:], back))
    ]
    deep = length(_difference(back, front))
    square = deep * deep  # 0 of a part so thin that depths are no longer told apart
    share = (square + wide[1] ** 2 - wide[0] ** 2) / (2.0 * square) if square > 0.0 else 1.0
    share = max(min(share, 1.0), 0.0)
    middle = [a + (b - a) * share for a, b in zip(front, back, strict=True)]
    return middle, max(length(_difference(p, middle)) for p in points)


def _cascades(
    light: DirectionalLight,
    pose: tuple[Sequence[float], None],
    bounds: NDArray[np.float64],
    sight: Sight,
) -> ShadowViews:
    """Return the maps of a directional light.

    The last map covers the whole scene; each earlier one covers, if smaller, a sphere around a part
    of the camera's view, whichever way it looks. It moves by whole texels, so that edges do not
    flicker. Along the light it covers the whole scene.
    """
    axes = _axes_along(tuple(-part for part in pose[0]))
    margin = shadow_margin(light)
    sides, downs, depths = (_extent(axis, bounds) for axis in axes)
    told_apart = max(map(abs, depths)) * _LEAST_PART
    step = max(_rounded_up(depths[1] - depths[0], 1) / 32.0, told_apart)
    first, last = (
        (math.floor(depths[0] / step) - 1) * step,
        (math.ceil(depths[1] / step) + 1) * step,
    )
    rise = _single(min(2.0 / (last - first), _MOST_SCALE))
    depth = rise, _single(-1.0 - first * rise)
    whole = _rounded_up(max(sides[1] - sides[0], downs[1] - downs[0]), 8)
    size = _size_for(light, sight, whole)
    squares = []
    for one in sight.slices:
        if whole * _LEAST_PART < one.side < whole:
            at = dot(axes[0], one.middle), dot(axes[1], one.middle)
            squares.append(_square(one.side, at, size - 2 * margin, _PLAY))
    at = (sides[0] + sides[1]) * 0.5, (downs[0] + downs[1]) * 0.5
    squares.append(_square(whole, at, size - 2 * margin, 0.0))
    x, y, z = axes[2]
    eye = (-x, -y, -z, 0.0)
    view_from_world = np.array(_view_of(axes, (0.0, 0.0, 0.0)))
    maps, places = [], []
    for square in squares:
        scale = square.scale
        x, y = size / 2 - square.column, size / 2 - square.row
        clip = [
            [*_scaled(axes[0], 2.0 * scale / size), 2.0 * x / size - 1.0],
            [*_scaled(axes[1], -2.0 * scale / size), 1.0 - 2.0 * y / size],
            [*_scaled(axes[2], depth[0]), depth[1]],
            [0.0, 0.0, 0.0, 1.0],
        ]
        maps.append(MapView(np.array(clip), view_from_world, eye))
        places.append((scale, x, y))
    return ShadowViews(maps, places, axes, depth, margin, size)


# Lights with a position


def _between(
    light: PointLight | SpotLight | AreaLight, nearest: float, farthest: float
) -> tuple[float, float] | None:
    """Return the depth range that a map covers; None if it is empty."""
    farthest = min(_rounded_up(farthest, 4), light.range) if farthest > 0.0 else 0.0
    if not farthest > 0.0:
        return None
    nearest = math.ldexp(0.5, math.frexp(nearest)[1]) if nearest > 0.0 else 0.0
    return max(min(nearest, farthest * 0.5), farthest * _NEAREST), farthest


def _looks_from(
    position: Sequence[float],
    all_axes: Sequence[Axes],
    scale: float,
    size: int,
    depth: tuple[float, float],
) -> list[MapView]:
    maps = []
    for axes in all_axes:
        view_from_world = _view_of(axes, position)
        across, up, back, _ = view_from_world
        ahead = [-part for part in back]
        far = _scaled(ahead, depth[0])
        far[3] += depth[1]
        clip = [_scaled(across, 2.0 * scale / size), _scaled(up, 2.0 * scale / size), far, ahead]
        eye = (position[0], position[1], position[2], 1.0)
        maps.append(MapView(np.array(clip), np.array(view_from_world), eye))
    return maps


def _local_views(
    light: PointLight | SpotLight | AreaLight,
    position: Sequence[float],
    all_axes: Sequence[Axes],
    tangent: float,
    between: tuple[float, float],
) -> ShadowViews:
    size = light.shadow_map_size
    # Comparisons reach this many texels beyond, and slightly farther by rounding.
    margin = math.ceil(shadow_reach(light) + 0.5)
    if light.shadow_softness > 0.0:
        margin = math.ceil(1.16 * widest_radius(light) + 1.0)
    scale = _single((size / 2 - margin - 0.5) / tangent)
    near, far = between
    depth = _single((far + near) / (far - near)), _single(-2.0 * far * near / (far - near))
    at: list[float] = np.array(position, np.float32).tolist()
    maps = _looks_from(at, all_axes, scale, size, depth)
    places = [(scale, size / 2, size / 2)] * len(maps)
    return ShadowViews(maps, places, all_axes[0], depth, margin, size)


def _tangent(light: SpotLight | AreaLight, seen: list[list[float]]) -> float:
    """Return the tangent of the angle that a map covers: a cone, or the box whose corners are seen.

    Corners are given along the axes.
    """
    if isinstance(light, SpotLight):
        angle = light.outer_cone_angle
        cosine, sine = float(linalg.cos(angle)), float(linalg.sin(angle))
        return sine / cosine if sine < _WIDEST * cosine else _WIDEST
    if any(max(abs(x), abs(y)) >= _WIDEST_AHEAD * z for x, y, z in seen):
        return _WIDEST_AHEAD
    return min(_rounded_up(max(max(abs(x), abs(y)) / z for x, y, z in seen), 4), _WIDEST_AHEAD)


def _ahead(
    light: SpotLight | AreaLight,
    pose: tuple[Sequence[float], Sequence[float]],
    bounds: NDArray[np.float64],
    sight: None,
) -> ShadowViews | None:
    """Return the map of a light that shines ahead; None if nothing is in front of it."""
    to_light, position = pose
    axes = _axes_along(tuple(-part for part in to_light))
    here = dot(axes[2], position)
    nearest, farthest = (depth - here for depth in _extent(axes[2], bounds))
    between = _between(light, nearest, farthest)
    if between is None:
        return None
    corners = itertools.product(*(bounds[:, k].tolist() for k in range(3)))
    away = ([c - p for c, p in zip(corner, position, strict=True)] for corner in corners)
    seen = [[dot(axis, one) for axis in axes] for one in away]
    return _local_views(light, position, [axes], _tangent(light, seen), between)


def _cube(
    light: PointLight | AreaLight,
    pose: tuple[None, Sequence[float]],
    bounds: NDArray[np.float64],
    sight: None,
) -> ShadowViews | None:
    """Return the six maps around a light; None if nothing is there."""
    position = pose[1]
    low, high = np.asarray(position) - bounds[0], bounds[1] - np.asarray(position)
    farthest = float(max(low.max(), high.max()))
    nearest = -float(min(low.min(), high.min()))  # positive if the light is outside the box
    between = _between(light, nearest, farthest)
    if between is None:
        return None
    return _local_views(light, position, _FACES, 1.0, between)


#: The functions that place a light's maps, by layout (directional, spot or point); each takes
#: light, pose, scene box and, if the light is directional, what the camera sees.
VIEWS: dict[str, Callable[[Any, Any, NDArray[np.float64], Any], ShadowViews | None]] = {
    "cascades": _cascades,
    "cube": _cube,
    "ahead": _ahead,
}
