"""The picture that axes draw: an artist that stands for all artists in space.

In: the axes and their artists, when it is drawn. Out: one image on the canvas, in vector files, too.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from matplotlib import artist as martist

from ._known import SURFACES, is_clipped
from ._lines import draw_line, draw_line_collection, project_line
from ._paths import draw_contours, draw_patch, draw_scatter
from ._pile import Pile
from ._polygons import draw_edges, draw_faces, vertex_count
from ._sheets import Painter, draw_text
from ._view import Region, View


class Drawn(NamedTuple):
    """An artist and its kind, of `KINDS`."""

    artist: martist.Artist
    kind: str


class Picture(martist.Artist):
    """Draws artists as one image, which is raster in every file."""

    zorder = 0

    def __init__(self, axes, drawn: list[Drawn]) -> None:
        super().__init__()
        self.set_figure(axes.get_figure(root=False))
        self.axes = axes
        self.set_rasterized(True)
        # In the order of painting, which decides at one depth.
        self._drawn = sorted(drawn, key=lambda one: one.artist.get_zorder())

    @martist.allow_rasterization
    def draw(self, renderer) -> None:
        axes = self.axes
        axes.M = axes.get_proj()
        for artist, kind in self._drawn:
            _project(artist, kind)
        inside = _box_of(axes)
        free = [one for one in self._drawn if not is_clipped(one.artist)]
        if free:
            self._blit(renderer, self._canvas(), free, spared=inside)
        self._blit(renderer, inside, self._drawn)
        for artist, _ in self._drawn:
            artist.stale = False

    def _canvas(self) -> Region:
        box = self.get_figure(root=True).bbox
        return Region(0, 0, int(box.width), int(box.height))

    def _blit(self, renderer, region: Region, drawn: list[Drawn], spared: Region | None = None) -> None:
        pixels = self._pixels(region, drawn) if min(region.width, region.height) > 0 else None
        if pixels is None:
            return
        if spared is not None:
            bottom = region.height - spared.bottom
            rows = slice(max(bottom - spared.height, 0), max(bottom, 0))
            pixels[rows, max(spared.left, 0) : max(spared.left + spared.width, 0)] = 0
            used = pixels[..., 3] > 0
            if not used.any():
                return
        gc = renderer.new_gc()
        # Images are handed over from the lowest row up.
        renderer.draw_image(gc, region.left, region.bottom, np.ascontiguousarray(pixels[::-1]))
        gc.restore()

    def _pixels(self, region: Region, drawn: list[Drawn]) -> np.ndarray | None:
        """Return the picture of a region, (H, W, 4) uint8; None if nothing shows."""
        bounds = [box for one in self._drawn if (box := _bounds_of(*one)) is not None]
        if not bounds:
            return None
        low, high = np.min([box[0] for box in bounds], 0), np.max([box[1] for box in bounds], 0)
        view = View(self.axes, region, low, high)
        painter = Painter(self.get_figure(root=True), view)
        pile = Pile(view, sum(vertex_count(artist) for artist, kind in drawn if kind == "polygons"))
        for number, (artist, kind) in enumerate(drawn):
            if kind == "polygons":
                pile.begin(2 * number)
                draw_faces(pile, artist)
        others = [one for one in drawn if one.kind != "polygons" or _has_edges(one.artist)]
        if others:
            pile.end_surfaces()
        for number, (artist, kind) in enumerate(drawn):
            # Edges lie over faces.
            pile.begin(2 * number + 1)
            _DRAW[kind](pile, view, artist, painter)
        return pile.draw()


def _box_of(axes) -> Region:
    """Return the pixels of the axes' box, rounded as Agg rounds what it clips to."""
    left, bottom, right, top = (int(np.floor(value + 0.5)) for value in axes.bbox.extents)
    return Region(left, bottom, right - left, top - bottom)


def _has_edges(collection) -> bool:
    return bool(len(collection._edgecolor3d) or collection._A is not None) and bool(np.any(collection.get_linewidth()))


def _project(artist, kind: str) -> None:
    """Let mplot3d know where an artist is, so that it can be picked."""
    if kind == "scatter":
        artist.do_3d_projection()
    elif kind == "line":
        project_line(artist)
    elif kind == "polygons":
        # The next one who asks for the colours on the page gets those of now.
        vars(artist).pop("_facecolors2d", None)
        vars(artist).pop("_edgecolors2d", None)


def _bounds_of(artist, kind: str) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the box of an artist's points in the space of its axes' data."""
    points = np.asarray(_POINTS[kind](artist), float)
    if not points.size:
        return None
    points = points.reshape(-1, 3)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for k, axis in enumerate(artist.axes._axis_map.values()):
        values = points[:, k]
        if not np.isfinite(values.min()) or not np.isfinite(values.max()) or axis.get_scale() != "linear":
            values = values[np.isfinite(values)]
            values = values[axis._scale.val_in_range(values)] if axis.get_scale() != "linear" else values
        if not values.size:
            return None
        low[k], high[k] = values.min(), values.max()
    return low, high


def _segment_points(artist) -> np.ndarray:
    parts = [np.ma.filled(np.ma.asarray(one, float), np.nan).reshape(-1, 3) for one in artist._segments3d]
    return np.concatenate(parts) if parts else np.empty((0, 3))


def _polygon_points(artist) -> np.ndarray:
    faces = artist._faces
    invalid = np.broadcast_to(artist._invalid_vertices, faces.shape[:2])
    return faces[~invalid] if invalid.any() else faces


_POINTS: dict[str, Callable] = {
    "polygons": _polygon_points,
    "segments": _segment_points,
    "scatter": lambda artist: np.stack([np.ma.filled(np.ma.asarray(v, float), np.nan) for v in artist._offsets3d], -1),
    "contours": lambda artist: np.concatenate([vs for vs, _ in artist._3dverts_codes] or [np.empty((0, 3))]),
    "line": lambda artist: np.stack(np.broadcast_arrays(*artist.get_data_3d()), -1),
    "patch": lambda artist: artist._segment3d,
    "text": lambda artist: artist.get_position_3d(),
}

_DRAW: dict[str, Callable] = {
    "polygons": lambda pile, view, artist, painter: draw_edges(pile, view, artist),
    "segments": lambda pile, view, artist, painter: draw_line_collection(pile, view, artist),
    "scatter": lambda pile, view, artist, painter: draw_scatter(pile, view, artist),
    "contours": draw_contours,
    "line": lambda pile, view, artist, painter: draw_line(pile, view, artist),
    "patch": draw_patch,
    "text": draw_text,
}
assert set(_DRAW) == set(_POINTS) >= set(SURFACES)
