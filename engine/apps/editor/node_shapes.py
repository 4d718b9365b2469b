"""Line drawings of nodes that have no surface: lights, cameras, empties, and of colliders.

In: a node, a length. Out: segments in world space, (N, 2, 3) float64. Lights shine along -Z;
their sizes are in world units whatever their node's scale.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.scene.cameras import Camera, OrthographicCamera, far_depth
from ...model.scene.lights import (
    DirectionalLight,
    DiscLight,
    PointLight,
    RectangleLight,
    SpotLight,
    TubeLight,
)
from ...model.scene.nodes import Node
from ...model.spatial.colliders import BoxCollider, SphereCollider

Segments = NDArray[np.float64]
_ROUND = 32
_BOX = np.array([(a, a | bit) for a in range(8) for bit in (1, 2, 4) if not a & bit])
_CORNERS = np.indices((2, 2, 2)).reshape(3, -1).T
#: Sides of the picture that stands for a camera.
_FRAME = (160, 90)
#: More edges of a mesh would fill the picture.
MOST_EDGES = 4000
_NONE: Segments = np.zeros((0, 2, 3))


def icon(node: Node, reach: float) -> Segments:
    """Return a small drawing of what a node holds, ``reach`` world units large."""
    held, pose = node.object, _rigid(node.world_pose)
    if isinstance(held, DirectionalLight):
        along = linalg.normalize(linalg.transform_directions(node.world_pose, held.direction))
        start = node.world_pose[:3, 3]
        return np.concatenate([_at(pose, _ball(0.25 * reach)), _arrow_of(start, along * reach)])
    if isinstance(held, SpotLight):
        return _at(pose, _cone(held.outer_cone_angle, reach))
    if isinstance(held, RectangleLight):
        return _at(pose, _rectangle(0.7 * reach, 0.7 * reach, reach))
    if isinstance(held, DiscLight):
        return _at(pose, np.concatenate([_circle(0.5 * reach), _arrow(reach)]))
    if isinstance(held, TubeLight):
        return _at(pose, np.array([[(-reach / 2, 0, 0), (reach / 2, 0, 0)]]))
    if isinstance(held, Camera):
        return _at(pose, _frustum_icon(held, reach))
    if held is None:
        return _at(pose, _cross(reach / 2))
    return _at(pose, _star(reach / 2))


def outline(node: Node, reach: float) -> Segments:
    """Return what a selected light lights: its cone, its surface, its range.

    ``reach`` is how far it is drawn where it has no end.
    """
    held, pose = node.object, _rigid(node.world_pose)
    if isinstance(held, DirectionalLight):
        along = linalg.normalize(linalg.transform_directions(node.world_pose, held.direction))
        start = node.world_pose[:3, 3]
        return _arrow_of(start, along * reach)
    if isinstance(held, SpotLight):
        far = min(held.range, reach)
        cones = [_cone(held.outer_cone_angle, far)]
        if held.inner_cone_angle > 0.0:
            cones.append(
                _circle(far * _sine(held.inner_cone_angle), -far * _cosine(held.inner_cone_angle))
            )
        return _at(pose, np.concatenate(cones))
    if isinstance(held, RectangleLight):
        return _at(pose, _rectangle(held.width, held.height, reach / 4))
    if isinstance(held, DiscLight):
        return _at(pose, np.concatenate([_circle(held.radius), _arrow(reach / 4)]))
    if isinstance(held, TubeLight):
        return _at(pose, _tube(held.length, held.radius))
    if isinstance(held, PointLight) and math.isfinite(held.range):
        return _at(pose, _ball(held.range))
    return _NONE


def collider_lines(node: Node) -> Segments:
    """Return the outline of a node's collider; none if it has none."""
    collider, pose = node.collider, node.world_pose
    if isinstance(collider, SphereCollider):
        largest = float(linalg.length(pose[:3, :3].T).max())
        middle = linalg.translation(linalg.transform_points(pose, collider.center))
        return _at(middle, _ball(collider.radius * largest))
    if collider is None:
        return _NONE
    mesh = node.object if isinstance(node.object, Mesh) else None
    if isinstance(collider, BoxCollider):
        box = collider.box if collider.box is not None else mesh.bounds
        corners = linalg.transform_points(pose, np.asarray(box, np.float64)[_CORNERS, np.arange(3)])
        return box_lines(corners.min(axis=0), corners.max(axis=0))
    mesh = mesh if collider.mesh is None else collider.mesh
    points = linalg.transform_points(pose, mesh.positions.astype(np.float64))
    faces = mesh.faces[: MOST_EDGES // 3]
    return points[faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)]


