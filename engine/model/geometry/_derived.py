"""Data derived from a mesh's arrays, computed when asked for: normals, edges, bounds."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy as np

from ..._native.loaders import frozen
from ..._native.rasterizer import bound_points
from . import normals as _normals
from . import topology as _topology


def derive(kept: dict[str, tuple[list[Any], np.ndarray]], what: str, arrays: dict[str, Any]) -> Any:
    """Derived data of arrays as they were at one moment, computed once for these."""
    if what == "normals" and arrays["_given_normals"] is not None:
        return arrays["_given_normals"]
    compute, names = _DERIVED[what]
    sources = [arrays[name] for name in names]
    made_of, array = kept.get(what, (None, None))
    if made_of is None or not all(map(operator.is_, made_of, sources)):
        array = frozen(compute(*sources))
        kept[what] = sources, array
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


_DERIVED: dict[
    str, tuple[Callable[..., np.ndarray], tuple[str, ...]]
] = {  # how each is computed, and from which arrays
    "normals": (_normals.vertex_normals, ("positions", "faces", "position_ids")),
    "face_normals": (_face_normals, ("positions", "faces", "position_ids", "edge_visible")),
    "polygons": (_topology.polygon_ids, ("faces", "edge_visible", "position_ids")),
    "edges": (_topology.visible_edges, ("faces", "edge_visible", "position_ids")),
    "bounds": (_bounds, ("positions",)),
}
