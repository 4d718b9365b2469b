"""Paths: contours, patches, scatter.

In: artists and the view. Out: triangles, or rectangles of pixels, in the pile.
"""

from __future__ import annotations

import numpy as np
from matplotlib import colors as mcolors

from ...io.reading.triangulation import triangulate
from ._colors import codes_of, cycled
from ._limits import shown_points
from ._lines import Pen, draw_lines, draw_runs
from ._markers import draw_markers, shapes_of
from ._outlines import Outline, has_curves, outlines_of
from ._pile import Pile
from ._polygons import is_plain
from ._sheets import FlatPath, Painter, draw_paths
from ._view import View

_STEPS = 8  # pieces of a curve


def draw_contours(pile: Pile, view: View, collection, painter: Painter) -> None:
    """Add a Collection3D: contour lines, or the areas between them."""
    collection.update_scalarmappable()
    paths = collection._3dverts_codes
    faces = cycled(np.asarray(collection.get_facecolor(), float).reshape(-1, 4), len(paths))
    edges = cycled(codes_of(collection.get_edgecolor()), len(paths))
    lines: list[np.ndarray] = []
    owners: list[int] = []
    has_lines = edges[:, 3].any() and np.any(collection.get_linewidth())
    for k, (vertices, codes) in enumerate(paths if has_lines else ()):
        places = view.screen(shown_points(np.asarray(vertices, float), collection))
        lines += [_ring(one) for one in outlines_of(places, codes, _STEPS)]
        owners += [k] * (len(lines) - len(owners))
    if lines:
        sizes = np.array([len(one) for one in lines])
        draw_runs(pile, view, np.concatenate(lines), sizes, collection, edges[owners])
    filled = [k for k, (vertices, _) in enumerate(paths) if faces[k, 3] > 0 and len(vertices)]
    sheets = [
        FlatPath(
            view.screen(shown_points(np.asarray(paths[k][0], float), collection)),
            paths[k][1],
            faces[k],
        )
        for k in filled
    ]
    if filled and _share_a_plane([paths[k][0] for k in filled]):
        draw_paths(pile, view, painter, sheets)
        return
    for sheet in reversed(sheets):
        draw_paths(pile, view, painter, [sheet])


def _share_a_plane(parts: list[np.ndarray]) -> bool:
    """Return whether all points have one coordinate in common."""
    first = parts[0][0]
    same = np.all([(part == first).all(0) for part in parts], 0)
    return bool(same.any())


def _ring(outline: Outline) -> np.ndarray:
    return np.append(outline.points, outline.points[:1], 0) if outline.is_closed else outline.points


def draw_patch(pile: Pile, view: View, patch, painter: Painter) -> None:
    """Add a Patch3D or PathPatch3D, which is flat."""
    points = shown_points(np.array(patch._segment3d, float).reshape(-1, 3), patch)
    codes = getattr(patch, "_code3d", None)
    places = view.screen(points)
    if len(places) < 2:
        return
    face = mcolors.to_rgba(patch.get_facecolor()) if patch.get_fill() else (0.0, 0.0, 0.0, 0.0)
    _draw_outline(pile, view, patch, places, codes)
    if face[3] == 0 and not patch.get_hatch():
        return
    if patch.get_hatch() or has_curves(codes) or not (codes is None or is_plain(codes)):
        edge = patch.get_edgecolor() if patch.get_hatch() else (0.0, 0.0, 0.0, 0.0)
        draw_paths(pile, view, painter, [FlatPath(places, codes, face, edge, patch.get_hatch())])
        return
    corners = np.ascontiguousarray(places[:-1] if codes is not None and codes[-1] == 79 else places)
    if np.isfinite(corners).all():
        # Flat on the page, as the patch is in space.
        page = corners * (1.0, 1.0, 0.0)
        pile.add(corners, codes_of([face])[0], triangulate(np.array([len(corners)]), page).corners)


def _draw_outline(pile: Pile, view: View, patch, places: np.ndarray, codes) -> None:
    edge, width = (
        codes_of([patch.get_edgecolor()])[0],
        patch.get_linewidth() * view.points_to_pixels,
    )
    if edge[3] == 0 or not width > 0:
        return
    outlines = outlines_of(places, codes, _STEPS)
    lines = [_ring(one._replace(is_closed=True) if codes is None else one) for one in outlines]
    if not lines:
        return
    start, dashes = patch._dash_pattern
    pen = Pen(str(patch.get_capstyle()), str(patch.get_joinstyle()), start, dashes)
    runs = np.repeat(np.arange(len(lines)), [len(one) for one in lines])
    widths, colors = np.full(len(runs), width), np.broadcast_to(edge, (len(runs), 4))
    draw_lines(pile, view, np.concatenate(lines), runs, widths, colors, pen)


def draw_scatter(pile: Pile, view: View, collection) -> None:
    """Add a Path3DCollection, which was projected: from far to near."""
    order = collection._z_markers_idx
    points = np.stack(
        [np.ma.filled(np.ma.asarray(one, float), np.nan) for one in collection._offsets3d], -1
    )
    shown = ~np.ma.getmaskarray(collection._vzs)
    points[~shown] = np.nan
    places = view.screen(shown_points(points, collection))[order]
    count, paths = len(places), collection.get_paths()
    if not count or not paths:
        return
    areas = np.asarray(collection.get_sizes(), float)
    scale = np.sqrt(np.where(areas > 0, areas, 0.0)) * view.points_to_pixels
    sizes = cycled(scale.reshape(-1), count) if scale.size else np.ones(count)
    widths = (
        cycled(np.asarray(collection.get_linewidth(), float).reshape(-1), count)
        * view.points_to_pixels
    )
    faces, edges = (
        cycled(codes_of(one), count)
        for one in (collection.get_facecolor(), collection.get_edgecolor())
    )
    keep = np.isfinite(places).all(1)
    for k in reversed(range(len(paths))):
        pick = keep if len(paths) == 1 else keep & (np.arange(count) % len(paths) == k)
        if pick.any():
            largest = float(sizes[pick].max(initial=0.0))
            shapes = shapes_of(
                paths[k], _Same(), largest, "butt", str(collection.get_joinstyle() or "round")
            )
            draw_markers(
                *(
                    pile,
                    view,
                    shapes,
                    places[pick],
                    sizes[pick],
                    widths[pick],
                    faces[pick],
                    edges[pick],
                ),
            )


class _Same:
    """The transform that changes nothing."""

    @staticmethod
    def transform(vertices):
        return np.asarray(vertices, float)