def camera_frustum(node: Node, size: tuple[int, int], reach: float) -> Segments:
    """Return a camera's frustum for a picture of some size, cut off at ``reach``."""
    camera = node.object
    unprojected = linalg.inverse(camera.projection(size))
    corners = 2.0 * _CORNERS - 1.0
    corners[1::2, 2] = far_depth(camera)
    points = linalg.transform_points(unprojected, corners)
    near, far = points[::2], points[1::2]  # the last index is that of depth
    if not float(np.abs(far).max()) <= reach:  # infinite, or too far for meaningful lines
        points[1::2] = near * (reach / max(float(np.abs(near).max()), 1e-12))
    return linalg.transform_points(node.world_pose, points)[_BOX]


def _rigid(pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a pose without its scale."""
    rigid = pose.copy()
    rigid[:3, :3] = linalg.normalize(np.ascontiguousarray(pose[:3, :3].T)).T
    return rigid


def _at(pose: NDArray[np.float64], segments: Segments) -> Segments:
    return linalg.transform_points(pose, segments.reshape(-1, 3)).reshape(-1, 2, 3)


def _ring(points: NDArray[np.float64]) -> Segments:
    """Return the segments of a closed line through points, (N, 3)."""
    return np.stack([points, np.roll(points, -1, axis=0)], axis=1)


def _circle(radius: float, z: float = 0.0) -> Segments:
    x, y = linalg.unit_circle(_ROUND)
    return _ring(np.stack([radius * x, radius * y, np.full(_ROUND, z)], axis=1))


def _ball(radius: float) -> Segments:
    """Return three great circles."""
    circle = _circle(radius)
    return np.concatenate([circle, circle[:, :, [2, 0, 1]], circle[:, :, [1, 2, 0]]])


def _sine(angle: float) -> float:
    return float(linalg.sin(angle))


def _cosine(angle: float) -> float:
    return float(linalg.cos(angle))


def _cone(angle: float, reach: float) -> Segments:
    """Return a cone from the origin along -Z, its round edge at a distance of ``reach``."""
    rim = _circle(reach * _sine(angle), -reach * _cosine(angle))
    sides = np.stack([np.zeros((4, 3)), rim[:: _ROUND // 4, 0]], axis=1)
    return np.concatenate([rim, sides])


def _arrow(reach: float) -> Segments:
    return _arrow_of(np.zeros(3), np.array([0.0, 0.0, -reach]))


def _arrow_of(start: NDArray[np.float64], along: NDArray[np.float64]) -> Segments:
    """Return an arrow from a point."""
    tip, side = start + along, _beside(along)
    head = [tip - 0.15 * along + sign * 0.08 * side for sign in (-1.0, 1.0)]
    return np.array([(start, tip), (head[0], tip), (head[1], tip)])


def _beside(along: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a vector across another, of the same length."""
    axis = np.eye(3)[int(np.argmin(np.abs(along)))]
    return linalg.normalize(linalg.cross(along, axis)) * float(linalg.length(along))


def _rectangle(width: float, height: float, reach: float) -> Segments:
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    points = np.array([(x * width / 2, y * height / 2, 0.0) for x, y in corners])
    return np.concatenate([_ring(points), _arrow(reach)])


def _tube(length: float, radius: float) -> Segments:
    """Return a tube along X."""
    circle = _circle(radius)[:, :, [2, 0, 1]]
    ends = [circle + np.array([side * length / 2, 0.0, 0.0]) for side in (-1.0, 1.0)]
    sides = np.stack([end[:: _ROUND // 4, 0] for end in ends], axis=1)
    return np.concatenate([*ends, sides])


def _star(reach: float) -> Segments:
    """Return rays in all directions, between two circles."""
    x, y = linalg.unit_circle(8)
    rays = [np.stack([x, y, 0 * x], axis=1), np.stack([0 * x, x, y], axis=1)]
    return np.concatenate([np.stack([0.5 * ray, ray], axis=1) for ray in rays]) * reach


def _cross(reach: float) -> Segments:
    return np.stack([-np.eye(3), np.eye(3)], axis=1) * reach


def box_lines(low: NDArray[np.float64], high: NDArray[np.float64]) -> Segments:
    """Return the edges of a box."""
    return np.stack([low, high])[_CORNERS, np.arange(3)][_BOX]


def _frustum_icon(camera: Camera, reach: float) -> Segments:
    """Return a pyramid, or a box without perspective, with a mark at its upper side."""
    width, height = (0.5 * reach * side / _FRAME[0] for side in _FRAME)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (width, height)
    front = np.column_stack([corners, np.full(4, -0.8 * reach)])
    back = front * (1, 1, 0) if isinstance(camera, OrthographicCamera) else np.zeros((4, 3))
    mark = np.array([(-0.4 * width, height, 0), (0.4 * width, height, 0), (0, 1.7 * height, 0)])
    mark[:, 2] = -0.8 * reach
    return np.concatenate([_ring(front), np.stack([back, front], axis=1), _ring(mark)])
