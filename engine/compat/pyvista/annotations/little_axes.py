"""Little axes, such as those that tell how a scene is turned.

In: a ``vtkAxesActor``, or the widget that shows one in a corner. Out: arrows in space, and letters.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from vtkmodules.vtkRenderingCore import vtkPropCollection

from .overlay import Overlay
from .texts import text_size, with_size, write

_SMALLEST = 6
_LARGEST = 100


def arrows_of(actor: Any) -> Iterator[Any]:
    """Yield the actors of a ``vtkAxesActor``."""
    found = vtkPropCollection()
    actor.GetActors(found)
    found.InitTraversal()
    for _ in range(found.GetNumberOfItems()):
        yield found.GetNextProp()


def draw_letters(overlay: Overlay, actor: Any) -> None:
    """Write the letters of a ``vtkAxesActor`` at the tips of its arrows."""
    if not actor.GetAxisLabels():
        return
    for name in "XYZ":
        draw_caption(overlay, getattr(actor, f"Get{name}AxisCaptionActor2D")())


def draw_caption(overlay: Overlay, caption: Any) -> None:
    """Write a ``vtkCaptionActor2D``: as large as its box allows."""
    text = caption.GetCaption() or ""
    place = overlay.view.placed(np.array([caption.GetAttachmentPoint()]))
    x, y, w = overlay.view.pixels(place)[0]
    if w <= 0.0 or not text:
        return
    look = caption.GetCaptionTextProperty()
    width, height = caption.GetWidth() * overlay.width, caption.GetHeight() * overlay.height
    size = look.GetFontSize()
    if caption.GetTextActor().GetTextScaleMode():
        least = caption.GetTextActor().GetMinimumSize()
        size = _fitting(overlay, look, text, max(width, least[0]), max(height, least[1]))
    offset = caption.GetPositionCoordinate().GetValue()
    write(
        overlay,
        with_size(look, size, justification=0, vertical=0),
        text,
        x + overlay.scale * offset[0],
        overlay.height - y + overlay.scale * offset[1],
    )


def _fitting(overlay: Overlay, look: Any, text: str, width: float, height: float) -> int:
    low, high = _SMALLEST, _LARGEST
    while low < high:
        middle = (low + high + 1) // 2
        wide, tall = text_size(overlay, with_size(look, middle), text)
        fits = wide <= width and tall <= height
        low, high = (middle, high) if fits else (low, middle - 1)
    return low
