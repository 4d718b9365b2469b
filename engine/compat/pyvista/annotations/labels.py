"""Labels at points, and texts that stand somewhere in space.

In: a ``vtkActor2D`` whose mapper places labels, or an actor of a text. Out: texts on the picture,
in their order, where they do not cover one another.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from .overlay import Overlay
from .texts import text_size, with_size, write

_NONE, _ROUND = 0, 2  # shapes
_OUTLINE = 1  # style


def draw_labels(overlay: Overlay, actor: Any, hidden: Any) -> None:
    """Draw the labels of a ``vtkLabelPlacementMapper``.

    Parameters
    ----------
    hidden : function
        Of places in view space, (N, 3): whether something hides each.
    """
    mapper = actor.GetMapper()
    hierarchy = mapper.GetInputAlgorithm()
    source, is_hidden = hierarchy.GetInputAlgorithm(), False
    data = hierarchy.GetInputDataObject(0, 0)
    if source is not None and source.IsA("vtkSelectVisiblePoints"):
        # It would ask OpenGL what is visible.
        is_hidden = True
        if source.GetNumberOfInputConnections(0):
            source.GetInputAlgorithm().Update()
        data = source.GetInputDataObject(0, 0)
    elif source is not None:
        source.Update()
        data = hierarchy.GetInputDataObject(0, 0)
    if data is None or data.GetPoints() is None:
        return
    labels = data.GetPointData().GetAbstractArray(hierarchy.GetLabelArrayName())
    if labels is None:
        return
    places = overlay.view.placed(vtk_to_numpy(data.GetPoints().GetData()))
    texts = [str(labels.GetVariantValue(k).ToString()) for k in range(len(places))]
    shown = np.ones(len(places), bool) if not is_hidden else ~hidden(places)
    look = hierarchy.GetTextProperty()
    taken: list[tuple[float, float, float, float]] = []
    pixels = overlay.view.pixels(places)
    for k in range(len(places)):
        if pixels[k, 2] <= 0.0 or not shown[k] or not texts[k]:
            continue
        _draw_label(overlay, mapper, look, texts[k], pixels[k], taken)


def _draw_label(
    overlay: Overlay,
    mapper: Any,
    look: Any,
    text: str,
    pixel: Any,
    taken: list[tuple[float, float, float, float]],
) -> None:
    width, height = text_size(overlay, look, text)
    margin = mapper.GetMargin() if mapper.GetShape() != _NONE else 0.0
    x, y = float(pixel[0]), overlay.height - float(pixel[1])
    x -= (0.0, 0.5, 1.0)[look.GetJustification()] * width
    y -= (0.0, 0.5, 1.0)[look.GetVerticalJustification()] * height
    box = x - margin, y - margin, x + width + margin, y + height + margin
    if not mapper.GetPlaceAllLabels() and any(_meet(box, other) for other in taken):
        return
    taken.append(box)
    if mapper.GetShape() != _NONE:
        _draw_shape(overlay, mapper, box)
    write(overlay, with_size(look, look.GetFontSize(), justification=0, vertical=0), text, x, y)


def _draw_shape(overlay: Overlay, mapper: Any, box: tuple[float, float, float, float]) -> None:
    left, bottom, right, top = box
    color, opacity = mapper.GetBackgroundColor(), mapper.GetBackgroundOpacity()
    if mapper.GetStyle() == _OUTLINE:
        ends = np.array(
            [
                (left, bottom, right, bottom),
                (right, bottom, right, top),
                (right, top, left, top),
                (left, top, left, bottom),
            ]
        )
        overlay.lines(ends, color, 1.0, opacity)
        return
    if mapper.GetShape() != _ROUND:
        overlay.rectangle(left, bottom, right - left, top - bottom, color, opacity)
        return
    radius = 0.25 * (top - bottom)
    angles = np.linspace(0.0, 0.5 * np.pi, 7)
    turns = np.stack([np.cos(angles), np.sin(angles)], -1)
    corners = []
    for quarter, (x, y) in enumerate(((right, top), (left, top), (left, bottom), (right, bottom))):
        across, up = (1, 1) if quarter in (0, 2) else (-1, 1)
        arc = turns * (across, up) if quarter in (0, 1) else -turns * (across, up)
        middle = (
            x - radius * np.sign(x - 0.5 * (left + right)),
            y - radius * np.sign(y - 0.5 * (bottom + top)),
        )
        arc = arc if quarter in (0, 2) else arc[::-1]
        corners.append(arc * radius + middle)
    outline = np.concatenate(corners)
    fans = [(outline[0], outline[k], outline[k + 1]) for k in range(1, len(outline) - 1)]
    overlay.triangles(np.array(fans), color, opacity)


def _meet(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def draw_billboard(overlay: Overlay, actor: Any) -> None:
    """Write a text that faces the camera where it stands: a ``vtkBillboardTextActor3D``."""
    place = overlay.view.placed(np.array([actor.GetPosition()]))
    x, y, w = overlay.view.pixels(place)[0]
    if w > 0.0:
        across, up = actor.GetDisplayOffset()
        text = actor.GetInput() or ""
        write(overlay, actor.GetTextProperty(), text, x + across, overlay.height - y + up)
