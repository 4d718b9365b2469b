"""What a renderer of VTK holds, sorted by how it is drawn.

In: a ``vtkRenderer`` and its view. Out: the parts that stand in space, and functions that draw what
lies on the picture. What cannot be drawn gives a warning that names it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import warn
from ._actors import parts_of
from ._bars import draw_bar
from ._overlay import Overlay
from ._parts import Part
from ._texts import draw_corners, draw_text
from ._view import View, matrix_of, product

Draw = Callable[[Overlay, Any], None]

#: What lies on the picture, by class.
_FLAT: dict[str, Draw] = {
    "vtkCornerAnnotation": draw_corners,
    "vtkScalarBarActor": draw_bar,
    "vtkTextActor": draw_text,
}


def props_of(renderer: Any) -> list[Any]:
    """Return the visible props of a renderer, in its order."""
    props = renderer.GetViewProps()
    props.InitTraversal()
    found = [props.GetNextProp() for _ in range(props.GetNumberOfItems())]
    return [prop for prop in found if prop.GetVisibility()]
