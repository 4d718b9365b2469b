"""The named parts of a mesh: lists of faces, checked after every change in place."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from ..._native.loaders import frozen
from ...base.checked_containers import CheckedDict
from ._arrays import check_groups

if TYPE_CHECKING:
    from .mesh import Mesh


def put_groups(mesh: Mesh, groups: dict[str, NDArray[Any]]) -> None:
    """Give a mesh checked groups, such as a loader's: each (N,) int32."""
    frozen_groups = {name: frozen(faces) for name, faces in groups.items()}
    mesh._groups = CheckedDict(mesh, _take_changed, frozen_groups)


def _take_changed(
    mesh: Mesh, groups: dict[str, Any], put: Callable[[dict[str, Any]], None]
) -> None:
    """Replace the content of a mesh's own dict of groups."""
    put(check_groups(groups, len(mesh.faces)))
