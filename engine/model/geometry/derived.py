"""The arrays of a mesh at one moment, and data derived from them: normals, edges, bounds.

Code that caches results of a mesh uses this: arrays may be replaced meanwhile, but an array is
never changed in place.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..._native.loaders import frozen
from ..._native.rasterizer import bound_points
from . import _feature_edges as _features
from . import normals as _normals
from . import topology as _topology

if TYPE_CHECKING:
    from .mesh import Mesh


def arrays_of(mesh: Mesh) -> dict[str, Any]:
    """Return a mesh's arrays by name, None for missing ones, all from one moment."""
    return dict(mesh._arrays)


def derived(mesh: Mesh, what: str, arrays: dict[str, Any] | None = None) -> Any:
    """Return data derived from a mesh's arrays, current or earlier; computed once for them."""
    arrays = arrays_of(mesh) if arrays is None else arrays
    if what == "normals" and arrays["_given_normals"] is not None:
        return arrays["_given_normals"]
    compute, names = _DERIVED[what]
    sources = [arrays[name] for name in names]
    made_of, array = mesh._derived.get(what, (None, None))
    if made_of is None or not all(map(operator.is_, made_of, sources)):
        array = frozen(compute(*sources))
        mesh._derived[what] = sources, array
    return array


def _face_normals(
    positions: np.ndarray,
    faces: np.ndarray,
    position_ids: np.ndarray | None,
    edge_visible: np.ndarray | None,
) -> np.ndarray:
    polygons = _topology.polygon_ids(faces, edge_visible, position_ids)
    return _normals.face_normals(positions, faces, polygons)


def _bounds(positions: np.ndarray) -> np.ndarray:
    return np.array(bound_points(positions), np.float64)


_FEATURED = ("positions", "faces", "edge_visible", "_given_normals")
_DERIVED: dict[
    str, tuple[Callable[..., np.ndarray], tuple[str, ...]]
] = {  # the function that computes each, and the arrays it takes
    "normals": (_normals.vertex_normals, ("positions", "faces", "position_ids")),
    "face_normals": (_face_normals, ("positions", "faces", "position_ids", "edge_visible")),
    "polygons": (_topology.polygon_ids, ("faces", "edge_visible", "position_ids")),
    "edges": (_topology.visible_edges, ("faces", "edge_visible", "position_ids")),
    "bounds": (_bounds, ("positions",)),
    "feature_edges": (_features.feature_edges, _FEATURED),
    "faceted_edges": (_features.faceted_edges, _FEATURED),
}
