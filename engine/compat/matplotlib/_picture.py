"""The picture that axes draw: an artist that stands for all artists in space.

In: the axes and their artists, when it is drawn. Out: one image on the canvas, in vector files as
well, and the texts that nothing hides.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib import artist as martist

from ...base.image_size import MAX_SIZE
from ...errors import InvalidArgumentError
from ._known import LINE, POLYGONS, SCATTER, TEXT, Kind, is_clipped
from ._lines import draw_waiting, project_line
from ._pile import Pile
from ._polygons import draw_faces, vertex_count
from ._sheets import Painter, draw_texts
from ._view import Region, View


class Drawn(NamedTuple):
    """An artist and its kind."""

    artist: martist.Artist
    kind: Kind


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
        self.texts = self._show(renderer, inside, self._drawn)
        beyond = [
            one
            for one in self._drawn
            if not is_clipped(one.artist) and one.artist not in self.texts
        ]
        if beyond:
            self._show(renderer, self._canvas(), beyond, spared=inside)
        for artist, _ in self._drawn:
            artist.stale = False

    def _canvas(self) -> Region:
        box = self.get_figure(root=True).bbox
        return Region(0, 0, int(box.width), int(box.height))

    def _show(
        self, renderer, region: Region, drawn: list[Drawn], spared: Region | None = None
    ) -> list:
        """Put the picture of a region on the canvas; return the texts that are left to be written.

        ``spared`` is left out, and where all lies within, nothing is drawn.
        """
        if min(region.width, region.height) <= 0 or (view := self._view(region)) is None:
            return []
        if max(region.width, region.height) > MAX_SIZE:
            raise InvalidArgumentError(
                f"axes of {region.width} x {region.height} pixels cannot be drawn, "
                f"at most {MAX_SIZE} a side can: lower the figure's dpi"
            )
        vertices = sum(vertex_count(artist) for artist, kind in drawn if kind is POLYGONS)
        pile = Pile(view, len(drawn), vertices)
        texts = self._collect(pile, view, drawn, spared is not None)
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

    def _collect(self, pile: Pile, view: View, drawn: list[Drawn], with_texts: bool) -> list:
        """Add artists to a pile; return the texts that nothing hides, which may be added, too."""
        painter = Painter(self.get_figure(root=True), view)
        for number, (artist, kind) in enumerate(drawn):
            if kind is POLYGONS:
                pile.begin(number)
                draw_faces(pile, view, artist)
        if any(kind is not POLYGONS or _has_edges(artist) for artist, kind in drawn):
            pile.end_surfaces()
        for number, (artist, kind) in enumerate(drawn):
            if kind is not TEXT:
                pile.begin(number, is_on_faces=True)
                kind.draw(pile, view, artist, painter)
        draw_waiting(pile, view)
        texts = [(number, artist) for number, (artist, kind) in enumerate(drawn) if kind is TEXT]
        return draw_texts(pile, view, texts, painter, with_texts)


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
    return (
        first <= left and right <= first + box.width and last - box.height <= top and bottom <= last
    )


def _box_of(axes) -> Region:
    """Return the pixels of the axes' box, rounded as Agg rounds what it clips to."""
    left, bottom, right, top = (int(np.floor(value + 0.5)) for value in axes.bbox.extents)
    return Region(left, bottom, right - left, top - bottom)


def _has_edges(collection) -> bool:
    has_colors = len(collection._edgecolor3d) or collection._A is not None
    return bool(has_colors) and bool(np.any(collection.get_linewidth()))


def _project(artist, kind: Kind) -> None:
    """Let mplot3d know where an artist is, so that it can be picked."""
    if kind is SCATTER:
        artist.do_3d_projection()
    elif kind is LINE:
        project_line(artist)
    elif kind is POLYGONS:
        # The next one who asks for the colours on the page gets those of now.
        vars(artist).pop("_facecolors2d", None)
        vars(artist).pop("_edgecolors2d", None)


def _bounds_of(artist, kind: Kind) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the box of an artist's points in the space of its axes' data."""
    points = np.asarray(kind.points(artist), float).reshape(-1, 3)
    if not points.size:
        return None
    # Column by column: many times as fast as over rows of three.
    low, high = (np.array([find(points[:, k]) for k in range(3)]) for find in (np.min, np.max))
    scales = [axis.get_scale() for axis in artist.axes._axis_map.values()]
    is_linear = all(scale == "linear" for scale in scales)
    if np.isfinite(low).all() and np.isfinite(high).all() and is_linear:
        return low, high
    for k, axis in enumerate(artist.axes._axis_map.values()):
        values = points[np.isfinite(points[:, k]), k]
        if scales[k] != "linear":
            values = values[axis._scale.val_in_range(values)]
        if not values.size:
            return None
        low[k], high[k] = values.min(), values.max()
    return low, high
