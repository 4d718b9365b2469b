"""Texts as VTK writes them: its own fonts, without OpenGL.

In: a ``vtkTextProperty`` and a text. Out: pixels with alpha, and where they belong.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules import vtkRenderingFreeType  # noqa: F401  its fonts register themselves
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTextProperty, vtkTextRenderer

from .overlay import Overlay

_DPI = 72
_LEFT, _CENTERED = 0, 1  # justifications; else right
_BOTTOM, _MIDDLE = 0, 1  # else top
_LARGEST = 100  # the largest size that corner annotations try
_MARGIN = 5  # pixels from the edge of the view
#: Justifications of the eight texts of a corner annotation, and where they are in a view, 0 to 1.
_CORNERS = (
    (_LEFT, _BOTTOM, 0.0, 0.0),
    (2, _BOTTOM, 1.0, 0.0),
    (_LEFT, 2, 0.0, 1.0),
    (2, 2, 1.0, 1.0),
    (_CENTERED, _BOTTOM, 0.5, 0.0),
    (2, _MIDDLE, 1.0, 0.5),
    (_LEFT, _MIDDLE, 0.0, 0.5),
    (_CENTERED, 2, 0.5, 1.0),
)


class Writing(NamedTuple):
    """A text as pixels.

    Attributes
    ----------
    rgba : (H, W, 4) uint8
        Top row first.
    left, bottom : int
        The first column and the lowest row, counted from where the text stands, y up.
    """

    rgba: NDArray[np.uint8]
    left: int
    bottom: int


def written(overlay: Overlay, look: Any, text: str) -> Writing | None:
    """Return a text as pixels; None where there are none."""
    dpi = _dpi(overlay)
    renderer, image = vtkTextRenderer.GetInstance(), vtkImageData()
    size, box = [0, 0], [0, 0, 0, 0]
    if not text or renderer is None or not renderer.RenderString(look, text, image, size, dpi):
        return None
    renderer.GetBoundingBox(look, text, box, dpi)
    width, height, _ = image.GetDimensions()
    rgba = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    rgba = rgba[: min(size[1], height), : min(size[0], width)][::-1]
    if not rgba.size:
        return None
    return Writing(np.ascontiguousarray(rgba), box[0], box[2])


def _dpi(overlay: Overlay) -> int:
    return round(_DPI * overlay.scale)


def text_size(overlay: Overlay, look: Any, text: str) -> tuple[int, int]:
    """Return the width and height of a text in pixels."""
    box = [0, 0, 0, 0]
    vtkTextRenderer.GetInstance().GetBoundingBox(look, text, box, _dpi(overlay))
    return max(box[1] - box[0] + 1, 0), max(box[3] - box[2] + 1, 0)


def write(overlay: Overlay, look: Any, text: str, x: float, y: float) -> None:
    """Write a text whose justified corner stands at x, y, in pixels from the view's left bottom."""
    done = written(overlay, look, text)
    if done is not None:
        overlay.blend(done.rgba, x + done.left, y + done.bottom)


def with_size(look: Any, size: int, **changes: int) -> Any:
    """Return a copy of a ``vtkTextProperty``; ``changes`` are ``justification``, ``vertical``."""
    out = vtkTextProperty()
    out.ShallowCopy(look)
    out.SetFontSize(size)
    if "justification" in changes:
        out.SetJustification(changes["justification"])
        out.SetVerticalJustification(changes["vertical"])
    return out


def draw_text(overlay: Overlay, actor: Any) -> None:
    """Draw a ``vtkTextActor``."""
    x, y = overlay.point(actor.GetActualPositionCoordinate())
    look = actor.GetTextProperty()
    if actor.GetTextScaleMode():
        actor.ComputeScaledFont(overlay.renderer)
        look = actor.GetScaledTextProperty()
    write(overlay, look, actor.GetInput() or "", x, y)


def draw_corners(overlay: Overlay, actor: Any) -> None:
    """Draw a ``vtkCornerAnnotation``."""
    texts = [actor.GetText(k) or "" for k in range(8)]
    look = actor.GetTextProperty()
    largest = _fitting(overlay, look, texts)
    scaled = float(largest) ** actor.GetNonlinearFontScaleFactor()
    size = min(int(scaled * actor.GetLinearFontScaleFactor()), actor.GetMaximumFontSize())
    if size < actor.GetMinimumFontSize():
        return
    for text, (across, up, x, y) in zip(texts, _CORNERS, strict=True):
        place = _place(x, overlay.width) - 1, _place(y, overlay.height) - 1
        write(overlay, with_size(look, size, justification=across, vertical=up), text, *place)


def _place(share: float, length: int) -> float:
    if share == 0.5:
        return length // 2
    return _MARGIN if share == 0.0 else length - _MARGIN


def _fitting(overlay: Overlay, look: Any, texts: list[str]) -> int:
    """Return the largest size at which texts side by side, and above each other, fit."""
    low, high = 0, _LARGEST
    while low < high:
        middle = (low + high + 1) // 2
        one = with_size(look, middle)
        boxes = [text_size(overlay, one, text) if text else (0, 0) for text in texts]
        wide = max(boxes[k][0] + boxes[k + 1][0] for k in (0, 2, 4, 6))
        tall = max(boxes[0][1] + boxes[2][1], boxes[1][1] + boxes[3][1])
        if wide < overlay.width and tall < overlay.height:
            low = middle
        else:
            high = middle - 1
    return low
