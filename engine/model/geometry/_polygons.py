"""Meshes of polygons that a program gives as lists of corners.

In: positions, and the corners of each polygon. Out: a mesh of triangles, with the diagonals hidden.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ._arrays import check_indices, check_positions, require_range

if TYPE_CHECKING:
    from .mesh import Mesh


def mesh_of_polygons(
    mesh_type: type[Mesh],
    positions: ArrayLike,
    polygons: Iterable[ArrayLike],
    material_ids: ArrayLike | None,
    attributes: dict[str, Any],
) -> Mesh:
    """Return a mesh of polygons; see `Mesh.from_polygons`."""
    from ...io.reading.triangulation import triangulate

    places = check_positions(positions, "positions")
    lists = _check_polygons(polygons)
    corners = np.concatenate([np.zeros(0, np.int32), *lists])
    require_range(corners, len(places), "polygons", "positions")
    sizes = np.array([len(one) for one in lists], np.int32)
    cut = triangulate(sizes, places, indices=corners)
    ids = None if material_ids is None else check_indices(material_ids, "material_ids")
    if ids is not None and len(ids) != len(lists):
        raise InvalidArgumentError(f"{len(ids)} material_ids for {len(lists)} polygons")
    mesh = mesh_type(
        places,
        corners[cut.corners],
        material_ids=None if ids is None else ids[cut.polygons],
        edge_visible=cut.edge_visible,
        **attributes,
    )
    if not cut.is_complete:
        mesh.warnings.append("some concave polygons are cut as if they were convex: too many")
    return mesh


def _check_polygons(polygons: Iterable[ArrayLike]) -> list[np.ndarray]:
    """Return the corners of each polygon, (N,) int32."""
    if not isinstance(polygons, Iterable):
        raise InvalidArgumentError(f"polygons must be lists of indices, not {shown(polygons)}")
    lists = [check_indices(one, f"polygons[{number}]") for number, one in enumerate(polygons)]
    for number, one in enumerate(lists):
        if len(one) < 3:
            raise InvalidArgumentError(f"polygons[{number}] has {len(one)} corners, not 3 or more")
    return lists
