"""Legends.

In: a ``vtkLegendBoxActor``. Out: its box, symbols and texts on the picture. The shares of the box
were measured on pictures of VTK 9.7.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from .._surfaces import segments_of, triangles_of, without_strips
from .overlay import Overlay
from .texts import text_size, with_size, write

_SYMBOLS = 0.25  # of the width
_SYMBOL = 0.42  # of the smaller side of its place
_LINE = 0.68  # of the height of an entry
_LARGEST = 100


def draw_legend(overlay: Overlay, actor: Any) -> None:
    """Draw a ``vtkLegendBoxActor``."""
    x, y = overlay.point(actor.GetPositionCoordinate())
    right, top = overlay.point(actor.GetPosition2Coordinate())
    width, height = right - x, top - y
    count = actor.GetNumberOfEntries()
    if actor.GetUseBackground():
        color = actor.GetBackgroundColor()
        overlay.rectangle(x, y, width, height, color, actor.GetBackgroundOpacity())
    if actor.GetBorder():
        ends = [(x, y, right, y), (right, y, right, top), (right, top, x, top), (x, top, x, y)]
        prop = actor.GetBoxProperty()
        overlay.lines(np.array(ends), prop.GetColor(), prop.GetLineWidth())
    if not count:
        return
    pad = actor.GetPadding()
    row = (height - 2 * pad) / count
    texts = [actor.GetEntryString(k) or "" for k in range(count)]
    look = actor.GetEntryTextProperty()
    size = _fitting(overlay, look, texts, (1.0 - _SYMBOLS) * width - 2 * pad, _LINE * row)
    side = _SYMBOL * min(_SYMBOLS * width, row)
    for k, text in enumerate(texts):
        color = actor.GetEntryColor(k)
        middle = top - pad - (k + 0.5) * row
        symbol = actor.GetEntrySymbol(k)
        if symbol is not None:
            _draw_symbol(overlay, symbol, x + pad + 0.5 * _SYMBOLS * width, middle, side, color)
        if not size:
            continue
        one = with_size(look, size, justification=0, vertical=1)
        one.SetColor(color)
        write(overlay, one, text, x + pad + _SYMBOLS * width - 2, middle - 1)


def _fitting(overlay: Overlay, look: Any, texts: list[str], width: float, height: float) -> int:
    """Return the largest size at which each text fits; 0 if none does."""
    low, high = 0, _LARGEST
    while low < high:
        middle = (low + high + 1) // 2
        boxes = [text_size(overlay, with_size(look, middle), text) for text in texts if text]
        fits = all(wide <= width and tall <= height for wide, tall in boxes)
        low, high = (middle, high) if fits else (low, middle - 1)
    return low


def _draw_symbol(
    overlay: Overlay, symbol: Any, x: float, y: float, side: float, color: Any
) -> None:
    data = without_strips(symbol)
    if data.GetPoints() is None or not data.GetNumberOfPoints():
        return
    points = vtk_to_numpy(data.GetPoints().GetData())[:, :2].astype(np.float64)
    low, high = points.min(0), points.max(0)
    extent = float((high - low).max())
    if extent <= 0.0:
        return
    places = (points - 0.5 * (low + high)) * (side / extent) + (x, y)
    deep = np.concatenate([places, np.zeros((len(places), 1))], 1)
    faces = triangles_of(data, deep).corners
    if len(faces):
        overlay.triangles(places[faces], color)
    ends = segments_of(data).ends
    if len(ends):
        overlay.lines(places[ends].reshape(-1, 4), color)
