"""Boxes with numbered axes round a scene.

In: a ``vtkCubeAxesActor``. Out: its axes, grids and ticks as strokes in space, its labels and
titles along them on the picture.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._line_marks import strokes
from .._parts import Paint, Part
from .._properties import property_of
from .._renderer_view import View
from .bars import formatted
from .overlay import Overlay
from .texts import with_size, write

_NAMES = "XYZ"
_CLOSEST, _FURTHEST, _STATIC_TRIAD, _STATIC_EDGES = 1, 2, 3, 4  # fly modes; 0: outer edges
_ALL_GRIDS, _CLOSEST_GRIDS = 0, 1
_INSIDE, _BOTH = 0, 2
_TICK = 0.02  # of the box's diagonal
# Pixels from an axis to the middles of its labels and of its title, outwards and towards its end,
# as measured on VTK 9.7.
_LABELS = 22.5, 2.0
_TITLES = 54.0, 8.0
_LARGER = 1.25  # VTK's labels in space than those of the same size on the picture
_STEEP = -75.0  # degrees: steeper texts are read upwards


class _Edge(NamedTuple):
    """An edge of the box: its axis, and on which sides of the others it lies, 0 or 1."""

    axis: int
    sides: tuple[int, int, int]


def bounds_parts(actor: Any, view: View) -> Iterator[Part]:
    """Yield the lines of a ``vtkCubeAxesActor``."""
    yield from _Box(actor, view).lines()


def draw_bounds_texts(overlay: Overlay, actor: Any) -> None:
    """Write the labels and titles of a ``vtkCubeAxesActor``."""
    _Box(actor, overlay.view).write(overlay)


class _Box:
    def __init__(self, actor: Any, view: View) -> None:
        self._actor, self._view = actor, view
        self._ends = np.array(actor.GetBounds()).reshape(3, 2)
        corners = np.array(list(itertools.product(*self._ends)))
        self._corners = view.placed(corners).reshape(2, 2, 2, 3)
        self._middle = self._corners.reshape(-1, 3).mean(0)

    def _of(self, axis: int, name: str) -> Any:
        return getattr(self._actor, name.replace("?", _NAMES[axis]))()

    def _distance(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        if self._view.is_parallel:
            return -places[..., 2]
        return np.sqrt((places * places).sum(-1))

    def _corner(self, is_near: bool) -> tuple[int, int, int]:
        """Return the sides of the corner that is nearest to the camera, or farthest."""
        distances = self._distance(self._corners).reshape(-1)
        index = int(np.argmin(distances) if is_near else np.argmax(distances))
        return (index >> 2) & 1, (index >> 1) & 1, index & 1

    def edges(self) -> list[_Edge]:
        """Return the edges that are axes."""
        mode = self._actor.GetFlyMode()
        if mode == _STATIC_EDGES:
            return [edge for axis in range(3) for edge in self._parallel(axis)]
        if mode in (_CLOSEST, _FURTHEST, _STATIC_TRIAD):
            corner = (0, 0, 0) if mode == _STATIC_TRIAD else self._corner(mode == _CLOSEST)
            return [_Edge(axis, corner) for axis in range(3)]
        return [max(self._parallel(axis), key=self._rank) for axis in range(3)]

    def _parallel(self, axis: int) -> list[_Edge]:
        found = []
        for first, second in ((0, 0), (0, 1), (1, 1), (1, 0)):
            sides = [0, 0, 0]
            sides[(axis + 1) % 3 if axis != 1 else 0] = first
            sides[(axis + 2) % 3 if axis != 1 else 2] = second
            found.append(_Edge(axis, tuple(sides)))
        return found

    def _rank(self, edge: _Edge) -> tuple[float, float]:
        """Return how far out an edge is on the screen, and of those alike, how far left."""
        places = self._view.pixels(np.stack([*self._along(edge, np.array([0.5])), self._middle]))
        away = places[0, :2] - places[1, :2]
        return round(float(np.hypot(*away))), -float(places[0, 0])

    def _along(self, edge: _Edge, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return places on an edge, (N, 3)."""
        low, high = list(edge.sides), list(edge.sides)
        low[edge.axis], high[edge.axis] = 0, 1
        a, b = self._corners[tuple(low)], self._corners[tuple(high)]
        return a + (b - a) * shares[:, None]

    def labels(self, axis: int) -> list[str]:
        """Return the labels along an axis, at equal distances."""
        given = self._actor.GetAxisLabels(axis)
        if given is not None and given.GetNumberOfValues():
            return [given.GetValue(k) for k in range(given.GetNumberOfValues())]
        low, high = self._of(axis, "Get?AxisRange")
        form = self._of(axis, "Get?LabelFormat")
        return [formatted(form, value) for value in np.linspace(low, high, 5)]

    def _shares(self, axis: int) -> NDArray[np.float64]:
        count = len(self.labels(axis))
        return np.linspace(0.0, 1.0, count) if count > 1 else np.array([0.5])

    def lines(self) -> Iterator[Part]:
        for edge in self.edges():
            if self._of(edge.axis, "Get?AxisVisibility"):
                yield self._strokes(
                    self._along(edge, np.array([0.0, 1.0]))[None], edge.axis, "Axes"
                )
                if self._of(edge.axis, "Get?AxisTickVisibility") and not self._hides_ticks(
                    edge.axis
                ):
                    yield self._strokes(self._ticks(edge), edge.axis, "Axes")
        for axis in range(3):
            if self._of(axis, "GetDraw?Gridlines"):
                yield self._strokes(self._grid(axis), axis, "Gridlines")

    def _hides_ticks(self, axis: int) -> bool:
        """Return whether the lines of the grid are where ticks would be."""
        has_grid = self._of(axis, "GetDraw?Gridlines")
        return bool(has_grid) and self._actor.GetTickLocation() == _INSIDE

    def _strokes(self, ends: NDArray[np.float64], axis: int, kind: str) -> Part:
        name = "Get?AxesLinesProperty" if kind == "Axes" else "Get?AxesGridlinesProperty"
        look = property_of(self._of(axis, name), is_unlit=True)
        return strokes(self._view, ends, Paint(), look, None)

    def _ticks(self, edge: _Edge) -> NDArray[np.float64]:
        """Return the ticks of an edge, (N, 2, 3)."""
        starts = self._along(edge, self._shares(edge.axis))
        location, found = self._actor.GetTickLocation(), []
        for other in range(3):
            if other == edge.axis:
                continue
            there = list(edge.sides)
            there[other] = 1 - there[other]
            inwards = self._along(_Edge(edge.axis, tuple(there)), np.array([0.0]))
            inwards = inwards - self._along(edge, np.array([0.0]))
            length = np.sqrt((inwards * inwards).sum())
            diagonal = np.sqrt(((self._corners[1, 1, 1] - self._corners[0, 0, 0]) ** 2).sum())
            step = inwards * (_TICK * diagonal / max(length, 1e-300))
            begins = starts - step if location != _INSIDE else starts
            ends = starts + step if location in (_INSIDE, _BOTH) else starts
            found.append(np.stack([begins, ends], 1))
        return np.concatenate(found)

    def _grid(self, axis: int) -> NDArray[np.float64]:
        """Return the lines of grids at the labels of an axis, (N, 2, 3)."""
        where = self._actor.GetGridLineLocation()
        corner = self._corner(where == _CLOSEST_GRIDS)
        found = []
        for other, third in ((0, 1), (1, 0)):
            rest = [k for k in range(3) if k != axis]
            along, fixed = rest[other], rest[third]
            sides = (0, 1) if where == _ALL_GRIDS else (corner[fixed],)
            for side in sides:
                ends = []
                for far in (0, 1):
                    at = [0, 0, 0]
                    at[fixed], at[along] = side, far
                    ends.append(self._along(_Edge(axis, tuple(at)), self._shares(axis)))
                found.append(np.stack(ends, 1))
        return np.concatenate(found)

    def write(self, overlay: Overlay) -> None:
        done = set()
        for edge in self.edges():
            if edge.axis in done or not self._of(edge.axis, "Get?AxisVisibility"):
                continue
            done.add(edge.axis)
            self._write_axis(overlay, edge)

    def _write_axis(self, overlay: Overlay, edge: _Edge) -> None:
        actor, axis = self._actor, edge.axis
        shares = self._shares(axis)
        places = self._view.pixels(self._along(edge, np.concatenate([shares, [0.0, 0.5, 1.0]])))
        if (places[:, 2] <= 0.0).any():
            return
        places = np.stack([places[:, 0], overlay.height - places[:, 1]], -1)
        along, middle = places[-1] - places[-3], self._view.pixels(self._middle[None])[0]
        away = np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-300)
        if ((places[-2] - (middle[0], overlay.height - middle[1])) * away).sum() < 0.0:
            away = -away
        angle = _readable(float(np.degrees(np.arctan2(along[1], along[0]))))
        ahead = along / max(float(np.hypot(*along)), 1e-300)
        label, title_at = (
            (away * off + ahead * on) * overlay.scale for off, on in (_LABELS, _TITLES)
        )
        if self._of(axis, "Get?AxisLabelVisibility"):
            look = _turned(actor.GetLabelTextProperty(axis), angle)
            for text, place in zip(self.labels(axis), places, strict=False):
                write(overlay, look, text, *(place + label))
        title = self._of(axis, "Get?Title")
        if title:
            look = _turned(actor.GetTitleTextProperty(axis), angle)
            write(overlay, look, title, *(places[-2] + title_at))


def _readable(angle: float) -> float:
    """Return an angle in degrees, or its opposite, by which texts do not stand on their heads."""
    if angle > _STEEP + 180.0:
        return angle - 180.0
    return angle + 180.0 if angle <= _STEEP else angle


def _turned(look: Any, angle: float) -> Any:
    size = int(_LARGER * look.GetFontSize() + 0.5)
    one = with_size(look, size, justification=1, vertical=1)
    one.SetOrientation(angle)
    one.BoldOff()  # as VTK's labels in space
    return one
