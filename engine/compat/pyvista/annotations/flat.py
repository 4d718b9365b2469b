"""Polygons and lines on the picture, such as the borders of subplots.

In: a ``vtkActor2D`` with a ``vtkPolyDataMapper2D``. Out: changed pixels.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from .._surfaces import segments_of, triangles_of, without_strips
from .overlay import Overlay


def draw_flat(overlay: Overlay, actor: Any) -> None:
    """Draw a ``vtkActor2D``, in the colour of its property."""
    mapper = actor.GetMapper()
    if mapper.GetNumberOfInputConnections(0):
        mapper.GetInputAlgorithm().Update()
    data = mapper.GetInput()
    if data is None or data.GetPoints() is None or not data.GetNumberOfPoints():
        return
    data = without_strips(data)
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(np.float64)
    coordinate = mapper.GetTransformCoordinate()
    if coordinate is not None:
        kept = coordinate.GetValue()
        for row in points:
            coordinate.SetValue(*row)
            row[:2] = overlay.point(coordinate)
        coordinate.SetValue(*kept)
    places = points[:, :2] + overlay.point(actor.GetActualPositionCoordinate())
    prop = actor.GetProperty()
    faces = triangles_of(data, points).corners
    if len(faces):
        overlay.triangles(places[faces], prop.GetColor(), prop.GetOpacity())
    ends = segments_of(data).ends
    if len(ends):
        lines = places[ends].reshape(-1, 4)
        # The last row and column belong to the picture, too.
        lines = np.clip(lines, 0.0, (overlay.width - 1.0, overlay.height - 1.0) * 2) + 0.5
        overlay.lines(lines, prop.GetColor(), prop.GetLineWidth(), prop.GetOpacity())
