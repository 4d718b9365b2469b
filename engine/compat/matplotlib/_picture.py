"""The picture that axes draw: an artist that stands for all artists in space.

In: the axes and their artists, when it is drawn. Out: one image on the canvas, in vector files, too.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from matplotlib import artist as martist

from ._known import is_clipped
from ._lines import draw_line, draw_line_collection, points_of, project_line
from ._paths import draw_contours, draw_patch, draw_scatter
from ._pile import Pile
from ._polygons import draw_edges, draw_faces, vertex_count
from ._sheets import Painter, draw_texts
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
        self.texts: list = []

    @martist.allow_rasterization
    def draw(self, renderer) -> None:
        axes = self.axes
        axes.M = axes.get_proj()
        for artist, kind in self._drawn:
            _project(artist, kind)
        inside = _box_of(axes)
        free = [one for one in self._drawn if not is_clipped(one.artist)]
        if free:
            self._show(renderer, self._canvas(), free, spared=inside)
        self.texts = self._show(renderer, inside, self._drawn)
        for artist, _ in self._drawn:
            artist.stale = False

    def _canvas(self) -> Region:
        box = self.get_figure(root=True).bbox
        return Region(0, 0, int(box.width), int(box.height))

    def _show(self, renderer, region: Region, drawn: list[Drawn], spared: Region | None = None) -> list:
        """Put the picture of a region on the canvas; return the texts that are left to be written.

        ``spared`` is left out, and where all lies within, nothing is drawn.
        """
        if min(region.width, region.height) <= 0 or (view := self._view(region)) is None:
            return []
        vertices = sum(vertex_count(artist) for artist, kind in drawn if kind == "polygons")
        pile = Pile(view, len(drawn), vertices)
        texts = self._collect(pile, view, drawn)
        if spared is not None and _within(pile.bounds(), region, spared):
            return texts
        pixels = pile.draw()
        if pixels is None:
            return texts
        if spared is not None:
            bottom = region.height - spared.bottom
            rows = slice(max(bottom - spared.height, 0), max(bottom, 0))
            pixels[rows, max(spared.left, 0) : max(spared.left + spared.width, 0)] = 0
        gc = renderer.new_gc()
        # Images are handed over from the lowest row up.
        renderer.draw_image(gc, region.left, region.bottom, np.ascontiguousarray(pixels[::-1]))
        gc.restore()
        return texts

    def _view(self, region: Region) -> View | None:
        """Return the view of a region; None if there is nothing to see."""
        bounds = [box for one in self._drawn if (box := _bounds_of(*one)) is not None]
        if not bounds:
            return None
        low, high = np.min([box[0] for box in bounds], 0), np.max([box[1] for box in bounds], 0)
        return View(self.axes, region, low, high)

    def _collect(self, pile: Pile, view: View, drawn: list[Drawn]) -> list:
        """Add artists to a pile; return the texts that nothing hides."""
        painter = Painter(self.get_figure(root=True), view)
        for number, (artist, kind) in enumerate(drawn):
            if kind == "polygons":
                pile.begin(number)
                draw_faces(pile, view, artist)
        if any(kind != "polygons" or _has_edges(artist) for artist, kind in drawn):
            pile.end_surfaces()
        for number, (artist, kind) in enumerate(drawn):
            if kind != "text":
                pile.begin(number, is_on_faces=True)
                _DRAW[kind](pile, view, artist, painter)
        texts = [(number, artist) for number, (artist, kind) in enumerate(drawn) if kind == "text"]
        return draw_texts(pile, view, texts, painter)


class Words(martist.Artist):
    """Writes the texts that nothing in the picture hides; in vector files they stay text."""

    zorder = 0

    def __init__(self, picture: Picture) -> None:
        super().__init__()
        self.set_figure(picture.get_figure(root=False))
        self._picture = picture

    @martist.allow_rasterization
    def draw(self, renderer) -> None:
        for text in self._picture.texts:
            text.draw(renderer)


def _within(bounds: tuple[float, float, float, float], region: Region, box: Region) -> bool:
    """Return whether bounds, counted from a region's left top, lie within a box of the canvas."""
    left, top, right, bottom = bounds
    first, last = box.left - region.left, region.bottom + region.height - box.bottom
    return first <= left and right <= first + box.width and last - box.height <= top and bottom <= last


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
    "line": points_of,
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
}
