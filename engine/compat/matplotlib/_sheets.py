"""What Agg draws and the depth buffer then hides: texts, and flat paths with curves or holes.

In: artists and the view. Out: rectangles of pixels in the pile. A text stands upright at its place;
a flat path lies in the plane of its points.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.path import Path
from matplotlib.transforms import IdentityTransform
from mpl_toolkits.mplot3d.art3d import Text3D

from ._pile import Pile
from ._view import View

_MARGIN = 24.0  # pixels: how far lines reach beyond a path
_FLAT = 1e-3  # pixels squared: a path seen from its edge has no area


class Painter:
    """A picture of the whole canvas, on which one thing at a time is painted."""

    def __init__(self, figure, view: View) -> None:
        self._size = int(figure.bbox.width), int(figure.bbox.height)
        self._dpi, self._view = figure.dpi, view
        self._renderer: RendererAgg | None = None

    @property
    def renderer(self) -> RendererAgg:
        if self._renderer is None:
            self._renderer = RendererAgg(*self._size, self._dpi)
        return self._renderer

    def taken(self, box=(0.0, 0.0, np.inf, np.inf)) -> tuple[np.ndarray, int, int] | None:
        """Return what was painted within the region, its left and its top; then wipe the canvas.

        box : what was painted lies within, but for a few pixels: left, bottom, right, top.
        """
        region, height = self._view.region, self._size[1]
        left, right = (
            max(region.left, box[0] - _MARGIN, 0),
            min(region.left + region.width, box[2] + _MARGIN),
        )
        bottom, top = (
            max(region.bottom, box[1] - _MARGIN, 0),
            min(region.bottom + region.height, box[3] + _MARGIN),
        )
        pixels, found = np.asarray(self.renderer.buffer_rgba()), None
        inside = pixels[
            max(height - int(top), 0) : height - int(bottom), int(left) : max(int(right), 0)
        ]
        used = inside[..., 3] > 0
        if used.any():
            y, x = np.flatnonzero(used.any(1)), np.flatnonzero(used.any(0))
            cut = inside[y[0] : y[-1] + 1, x[0] : x[-1] + 1].copy()
            first = max(height - int(top), 0) - (height - region.bottom - region.height)
            found = cut, int(x[0]) + int(left) - region.left, int(y[0]) + first
        pixels[:] = 0
        return found


def draw_texts(
    pile: Pile, view: View, texts: list[tuple[int, Text3D]], painter: Painter, everyone: bool
) -> list[Text3D]:
    """Add those texts that something hides in part; each is as deep as its place.

    Parameters
    ----------
    texts : list of (number, Text3D)
        With what `Pile.begin` takes.
    everyone : bool
        Add those that nothing hides as well.

    Returns
    -------
    texts : list of Text3D
        Those that nothing hides, from far to near: they may stay text.
    """
    places = [
        view.screen(np.array([[float(v) for v in text.get_position_3d()]])) for _, text in texts
    ]
    shown = [
        (place, *text)
        for place, text in zip(places, texts, strict=True)
        if np.isfinite(place).all()
    ]
    has_others = bool(shown) and not pile.is_empty
    depths = pile.depths() if shown else np.empty((0, 0))
    free: list[Text3D] = []
    for place, number, text in sorted(shown, key=lambda one: (one[0][0, 2], -one[1])):
        if not has_others and not everyone:
            free.append(text)
            continue
        text.draw(painter.renderer)
        painted = painter.taken()
        if painted is None:
            free += [] if everyone else [text]
            continue
        pixels, left, top = painted
        lifted = float(pile.lifted(place, np.array([0.5 * min(pixels.shape[:2])]))[0, 2])
        behind = depths[top : top + len(pixels), left : left + pixels.shape[1]]
        if not everyone and not (behind[pixels[..., 3] > 0] < lifted).any():
            free.append(text)
            continue
        pile.begin(number)
        pile.add_picture(_corners(pixels, left, top, (lifted, 0.0, 0.0)), pixels)
        np.minimum(behind, lifted, out=behind, where=pixels[..., 3] > 0)
    return free[::-1]


class FlatPath(NamedTuple):
    """A path that lies in a plane.

    Attributes
    ----------
    places : (N, 3) float64
        On the screen.
    codes : (N,) int or None
        `Path.codes`.
    face, edge : (4,) float
        RGBA.
    hatch : str or None
    """

    places: np.ndarray
    codes: np.ndarray | None
    face: Any
    edge: Any = (0.0, 0.0, 0.0, 0.0)
    hatch: str | None = None


def draw_paths(pile: Pile, view: View, painter: Painter, paths: list[FlatPath]) -> None:
    """Add paths of one plane; later ones lie on earlier ones."""
    places = np.concatenate([path.places for path in paths])
    plane = _plane_of(places)
    if plane is None:
        return
    region = view.region
    origin = np.array([region.left, region.bottom + region.height], float)
    for path in paths:
        gc = painter.renderer.new_gc()
        gc.set_linewidth(0.0)
        gc.set_foreground(tuple(path.edge), isRGBA=True)
        if path.hatch:
            gc.set_hatch(path.hatch)
            gc.set_hatch_color(tuple(path.edge))
        page = Path(path.places[:, :2] * (1.0, -1.0) + origin, path.codes)
        painter.renderer.draw_path(
            gc, page, IdentityTransform(), tuple(path.face) if path.face[3] > 0 else None
        )
        gc.restore()
    finite = places[np.isfinite(places).all(1), :2] * (1.0, -1.0) + origin
    if (painted := painter.taken((*finite.min(0), *finite.max(0)))) is not None:
        pixels, left, top = painted
        pile.add_picture(_corners(pixels, left, top, plane), pixels)


def _plane_of(places: np.ndarray) -> tuple[float, float, float] | None:
    """Return a plane through points, depth = a + b x + c y; None where it is seen from its edge."""
    places = places[np.isfinite(places).all(1)]
    if len(places) < 3:
        return None
    origin = places[0]
    away = places - origin
    far = away[np.argmax(away[:, 0] ** 2 + away[:, 1] ** 2)]
    areas = far[0] * away[:, 1] - far[1] * away[:, 0]
    side = away[np.argmax(np.abs(areas))]
    area = far[0] * side[1] - far[1] * side[0]
    if abs(area) < _FLAT:
        return None
    across = (far[2] * side[1] - side[2] * far[1]) / area
    down = (far[0] * side[2] - side[0] * far[2]) / area
    return float(origin[2] - across * origin[0] - down * origin[1]), float(across), float(down)


def _corners(
    pixels: np.ndarray, left: int, top: int, plane: tuple[float, float, float]
) -> np.ndarray:
    height, width = pixels.shape[:2]
    x, y = (
        np.array([0, width, 0, width]) + float(left),
        np.array([0, 0, height, height]) + float(top),
    )
    return np.stack([x, y, plane[0] + plane[1] * x + plane[2] * y], 1)
