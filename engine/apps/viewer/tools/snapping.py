"""Snaps clicks to corners and edges of what they hit.

In: a hit, and the frame that shows it. Out: the corner or the point of an edge that is near in the
picture, else the place that was hit.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....base import linalg
from ....model.geometry.mesh import Mesh
from ....model.scene.instances import InstancedMesh, instance_matrices
from ....model.scene.shown import placing_pose, shown_object
from ....model.spatial.rays import RayHit
from ....rendering.frame import Frame

#: Distances in pixels within which corners and edges are meant, times the scale.
_CORNER_REACH, _EDGE_REACH = 10.0, 7.0


class Snapped(NamedTuple):
    """A point (3,) in world space, and what it is: ``"corner"``, ``"edge"`` or ``"face"``."""

    point: NDArray[np.float64]
    kind: str


def snap(hit: RayHit, frame: Frame, scale: int = 1) -> Snapped:
    """Return the corner, the edge or the place that a click on a face means."""
    face = _face(hit)
    if face is None:
        return Snapped(hit.position, "face")
    corners, visible = face
    pixels, _ = frame.project(np.concatenate([corners, hit.position[np.newaxis]]))
    away = _lengths(pixels[:3] - pixels[3])
    nearest = int(np.argmin(away))
    if away[nearest] <= _CORNER_REACH * scale:
        return Snapped(corners[nearest], "corner")
    ends = np.roll(corners, -1, axis=0)
    on_edges = np.array(
        [_on_segment(hit.position, a, b) for a, b in zip(corners, ends, strict=True)]
    )
    away = _lengths(frame.project(on_edges)[0] - pixels[3])
    away[~visible] = np.inf
    nearest = int(np.argmin(away))
    if away[nearest] <= _EDGE_REACH * scale:
        return Snapped(on_edges[nearest], "edge")
    return Snapped(hit.position, "face")


def _lengths(steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the lengths of steps in the picture, (N, 2); infinite behind the camera."""
    lengths: NDArray[np.float64] = np.sqrt((steps * steps).sum(axis=1))
    return np.where(np.isfinite(lengths), lengths, np.inf)


def _face(hit: RayHit) -> tuple[NDArray[np.float64], NDArray[np.bool_]] | None:
    """Return the corners (3, 3) of the face that was hit, in world space; which edges are seen."""
    thing, pose = shown_object(hit.node), placing_pose(hit.node)
    if isinstance(thing, InstancedMesh):
        pose = linalg.multiply(pose, instance_matrices(thing.poses)[hit.instance_id])
        thing = thing.mesh
    if not isinstance(thing, Mesh) or not 0 <= hit.face_id < len(thing.faces):
        return None
    corners = linalg.transform_points(pose, thing.positions[thing.faces[hit.face_id]])
    edges = thing.edge_visible
    return corners, np.ones(3, bool) if edges is None else edges[hit.face_id]


def _on_segment(
    point: NDArray[np.float64], a: NDArray[np.float64], b: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the point of a segment that is nearest to another point."""
    along = b - a
    square = float(linalg.dot(along, along))
    share = float(linalg.dot(point - a, along)) / square if square else 0.0
    return a + along * min(max(share, 0.0), 1.0)
