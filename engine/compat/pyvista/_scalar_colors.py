"""The colours of a data set, as its mapper finds them: VTK's own tables map the scalars.

In: a mapper and the ``vtkPolyData`` that it shows. Out: a `Paint` of its points or of its cells.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkRenderingCore import vtkMapper

from ...model.materials.textures import Texture
from ._parts import Paint

_OF_CELLS, _OF_FIELDS = 1, 2


def paint_of(mapper: Any, data: Any) -> tuple[Paint, bool]:
    """Return the colours of a surface, and whether they are those of its cells."""
    if not mapper.GetScalarVisibility():
        return Paint(), False

    kind = reference(0)
    found = vtkMapper.GetAbstractScalars(
        data,
        mapper.GetScalarMode(),
        mapper.GetArrayAccessMode(),
        mapper.GetArrayId(),
        mapper.GetArrayName() or "",
        kind,
    )
    if found is None:
        return Paint(), False
    mapper.ClearColorArrays()  # those of another block
    mapped = mapper.MapScalars(data, 1.0)
    if mapped is not None:
        rgba = four_channels(vtk_to_numpy(mapped))
        if int(kind) == _OF_FIELDS:
            row = max(mapper.GetFieldDataTupleId(), 0)
            rgba = np.repeat(rgba[row : row + 1], data.GetNumberOfCells(), 0)
        return Paint(rgba, is_clear=_is_clear(rgba)), int(kind) != 0
    image, uvs = mapper.GetColorTextureMap(), mapper.GetColorCoordinates()
    if image is None or uvs is None:
        return Paint(), False
    width, height, _ = image.GetDimensions()
    texels = four_channels(vtk_to_numpy(image.GetPointData().GetScalars())).reshape(
        height, width, 4
    )
    texture = Texture(texels[::-1], color_space="linear", filter="nearest", wrap="clamp")
    coordinates = vtk_to_numpy(uvs).astype(np.float32)
    return Paint(uvs=coordinates, image=texture, is_clear=_is_clear(texels)), False


def texture_of(texture: Any) -> Texture | None:
    """Return a ``vtkTexture`` as a texture; None where it has no pixels."""
    texture.Update()
    image = texture.GetInput()
    if image is None or image.GetPointData().GetScalars() is None:
        return None
    width, height, _ = image.GetDimensions()
    scalars = image.GetPointData().GetScalars()
    mapped = texture.GetMappedScalars() if texture.GetColorMode() == 1 else None
    values = vtk_to_numpy(mapped if mapped is not None else scalars)
    if values.dtype != np.uint8:
        if texture.GetColorMode() == 0 or values.ndim == 1:
            values = vtk_to_numpy(texture.MapScalarsToColors(scalars))
        else:
            values = np.clip(values * 255.0 + 0.5, 0, 255).astype(np.uint8)
    texels = four_channels(values).reshape(height, width, 4)
    filtering = "nearest"
    if texture.GetInterpolate():
        filtering = "trilinear" if texture.GetMipmap() else "bilinear"
    wrap = "repeat" if texture.GetRepeat() else "clamp"
    space = "srgb" if texture.GetUseSRGBColorSpace() else "linear"
    return Texture(texels[::-1], color_space=space, filter=filtering, wrap=wrap)


def four_channels(values: NDArray[Any]) -> NDArray[np.uint8]:
    """Return colours of 1 to 4 components as (N, 4) uint8."""
    values = values.reshape(len(values), -1)
    out = np.full((len(values), 4), 255, np.uint8)
    count = values.shape[1]
    if count < 3:
        out[:, :3] = values[:, :1]
        if count == 2:
            out[:, 3] = values[:, 1]
    else:
        out[:, :count] = values[:, :4]
    return out


def _is_clear(rgba: NDArray[np.uint8]) -> bool:
    return bool((rgba[..., 3] != 255).any())
