"""The named parts of a mesh: lists of faces, checked whenever somebody changes them in place."""

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
    """Let a mesh have groups that are checked, such as those of loaders: each (N,) int32."""
    frozen_groups = {name: frozen(faces) for name, faces in groups.items()}
    mesh._groups = CheckedDict(mesh, _take_changed, frozen_groups)


def _take_changed(
    mesh: Mesh, groups: dict[str, Any], put: Callable[[dict[str, Any]], None]
) -> None:
    """Let a mesh's own dict hold other groups."""
    put(check_groups(groups, len(mesh.faces)))
