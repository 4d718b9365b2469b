"""Lines: Line3D with its markers, Line3DCollection, the edges of polygons and paths.

In: artists and the view. Out: triangles in the pile.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib import cbook
from matplotlib import colors as mcolors
from matplotlib import lines as mlines
from matplotlib.path import Path
from matplotlib.transforms import IdentityTransform
from mpl_toolkits.mplot3d import proj3d

from ._colors import codes_of, cycled
from ._limits import shown_points
from ._markers import draw_markers, edge_of, shapes_of
from ._pile import Pile
from ._resting import MOST_LIFT
from ._strokes import cut, dashed, finer, stroke
from ._view import View

# Pixels: pieces are no longer where it is found out whether they lie on a surface.
_EDGE_STEP, _LINE_STEP = 4.0, 8.0
_GAP = 1e-5  # of the scene's depth: how far the colour of gaps lies behind dashes


class Pen(NamedTuple):
    """How lines are drawn: dashes in points, as matplotlib scales them."""

    cap: str = "butt"
    join: str = "round"
    start: float = 0.0
    dashes: tuple[float, ...] | None = None
    of_faces: bool = False


def draw_lines(
    pile: Pile,
    view: View,
    places: np.ndarray,
    runs: np.ndarray,
    widths: np.ndarray,
    colors: np.ndarray,
    pen: Pen,
) -> None:
    """Add lines to a pile.

    Parameters
    ----------
    places : (P, 3) float64
        On the screen; what is not finite interrupts a run.
    runs : (P,) int
        In the order of painting.
    widths : (P,) float
        Of each point's run, pixels.
    colors : (P, 4) uint8
        Of each point's run.
    """
    shown = (widths > 0) & (colors[:, 3] > 0)
    if not shown.all():
        places, runs, widths, colors = places[shown], runs[shown], widths[shown], colors[shown]
    closes = _closes(places, runs)
    places, runs, source = cut(places, runs)
    widths, colors, closes = widths[source], colors[source], closes[source]
    if pen.dashes is not None:
        pattern = np.array(pen.dashes, float) * view.points_to_pixels
        places, runs, source = dashed(places, runs, pattern, pen.start * view.points_to_pixels)
        widths, colors, closes = widths[source], colors[source], np.zeros(len(source), bool)
        places, runs, source = cut(places, runs)
        widths, colors, closes = widths[source], colors[source], closes[source]
    if pile.has_surfaces:
        places, runs, source = finer(places, runs, _EDGE_STEP if pen.of_faces else _LINE_STEP)
        widths, colors, closes = widths[source], colors[source], closes[source]
    if len(places) < 2:
        return
    lift = pile.lifted_edges if pen.of_faces else pile.lifted_lines
    places = lift(places, runs, 0.5 * widths)
    stroked = stroke(places[:, :2], runs, closes, pen.cap, pen.join)
    corners = edge_of(stroked, places, 0.5 * widths)
    pile.add(corners, colors[stroked.point], stroked.triangles[::-1])


def _add_to_waiting(pile: Pile, places, width: float, color: np.ndarray, pen: Pen) -> None:
    """Let a line wait for others of its pen, so that programs of a thousand lines stay fast."""
    places = places.copy()
    places[:, 2] -= pile.rank
    part = places, np.full(len(places), width), np.broadcast_to(color, (len(places), 4))
    pile.waiting.setdefault(pen, []).append((pile.artist, part))


def draw_waiting(pile: Pile, view: View) -> None:
    """Draw all lines that wait."""
    for pen, parts in pile.waiting.items():
        pile.begin(parts[-1][0], is_on_faces=True, is_ranked=True)
        places, widths, colors = (
            np.concatenate(one) for one in zip(*(part for _, part in parts), strict=True)
        )
        runs = np.repeat(np.arange(len(parts)), [len(part[0]) for _, part in parts])
        draw_lines(pile, view, places, runs, widths, colors, pen)
    pile.waiting = {}


def _closes(places: np.ndarray, runs: np.ndarray) -> np.ndarray:
    """Return whether the run of each point ends where it begins."""
    if not len(runs):
        return np.zeros(0, bool)
    starts = np.append(0, np.flatnonzero(np.diff(runs)) + 1)
    sizes = np.diff(np.append(starts, len(runs)))
    same = (places[starts] == places[starts + sizes - 1]).all(1) & (sizes > 2)
    broken = np.add.reduceat(~np.isfinite(places).all(1), starts) > 0
    return np.repeat(same & ~broken, sizes)


def points_of(line) -> np.ndarray:
    """Return the points of a Line3D, (N, 3); masked ones are not a number."""
    xyz = [np.ma.filled(np.ma.asarray(one, float), np.nan) for one in line.get_data_3d()]
    return np.stack(np.broadcast_arrays(*xyz), -1)


def draw_line(pile: Pile, view: View, line) -> None:
    """Add a Line3D; its markers lie on it."""
    points = shown_points(points_of(line), line)
    places = view.screen(points)
    has_line = line.get_linestyle() not in ("None", "none", " ", "") and line.get_linewidth() > 0
    radius = 0.5 * line.get_markersize() * view.points_to_pixels
    _draw_markers_of(pile, view, line, _before_line(view, places, radius) if has_line else places)
    if not has_line:
        return
    width = line.get_linewidth() * view.points_to_pixels
    start, dashes = line._dash_pattern
    if dashes is None:
        pen = Pen(_word(line.get_solid_capstyle()), _word(line.get_solid_joinstyle()))
    else:
        cap, join = line.get_dash_capstyle(), line.get_dash_joinstyle()
        pen = Pen(_word(cap), _word(join), start, tuple(dashes))
        if line.get_gapcolor() is not None:
            color = codes_of(line.get_gapcolor(), line.get_alpha())
            behind = places + (0.0, 0.0, _GAP * view.span)
            _add_to_waiting(pile, behind, width, color, Pen(join=pen.join))
    color = codes_of(line.get_color(), line.get_alpha())
    _add_to_waiting(pile, places, width, color, pen)


def _before_line(view: View, places: np.ndarray, radius: float) -> np.ndarray:
    """Return the places of markers before their own line, as far as it comes nearer within them."""
    step = np.abs(np.diff(places, axis=0))
    with np.errstate(all="ignore"):
        steep = step[:, 2] / np.sqrt(step[:, 0] ** 2 + step[:, 1] ** 2)
    nearer = np.nan_to_num(np.minimum(steep * radius, step[:, 2]), nan=0.0)
    lift = np.maximum(np.append(nearer, 0.0), np.append(0.0, nearer))
    out = places.copy()
    out[:, 2] -= np.minimum(lift, MOST_LIFT * view.span)
    return out


def _draw_markers_of(pile: Pile, view: View, line, places: np.ndarray) -> None:
    marker = line._marker
    if (
        not marker
        or not line.get_markersize() > 0
        or marker.get_marker() in ("None", "none", " ", "", None)
    ):
        return
    places = _every(line, places)
    places = places[np.isfinite(places).all(1)]
    if not len(places):
        return
    alpha = line.get_alpha()
    face = mcolors.to_rgba(line._get_markerfacecolor(), alpha)
    other = mcolors.to_rgba(line._get_markerfacecolor(alt=True), alpha)
    edge = mcolors.to_rgba(line.get_markeredgecolor(), alpha)
    if cbook._str_equal(line._markeredgecolor, "auto") and not cbook._str_lower_equal(
        line.get_markerfacecolor(), "none"
    ):
        edge = (*edge[:3], face[3])
    is_pixel = marker.get_marker() == ","
    size = 1.0 if is_pixel else line.get_markersize() * view.points_to_pixels
    width = 0.0 if is_pixel else line.get_markeredgewidth() * view.points_to_pixels
    halves = [(marker.get_path(), marker.get_transform(), face)]
    if marker.get_alt_path():
        halves.append((marker.get_alt_path(), marker.get_alt_transform(), other))
    cap, join = _word(marker.get_capstyle()), _word(marker.get_joinstyle())
    for path, transform, color in reversed(halves):
        shapes = shapes_of(path, transform, size, cap, join)
        faces, edges = (cycled(codes_of([one]), len(places)) for one in (color, edge))
        draw_markers(pile, view, shapes, places, np.array(size), np.array(width), faces, edges)


def _word(style) -> str:
    """Return the name of a cap or join, which may be an enumeration."""
    return str(getattr(style, "value", style))


def _every(line, places: np.ndarray) -> np.ndarray:
    """Return the places that get a marker."""
    every = line.get_markevery()
    if every is None:
        return places
    path = mlines._mark_every_path(every, Path(places[:, :2]), IdentityTransform(), line.axes)
    chosen = {tuple(row) for row in path.vertices.tolist()}
    return places[[tuple(row) in chosen for row in places[:, :2].tolist()]]


def draw_line_collection(pile: Pile, view: View, collection) -> None:
    """Add a Line3DCollection."""
    segments = collection._segments3d
    sizes = np.fromiter(map(len, segments), int, len(segments))
    if not sizes.sum():
        return
    parts = [
        np.ma.filled(np.ma.asarray(one, float), np.nan) if np.ma.isMA(one) else one
        for one in segments
    ]
    points = shown_points(np.concatenate(parts).astype(float).reshape(-1, 3), collection)
    collection.update_scalarmappable()
    draw_runs(
        pile, view, view.screen(points), sizes, collection, codes_of(collection.get_edgecolor())
    )


def draw_runs(
    pile: Pile,
    view: View,
    places: np.ndarray,
    sizes: np.ndarray,
    collection,
    colors: np.ndarray,
    of_faces: bool = False,
) -> None:
    """Add runs of given sizes and colours, with a collection's widths and dashes."""
    number = np.repeat(np.arange(len(sizes)), sizes)
    widths = (
        cycled(np.asarray(collection.get_linewidth(), float).reshape(-1), len(sizes))
        * view.points_to_pixels
    )
    colors = cycled(colors, len(sizes))
    cap, join = collection.get_capstyle() or "butt", collection.get_joinstyle() or "round"
    styles = collection._linestyles
    for k, (start, dashes) in reversed(list(enumerate(styles))):
        pick = slice(None) if len(styles) == 1 else number % len(styles) == k
        pen = Pen(
            _word(cap), _word(join), start, None if dashes is None else tuple(dashes), of_faces
        )
        of = number[pick]
        draw_lines(pile, view, places[pick], of, widths[of], colors[of], pen)


def project_line(line) -> None:
    """Give a line its places on the page, so that it can be picked."""
    points = shown_points(points_of(line), line)
    if len(points):
        xs, ys, _, _ = proj3d._scale_proj_transform_clip(*points.T, line.axes)
        line.set_data(xs, ys)
