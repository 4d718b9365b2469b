"""Images that stand in space, such as those of backgrounds.

In: a ``vtkImageSlice``. Out: a `Part` with the image's pixels.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from ...model.materials.textures import Texture
from ._parts import Paint, Part
from ._properties import PLAIN
from ._renderer_view import View, matrix_of, product, transformed
from ._scalar_colors import four_channels


def image_parts(actor: Any, view: View) -> Iterator[Part]:
    """Yield the picture of a ``vtkImageSlice`` whose image is flat in Z."""
    mapper = actor.GetMapper()
    if mapper is None:
        return
    if mapper.GetNumberOfInputConnections(0):
        mapper.GetInputAlgorithm().Update()
    image = mapper.GetInput()
    if image is None or image.GetPointData().GetScalars() is None:
        return
    width, height, depth = image.GetDimensions()
    prop = actor.GetProperty()
    values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(depth, height * width, -1)
    rgba = _colors(values[depth // 2], prop).reshape(height, width, 4)
    filtering = "bilinear" if prop.GetInterpolationType() else "nearest"
    texture = Texture(rgba[::-1], color_space="linear", filter=filtering, wrap="clamp")
    x0, x1, y0, y1, z0, z1 = image.GetBounds()
    dx, dy, _ = image.GetSpacing()
    # A pixel reaches half its size beyond its point.
    x0, x1, y0, y1 = x0 - 0.5 * dx, x1 + 0.5 * dx, y0 - 0.5 * dy, y1 + 0.5 * dy
    z = 0.5 * (z0 + z1)
    corners = np.array([[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]])
    places = transformed(product(view.view, matrix_of(actor.GetMatrix())), corners)
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    is_clear = bool((rgba[..., 3] != 255).any())
    look = replace(PLAIN, opacity=prop.GetOpacity(), is_unlit=True)
    faces = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    yield Part(places, faces, look, None, Paint(uvs=uvs, image=texture, is_clear=is_clear))


def _colors(values: np.ndarray, prop: Any) -> np.ndarray:
    """Return values as colours: those of the property's table, or greys of its window."""
    if values.dtype == np.uint8 and values.shape[1] >= 3 and prop.GetColorWindow() == 255.0:
        return four_channels(values)
    table = prop.GetLookupTable()
    if table is not None and values.shape[1] == 1:
        return vtk_to_numpy(table.MapScalars(numpy_to_vtk(values[:, 0].copy()), 0, -1))
    low = prop.GetColorLevel() - 0.5 * prop.GetColorWindow()
    shares = (values.astype(np.float64) - low) / max(prop.GetColorWindow(), 1e-300)
    return four_channels(np.clip(255.0 * shares + 0.5, 0.0, 255.0).astype(np.uint8))
