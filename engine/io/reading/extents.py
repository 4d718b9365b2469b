"""Detects coordinates that cannot be drawn, or not precisely.

In: a `Document` of any reader. Out: warnings if vertices of its meshes have coordinates that are
not finite, or are too far from the origin for 32-bit coordinates. Distances held by objects' poses
do not matter.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...base.numbers import count_not_finite
from .documents import Document

if TYPE_CHECKING:
    from ...model.geometry.mesh import Mesh

# The largest gap between 32-bit floats, relative to the size: half a pixel of a picture 2048 wide.
_COARSEST = 2.0**-12


def extent_warnings(document: Document) -> list[str]:
    """Return the warnings about the coordinates of a document's meshes."""
    return _broken(document) + _coarse(document)


def _broken(document: Document) -> list[str]:
    meshes = {id(one.mesh): one.mesh.positions for one in document.objects}.values()
    broken = sum(map(count_not_finite, meshes))
    if not broken:
        return []
    return [
        f"{broken} of {sum(map(len, meshes))} vertices have coordinates that are not finite: what "
        "uses them is not drawn"
    ]


def _coarse(document: Document) -> list[str]:
    boxed = [one for one in document.objects if one.pose is None and _is_box(one.mesh)]
    if not boxed:
        return []
    boxes = np.array([entry.mesh.bounds for entry in boxed])
    size, reach = _size(boxes), float(np.abs(boxes).max())
    apart = float(np.spacing(np.float32(reach)))
    if not (reach > 0.0 and apart > _COARSEST * size):
        return []
    return [
        f"coordinates reach {reach:.7g}, where 32-bit floats are {apart:.2g} apart, but the model "
        f"is {size:.3g} across: its shapes are coarse; load_scene moves the origin near it"
    ]


def _is_box(mesh: Mesh) -> bool:
    """Return whether there are at least two vertices."""
    if mesh.bounds[0].tolist() != mesh.bounds[1].tolist():
        return True
    return int(np.isfinite(mesh.positions).all(axis=1).sum()) > 1


def _size(boxes: np.ndarray) -> float:
    """Return the longest side of the box around boxes, (N, 2, 3)."""
    return float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())
