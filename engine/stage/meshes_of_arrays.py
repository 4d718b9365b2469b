"""Makes meshes of arrays by their shapes.

In: an array, or a pair of vertices and faces. Out: a `Mesh`. Where a shape may mean something else,
a warning says what was taken; an array that shows nothing is an error with the shapes that do.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..base.foreign_arrays import is_foreign_array
from ..base.numbers import as_array
from ..errors import InvalidArgumentError, warn
from ..io.scenes.voxel_faces import outer_faces
from ..model.geometry.mesh import Mesh
from ..model.geometry.values import Values
from ..model.primitives.faces import grid_quads, split_quads

_SHOWN = (
    "(N, 3) are points, (N, 6) points with colours, (N, 2, 3) segments, (N, 3, 3) triangles, "
    "(H, W) heights, (X, Y, Z) of bool voxels, a pair of (V, 3) and (F, 3) of integers a mesh"
)


def mesh_of_arrays(thing: Any) -> Mesh | None:
    """Return a mesh of arrays; None for what is none.

    Raises
    ------
    InvalidArgumentError
        Arrays of such shapes show nothing.
    """
    if isinstance(thing, tuple | list) and len(thing) == 2 and all(map(_is_array, thing)):
        places, faces = (as_array(one, "vertices and faces") for one in thing)
        are_rows = all(one.ndim == 2 and one.shape[1] == 3 for one in (places, faces))
        if not are_rows or faces.dtype.kind not in "iu":
            raise _refused(places, faces)
        return Mesh(places, faces, name="mesh")
    if not _is_array(thing):
        return None
    array = as_array(thing, "the array")
    kind, shape = array.dtype.kind, array.shape
    if kind == "b" and array.ndim == 3:
        return _of_voxels(array)
    if kind not in "fiu":
        raise _refused(array)
    if array.ndim == 2 and shape[1] == 3:
        return Mesh(array, points=np.arange(len(array)), name="points")
    if array.ndim == 2 and shape[1] == 6:
        return _of_colored_points(array)
    if array.ndim == 2 and min(shape) >= 2:
        return _of_heights(array)
    if array.ndim == 3 and shape[2] == 3 and shape[1] in (2, 3) and array.itemsize > 1:
        rows = np.arange(shape[0] * shape[1]).reshape(shape[:2])
        places = array.reshape(-1, 3)
        if shape[1] == 2:
            return Mesh(places, lines=rows, name="segments")
        return Mesh(places, rows, name="triangles")
    raise _refused(array)


def _is_array(thing: Any) -> bool:
    return isinstance(thing, np.ndarray) or is_foreign_array(thing)


def _refused(*arrays: NDArray[Any]) -> InvalidArgumentError:
    given = " and ".join(f"{array.shape} of {array.dtype}" for array in arrays)
    return InvalidArgumentError(f"an array {given} shows nothing: {_SHOWN}")


def _of_colored_points(array: NDArray[Any]) -> Mesh:
    places, colors = array[:, :3], array[:, 3:]
    most = 1 if array.dtype.kind == "f" and not (colors > 1).any() else 255
    if not ((colors >= 0) & (colors <= most)).all():
        raise InvalidArgumentError(
            "the last three columns of an (N, 6) array are colours, 0 to 1 or 0 to 255; heights in "
            "six columns are drawn by a Mesh"
        )
    warn(f"an array {array.shape} is drawn as points with colours from 0 to {most}")
    codes = np.rint(colors * (255 // most)).astype(np.uint8)
    return Mesh(places, points=np.arange(len(array)), colors=codes, name="points")


def _of_heights(heights: NDArray[Any]) -> Mesh:
    """Return a sheet whose columns run along +X and whose rows run along +Z."""
    rows, columns = heights.shape
    warn(f"an array {heights.shape} is drawn as heights along Y, a unit apart")
    z, x = np.mgrid[:rows, :columns]
    faces, edges = split_quads(grid_quads(rows - 1, columns - 1)[:, ::-1])
    places = np.stack([x, heights, z], -1).reshape(-1, 3)
    mesh = Mesh(places, faces, edge_visible=edges, name="heights")
    mesh.values["height"] = Values(np.asarray(heights, np.float64).reshape(-1), on="vertices")
    return mesh


def _of_voxels(voxels: NDArray[np.bool_]) -> Mesh:
    """Return the sides of unit cubes that no other cube touches."""
    places, faces, _ = outer_faces(np.argwhere(voxels))
    edges = np.tile([True, True, False], (len(faces), 1))
    return Mesh(places, faces, edge_visible=edges, name="voxels")
