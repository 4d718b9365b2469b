"""Checks that an array fits the others of a mesh: row counts, and index ranges."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ...errors import InvalidArgumentError
from . import movers as _movers
from ._arrays import require_range
from .vertex_attributes import vertex_attributes


def check_fit(mesh: Any, what: str, array: Any, others: dict[str, Any]) -> None:
    """Check an array against the mesh's other arrays, and against the number of materials."""
    if what == "positions":
        kind: type = type(mesh)
        _check_new_positions(array, others, vertex_attributes(kind))
    elif what == "faces":
        require_range(array, len(others["positions"]), what, "vertices")
        _check_length(others.get("edge_visible"), len(array), "edge_visible", "faces")
    elif what in ("lines", "points"):
        require_range(array, len(others["positions"]), what, "vertices")
    elif what in ("material_ids", "edge_visible"):
        _check_length(array, len(others["faces"]), what, "faces")
    else:
        shown = what.removeprefix("_given_")
        _check_length(array, len(others["positions"]), shown, "vertices")
    if what == "material_ids":
        require_range(array, len(mesh.materials), what, "materials")


def _check_new_positions(
    positions: np.ndarray, others: dict[str, Any], attributes: Iterable[str]
) -> None:
    count = len(positions)
    for what in ("_given_normals", *attributes, "position_ids"):
        other = others.get(what)
        if other is not None and len(other) != count:
            raise InvalidArgumentError(
                f"positions has {count} rows, but {what.removeprefix('_given_')} {len(other)}"
            )
    for what, axis in _movers.VERTEX_AXES.items():
        other = others.get(what)
        if other is not None and other.shape[axis] != count:
            raise InvalidArgumentError(
                f"positions has {count} rows, but {what} {other.shape[axis]}: "
                "take joints and morph targets away first"
            )
    for what in ("faces", "lines", "points"):
        other = others.get(what)
        if other is not None:
            require_range(other, count, what, "vertices")


def _check_length(array: np.ndarray | None, count: int, what: str, of_what: str) -> None:
    if array is not None and len(array) != count:
        raise InvalidArgumentError(f"{what} has {len(array)} rows for {count} {of_what}")
