"""The core's handle of a mesh's arrays.

In: the arrays of a `Mesh` at one moment. Out: a `NativeMesh` that borrows them.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._native.rasterizer import VERTEX_ATTRIBUTES, NativeMesh
from ._tangents import mesh_with_tangents
from .derived import arrays_of
from .mesh import Mesh
from .vertex_attributes import vertex_attributes


def find_tangents_when_drawn(mesh: Mesh, uv_set: int | None) -> None:
    """Mark a mesh whose file lacks tangents: they are computed from a UV set when it is drawn.

    None takes the mark away.
    """
    mesh._tangent_uv_set = uv_set


def drawn_arrays(mesh: Mesh, arrays: dict[str, Any]) -> dict[str, Any]:
    """Return the arrays of a mesh as drawn: with computed tangents where the file lacks them.

    They are computed at the first draw: many meshes are never drawn, and loading stays fast.
    """
    uv_set = mesh._tangent_uv_set
    if uv_set is None or arrays["tangents"] is not None or not len(arrays["faces"]):
        return arrays
    if arrays["_given_normals"] is None or arrays["uvs1" if uv_set else "uvs"] is None:
        return arrays
    return arrays_of(mesh_with_tangents(mesh, uv_set))


def make_native_mesh(
    arrays: dict[str, Any], threads: int, movers: np.ndarray | None = None
) -> NativeMesh:
    """Return a handle of a mesh's arrays.

    Parameters
    ----------
    arrays : dict of str to ndarray
    threads : int
        Threads that cut the mesh into clusters; 0: all.
    movers : (V,) int32, optional
        Vertices with different numbers move differently: clusters keep them apart.
    """
    held = {name: arrays[name] for name in vertex_attributes(Mesh) if arrays[name] is not None}
    return NativeMesh(
        arrays["positions"],
        arrays["faces"],
        {_core_name(name, array): array for name, array in held.items()},
        material_ids=arrays["material_ids"],
        lines=arrays["lines"],
        points=arrays["points"],
        movers=movers,
        threads=threads,
    )


def _core_name(name: str, array: np.ndarray) -> str:
    """Return the core's name of an attribute, with its dtype if several are possible."""
    kind = "u8" if array.dtype == np.uint8 else "f32"
    return name if name in VERTEX_ATTRIBUTES else f"{name}_{kind}"
