"""Models that are too small, or too far from the origin, to be drawn as the file has them.

In: a `Document`, as any reader made it. Out: a warning for each of the two that holds. Coordinates
are 32-bit floats, and what is nearer to the eye than a fixed distance is clipped away (WMIN in
docs/exactness.md).
"""

from __future__ import annotations

import numpy as np

from .documents import Document, DocumentObject

_NEAREST = 2.0**-20  # to the eye: E3D_W_MIN of csrc/core/limits.h
# A camera that shows a whole model comes as near as two thirds of its size.
_LEAST_SIZE = 2.0 * _NEAREST
# How far apart 32-bit floats may be, as a share of the size: half a pixel of a picture 2048 wide.
_COARSEST = 2.0**-12


def extent_warnings(document: Document) -> list[str]:
    """Return what is to be said about the size and the place of a document's meshes."""
    boxed = [entry for entry in document.objects if _is_box(entry.mesh)]
    if not boxed:
        return []
    found = []
    size = _size(_posed_boxes(boxed))
    if 0.0 < size < _LEAST_SIZE:
        found.append(
            f"the model is {size:.2g} units across, too small to be drawn: nothing nearer to the "
            f"camera than {_NEAREST:.2g} is; scale it up"
        )
    boxes = np.array([entry.mesh.bounds for entry in boxed if entry.pose is None])
    if len(boxes):
        size, reach = _size(boxes), float(np.abs(boxes).max())
        apart = float(np.spacing(np.float32(reach)))
        if reach > 0.0 and apart > _COARSEST * size:
            found.append(
                f"coordinates reach {reach:.7g}, where 32-bit floats are {apart:.2g} apart, but "
                f"the model is {size:.3g} across: its shapes are coarse; move it to the origin"
            )
    return found


def _is_box(mesh) -> bool:
    """Whether there are two vertices, which have a distance."""
    if mesh.bounds[0].tolist() != mesh.bounds[1].tolist():
        return True
    return int(np.isfinite(mesh.positions).all(axis=1).sum()) > 1


def _size(boxes: np.ndarray) -> float:
    """The longest side of the box around boxes, (N, 2, 3)."""
    return float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())


def _posed_boxes(entries: list[DocumentObject]) -> np.ndarray:
    """The boxes around the boxes of objects where these stand, (N, 2, 3)."""
    boxes = np.array([entry.mesh.bounds for entry in entries])
    poses = np.array([np.eye(4) if entry.pose is None else entry.pose for entry in entries])
    middle, half = boxes.sum(axis=1) * 0.5, (boxes[:, 1] - boxes[:, 0]) * 0.5
    middle = (poses[:, :3, :3] * middle[:, np.newaxis]).sum(axis=2) + poses[:, :3, 3]
    half = (np.abs(poses[:, :3, :3]) * half[:, np.newaxis]).sum(axis=2)
    return np.stack([middle - half, middle + half], axis=1)
