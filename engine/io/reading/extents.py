"""Models that are too far from the origin to be drawn as the file has them.

In: a `Document`, as any reader made it. Out: a warning if its meshes are, whose coordinates are
32-bit floats. Objects whose poses hold the distance are not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .documents import Document

if TYPE_CHECKING:
    from ...model.geometry.mesh import Mesh

# How far apart 32-bit floats may be, as a share of the size: half a pixel of a picture 2048 wide.
_COARSEST = 2.0**-12


def extent_warnings(document: Document) -> list[str]:
    """Return what is to be said about the size and the place of a document's meshes."""
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
    """Whether there are two vertices, which have a distance."""
    if mesh.bounds[0].tolist() != mesh.bounds[1].tolist():
        return True
    return int(np.isfinite(mesh.positions).all(axis=1).sum()) > 1


def _size(boxes: np.ndarray) -> float:
    """The longest side of the box around boxes, (N, 2, 3)."""
    return float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())
