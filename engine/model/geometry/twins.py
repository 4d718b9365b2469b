"""Twins: meshes that share another's arrays; loaders make many. Also reloads meshes in place.

In: a mesh, and materials or arrays that fit it. Out: another mesh with the same arrays, or the
given mesh with new content. Nothing is checked again.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ...base.dirty_tracking import renew
from ..materials.material import Material
from .mesh import Mesh, own_containers
from .movers import VERTEX_AXES


def twin_of(mesh: Mesh, materials: Iterable[Material], name: str) -> Mesh:
    """Return another mesh that shares the arrays and the data derived from them.

    A copy takes ten times as long.
    """
    twin = type(mesh).__new__(type(mesh))
    own = {key: type(held)(held) for key, held in vars(mesh).items() if type(held) is dict}
    own["_derived"] = mesh._derived
    vars(twin).update(
        vars(mesh), **own, name=name, warnings=list(mesh.warnings), _materials=list(materials)
    )
    own_containers(twin)
    return twin


def put_arrays(mesh: Mesh, arrays: dict[str, Any]) -> None:
    """Give a mesh that nobody else holds yet the arrays of another."""
    mesh._arrays.update(arrays)


def take_over(mesh: Mesh, other: Mesh) -> None:
    """Replace the whole content of a mesh, except its name, with another's."""
    gone = dict.fromkeys(VERTEX_AXES)
    mesh._arrays.update({**gone, **other._arrays})  # one step: the arrays match at every moment
    mesh._morph_targets = other._morph_targets
    mesh._crease_angle = other._crease_angle
    mesh._derived = {}
    mesh._materials, mesh._groups = other._materials, other._groups
    mesh._values = other._values
    own_containers(mesh)
    mesh.warnings = list(other.warnings)
    mesh._origin = other._origin
    if mesh._tangent_uv_set != other._tangent_uv_set:
        mesh._tangent_uv_set = other._tangent_uv_set
    renew(mesh)
