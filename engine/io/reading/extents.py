"""Detects models too far from the origin to be drawn precisely.

In: a `Document` of any reader. Out: a warning if its meshes, with 32-bit coordinates, are too far.
Distances held by objects' poses do not matter.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .documents import Document

if TYPE_CHECKING:
    from ...model.geometry.mesh import Mesh

# The largest gap between 32-bit floats, relative to the size: half a pixel of a picture 2048 wide.
_COARSEST = 2.0**-12


def extent_warnings(document: Document) -> list[str]:
    """Return the warnings about the size and position of a document's meshes."""
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
