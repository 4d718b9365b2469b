"""Triangles of a user interface, blended over a picture by the engine's own rasteriser.

In:  lists as Dear ImGui makes them: vertices, indices, commands with a scissor rectangle and a
     texture each.
Out: the picture, changed in place: the same bytes on every backend. docs/exactness, section 11,
     has the rules.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..._native import ui as native
from ...choices import Backend
from ...errors import InvalidArgumentError
from ...rendering.backend_selection import resolve_backend

#: A vertex: pixels (y down), uv from the texture's top left corner, RGBA with straight alpha.
VERTEX = np.dtype([("position", "f4", 2), ("uv", "f4", 2), ("color", "u1", 4)])
#: A command: its scissor rectangle in pixels, index range, first vertex and texture. Right and
#: bottom are exclusive.
COMMAND = np.dtype(
    [
        *((side, "i4") for side in ("left", "top", "right", "bottom")),
        *((part, "i4") for part in ("first_index", "index_count", "first_vertex", "texture")),
    ]
)


class Texture:
    """Texels to draw with.

    Parameters
    ----------
    pixels : ndarray of uint8, shape (H, W, 4) or (H, W)
        RGBA, or the alpha of white; top row first, the texels of a row contiguous. It isn't copied:
        what it holds when something is drawn counts.
    filter : {"bilinear", "nearest"}
    opaque : bool
        Whether the alpha of RGBA isn't looked at: what a large opaque rectangle hides isn't drawn.

    Raises
    ------
    InvalidArgumentError
        The array has another shape, type or layout.
    """

    def __init__(
        self,
        pixels: NDArray[np.uint8],
        filter: Literal["bilinear", "nearest"] = "bilinear",
        *,
        opaque: bool = False,
    ) -> None:
        if filter not in native.FILTERS:
            raise InvalidArgumentError(f"filter is one of {', '.join(native.FILTERS)}")
        try:
            texels = pixels if pixels.ndim == 3 else pixels[:, :, np.newaxis]
            self._native = native.NativeTexture(texels, native.FILTERS[filter], opaque)
        except (AttributeError, IndexError, TypeError, ValueError) as error:
            raise InvalidArgumentError(f"these pixels are no texture: {error}") from error


def draw_triangles(
    pixels: NDArray[np.uint8],
    vertices: NDArray[Any],
    indices: NDArray[np.uint16] | NDArray[np.uint32],
    commands: NDArray[Any],
    textures: Sequence[Texture],
    *,
    backend: Backend = "auto",
) -> None:
    """Draw a list of triangles over a picture.

    Parameters
    ----------
    pixels : ndarray of uint8, shape (H, W, 4)
        The picture, straight RGBA; at most 16,384 pixels a side.
    vertices : ndarray of VERTEX, shape (N,)
    indices : ndarray of uint16 or uint32, shape (M,)
        Three a triangle.
    commands : ndarray of COMMAND, shape (K,)
        Drawn in this order.
    textures : sequence of Texture
        Which a command's ``texture`` counts.
    backend : str
        As `Renderer` takes it.

    Raises
    ------
    InvalidArgumentError
        An array has another shape or type, or an index, a count or a texture is out of its range.
        Then nothing was drawn.
    BackendError
    """
    if (vertices.dtype, commands.dtype) != (VERTEX, COMMAND):
        raise InvalidArgumentError("vertices and commands have the dtypes VERTEX and COMMAND")
    try:
        rows = np.ascontiguousarray(vertices).view(np.uint8).reshape(-1, VERTEX.itemsize)
        orders = np.ascontiguousarray(commands).view(np.int32).reshape(-1, 8)
        places = native.NativeTextures(texture._native for texture in textures)
        native.draw(resolve_backend(backend), pixels, rows, indices, orders, places)
    except (AttributeError, TypeError, ValueError) as error:
        if isinstance(error, InvalidArgumentError):
            raise
        raise InvalidArgumentError(f"this list of triangles cannot be drawn: {error}") from error
