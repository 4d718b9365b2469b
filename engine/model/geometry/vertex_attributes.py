"""The vertex attributes besides positions and normals, each declared once in `Mesh`.

In: a mesh type, or a mesh. Out: its attributes, or their arrays. Code that copies, joins or draws
meshes handles them all through here. The core lists them in csrc/include/e3d_mesh.h.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from ._arrays import ArrayAttribute, Given, Kept


class VertexAttribute(ArrayAttribute[Given, Kept]):
    """An optional array with a row for each vertex.

    Parameters
    ----------
    check : callable
    fill : float
        The value for vertices that lack the attribute; in bytes, 1 is 255.
    """

    def __init__(self, check: Callable[[Any, str], Any], *, fill: float) -> None:
        super().__init__(check, optional=True)
        self._fill = fill

    def filler(self, count: int, like: np.ndarray) -> np.ndarray:
        """Return rows of the fill value, with the width and dtype of another array."""
        one = 255 if like.dtype == np.uint8 else 1
        return np.full((count, *like.shape[1:]), self._fill * one, like.dtype)


@functools.cache
def vertex_attributes(mesh_type: type) -> dict[str, VertexAttribute[Any, Any]]:
    """Return the attributes by name."""
    members = [item for cls in mesh_type.__mro__ for item in vars(cls).items()]
    return {name: value for name, value in members if isinstance(value, VertexAttribute)}


def attributes_of(mesh: Any) -> dict[str, np.ndarray]:
    """Return the attribute arrays that a mesh has, as parameters for another."""
    kind: type = type(mesh)
    held = {name: mesh._arrays[name] for name in vertex_attributes(kind)}
    return {name: array for name, array in held.items() if array is not None}
