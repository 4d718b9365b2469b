"""Scalar bars.

In: a ``vtkScalarBarActor``. Out: its colours, labels and title on the picture. The actor says where
its frame is and how it looks; distances inside were measured on pictures of VTK 9.7.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from ....errors import warn
from .overlay import Overlay
from .texts import text_size, with_size, write

_VERTICAL = 1
_PAD = 4  # pixels between the colours and the end of the frame
_LOW = 3  # pixels by which a line of text reaches into the next
_LEADER = 8
_FAINT = 0.3  # leaders: a pixel wide, between two rows


class _Box(NamedTuple):
    """A rectangle: where it begins along the bar, and how far it reaches; likewise across."""

    start: float
    length: float
    side: float
    thickness: float


def draw_bar(overlay: Overlay, actor: Any) -> None:
    """Draw a ``vtkScalarBarActor``."""
    table = actor.GetLookupTable()
    if table is None:
        return
    if table.GetIndexedLookup():
        warn("a scalar bar of an indexed table is drawn with the table's whole range")
    _Bar(overlay, actor, table).draw()


class _Bar:
    def __init__(self, overlay: Overlay, actor: Any, table: Any) -> None:
        self._overlay, self._actor, self._table = overlay, actor, table
        self._is_vertical = actor.GetOrientation() == _VERTICAL
        x, y = overlay.point(actor.GetPositionCoordinate())
        right, top = overlay.point(actor.GetPosition2Coordinate())
        width = min(right - x, actor.GetMaximumWidthInPixels())
        height = min(top - y, actor.GetMaximumHeightInPixels())
        self._frame = float(int(x)), float(int(y)), float(round(width)), float(round(height))
        if self._is_vertical:
            self._thickness = math.ceil(width * actor.GetBarRatio())
        else:
            self._thickness = math.ceil(height * actor.GetBarRatio())
        self._label, self._title = self._fonts()
        self._bar = self._place()

    def _fonts(self) -> tuple[Any, Any]:
        """Return the looks of labels and title; constrained ones are as large as fits."""
        actor = self._actor
        label, title = actor.GetLabelTextProperty(), actor.GetTitleTextProperty()
        if actor.GetUnconstrainedFontSize():
            return label, title
        _, _, width, height = self._frame
        room = height / max(actor.GetNumberOfLabels(), 1) if self._is_vertical else height / 4
        size = max(min(int(room * 0.7), label.GetFontSize()), 6)
        return with_size(label, size), with_size(title, min(title.GetFontSize(), size + 2))

    def _place(self) -> _Box:
        """Return the colours' rectangle."""
        actor, swatch = self._actor, self._thickness - 1
        left, bottom, width, height = self._frame
        start = swatch * bool(actor.GetDrawBelowRangeSwatch())
        end = _PAD + _PAD * bool(actor.GetDrawBelowRangeSwatch())
        if actor.GetDrawAboveRangeSwatch():
            end += swatch + 2 * self._is_vertical
        nan = swatch * bool(actor.GetDrawNanAnnotation())
        if not self._is_vertical:
            return _Box(left + start, width - start - end - nan, bottom + 1, self._thickness)
        title = self._actor.GetTitle()
        top = text_size(self._overlay, self._title, title)[1] - _LOW if title else 0
        start += nan + _PAD
        length = height - start - top - (end - _PAD)
        return _Box(bottom + start, length, left + 1, self._thickness)

    def draw(self) -> None:
        actor = self._actor
        if actor.GetDrawBackground():
            prop = actor.GetBackgroundProperty()
            self._overlay.rectangle(*self._frame, prop.GetColor(), prop.GetOpacity())
        if actor.GetDrawColorBar():
            self._draw_colors()
        self._draw_swatches()
        if actor.GetDrawFrame():
            self._draw_frame()
        if actor.GetDrawTickLabels():
            self._draw_labels()
        if actor.GetDrawAnnotations():
            self._draw_annotations()
        self._draw_title()

    def _draw_colors(self) -> None:
        count = min(
            self._actor.GetMaximumNumberOfColors(), self._table.GetNumberOfAvailableColors()
        )
        colors = self._mapped(self._values(np.linspace(0.0, 1.0, max(count, 2))[:count]))
        if not self._actor.GetUseOpacity():
            colors[:, 3] = 255
        length = int(round(self._bar.length))
        if length <= 0:
            return
        rows = colors[(np.arange(length) * len(colors)) // length]
        thick = self._thickness - 1
        if self._is_vertical:
            image = np.repeat(rows[::-1, None], thick, 1)
            self._overlay.blend(image, self._bar.side, self._bar.start)
        else:
            image = np.repeat(rows[None], thick, 0)
            self._overlay.blend(image, self._bar.start, self._bar.side)

    def _values(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the values at shares of the bar's length."""
        low, high = self._table.GetRange()
        if self._table.UsingLogScale() and low > 0.0 and high > 0.0:
            return np.exp(math.log(low) + shares * (math.log(high) - math.log(low)))
        return low + shares * (high - low)

    def _share(self, value: float) -> float:
        low, high = self._table.GetRange()
        if high == low:
            return 0.0
        if self._table.UsingLogScale() and low > 0.0 and high > 0.0 and value > 0.0:
            return (math.log(value) - math.log(low)) / (math.log(high) - math.log(low))
        return (value - low) / (high - low)

    def _mapped(self, values: NDArray[np.float64]) -> NDArray[np.uint8]:
        rgba = self._table.MapScalars(numpy_to_vtk(np.ascontiguousarray(values)), 0, -1)
        return vtk_to_numpy(rgba).reshape(-1, 4).copy()

    def _swatches(self) -> list[tuple[str, Any, float]]:
        """Return annotation, colour and middle of the swatches beside the colours."""
        actor, table, found = self._actor, self._table, []
        swatch = self._thickness - 1
        left, bottom, width, height = self._frame
        first = bottom if self._is_vertical else left
        last = self._bar.start + self._bar.length
        if actor.GetDrawNanAnnotation():
            at = first + 1 if self._is_vertical else left + width - swatch
            found.append((actor.GetNanAnnotation(), table.GetNanColor(), at))
        if actor.GetDrawBelowRangeSwatch():
            at = self._bar.start - swatch - (_PAD - 1) * self._is_vertical
            found.append((actor.GetBelowRangeAnnotation(), table.GetBelowRangeColor(), at))
        if actor.GetDrawAboveRangeSwatch():
            at = last + _PAD + (0 if self._is_vertical else _PAD)
            found.append((actor.GetAboveRangeAnnotation(), table.GetAboveRangeColor(), at))
        return found

    def _draw_swatches(self) -> None:
        side = self._thickness - 2
        for _, color, at in self._swatches():
            box = (at, self._bar.side, side, side + 1)
            if self._is_vertical:
                box = (self._bar.side, at, side + 1, side)
            self._overlay.rectangle(*box, color[:3], color[3])

    def _draw_frame(self) -> None:
        left, bottom, width, height = self._frame
        right, top = left + width, bottom + height
        ends = [
            (left, bottom, right, bottom),
            (right, bottom, right, top),
            (right, top, left, top),
            (left, top, left, bottom),
        ]
        prop = self._actor.GetFrameProperty()
        self._overlay.lines(np.array(ends), prop.GetColor(), prop.GetLineWidth())

    def _labels(self) -> list[tuple[str, float]]:
        """Return the labels, and where on the bar they are, 0 to 1."""
        actor = self._actor
        if actor.GetUseCustomLabels() and actor.GetCustomLabels() is not None:
            values = vtk_to_numpy(actor.GetCustomLabels()).tolist()
            placed = [(value, self._share(value)) for value in values]
            placed = [one for one in placed if -1e-9 <= one[1] <= 1.0 + 1e-9]
        else:
            count = actor.GetNumberOfLabels()
            shares = np.linspace(0.0, 1.0, count) if count > 1 else np.full(count, 0.5)
            placed = list(zip(self._values(shares).tolist(), shares.tolist(), strict=True))
        return [(formatted(actor.GetLabelFormat(), value), share) for value, share in placed]

    def _draw_labels(self) -> None:
        for text, share in self._labels():
            along = self._bar.start + share * (self._bar.length - 1)
            if self._is_vertical:
                look = with_size(
                    self._label, self._label.GetFontSize(), justification=0, vertical=1
                )
                write(self._overlay, look, text, self._bar.side + self._thickness + 1, along)
            else:
                look = with_size(
                    self._label, self._label.GetFontSize(), justification=1, vertical=0
                )
                write(self._overlay, look, text, along, self._bar.side + self._thickness)

    def _draw_title(self) -> None:
        title = self._actor.GetTitle()
        if not title:
            return
        left, bottom, width, height = self._frame
        high = text_size(self._overlay, self._label, "0")[1]
        if self._is_vertical:
            y = (
                bottom
                + height
                - text_size(self._overlay, self._title, title)[1]
                + _LOW
                + high // 2
                - 1
            )
        else:
            y = self._bar.side + self._thickness + high - _LOW
        look = with_size(self._title, self._title.GetFontSize(), justification=1, vertical=0)
        write(self._overlay, look, title, left + width / 2 - 1, y)

    def _draw_annotations(self) -> None:
        half = 0.5 * (self._thickness - 2)
        table = self._table
        # VTK takes the colour of what is no number for all leaders of swatches.
        plain = table.GetNanColor()
        marks = [(text, plain, at + half) for text, _, at in self._swatches()]
        for k in range(table.GetNumberOfAnnotatedValues()):
            value = table.GetAnnotatedValue(k).ToDouble()
            share = self._share(value)
            if 0.0 <= share <= 1.0:
                color = self._mapped(np.array([value]))[0] / 255.0
                at = self._bar.start + share * self._bar.length
                marks.append((table.GetAnnotation(k), color, at))
        look = self._actor.GetAnnotationTextProperty()
        size = look.GetFontSize()
        for text, color, at in marks:
            if self._is_vertical:
                edge = self._bar.side - 1
                self._overlay.rectangle(edge - _LEADER, at - 1, _LEADER, 2, color[:3], _FAINT)
                one = with_size(look, size, justification=2, vertical=1)
                write(self._overlay, one, text, edge - _LEADER - 1, at)
            else:
                edge = self._bar.side - 1
                self._overlay.rectangle(at - 1, edge - _LEADER, 2, _LEADER, color[:3], _FAINT)
                one = with_size(look, size, justification=1, vertical=2)
                write(self._overlay, one, text, at, edge - _LEADER)


def formatted(form: str, value: float) -> str:
    """Return a number by a format of VTK: as Python's ``format``, or as ``printf``."""
    try:
        if "{" in form:
            return form.format(value)
        return form % value
    except (ValueError, IndexError, KeyError, TypeError):
        return f"{value:g}"
