"""Picking: finds the face that a pixel of a frame shows.

In: the drawn scene, the frame, a pixel. Out: the face that the frame's IDs name, or else the first
hit of a ray through the pixel's centre.
"""

from __future__ import annotations

import math
import numbers
from typing import Any

import numpy as np

from ..base import linalg
from ..base.foreign_arrays import without_axes
from ..base.numbers import shown
from ..errors import InvalidArgumentError
from ..model.scene.cameras import far_depth
from ..model.scene.instances import InstancedMesh, instance_matrices
from ..model.scene.nodes import Node
from ..model.scene.shown import placing_pose, shown_object
from ..model.spatial.rays import RayHit, raycast
from ._lens_view import LensView
from .frame import Frame

_LAYERS = 256  # culled faces, one behind the other, that a pick passes through


def pick(scene: Any, frame: Any, x: int, y: int) -> RayHit | None:
    """Return what a pixel shows; see `Scene.pick`."""
    if not isinstance(frame, Frame):
        raise InvalidArgumentError(f"frame must be a Frame, not {type(frame).__name__}")
    x, y = without_axes(x, "x"), without_axes(y, "y")
    for value in (x, y):
        if not isinstance(value, numbers.Real):
            raise InvalidArgumentError(f"x and y, a pixel, are numbers, not {shown(value)}")
    if not (0 <= x < frame.width and 0 <= y < frame.height):
        raise InvalidArgumentError(
            f"pixel ({x}, {y}) is outside of the frame, {frame.width}x{frame.height}"
        )
    x, y = int(x), int(y)
    if frame._seen is None:
        raise InvalidArgumentError("the frame was not drawn by a Renderer")
    ray = _pixel_ray(frame, x, y)
    if ray is None:
        return None
    near, direction, length, eye = ray
    if not {"object_id", "instance_id", "face_id"} <= set(frame.outputs):
        return _from(eye, _drawn_hit(scene, near, direction, length, frame._seen[1]))
    number, face = int(frame.object_id[y, x]), int(frame.face_id[y, x])
    node = None if number < 0 else scene.data.node_of(number)
    if node is None:
        return None
    instance = int(frame.instance_id[y, x])
    hit = _drawn_hit(scene, near, direction, length, frame._seen[1])
    if node.object is None:  # several nodes show as this one: levels of detail
        return (
            None
            if hit is None
            else _from(eye, hit._replace(node=node, instance_id=instance, face_id=face))
        )
    if hit is None or (hit.node, hit.instance_id, hit.face_id) != (node, instance, face):
        if not _has_face(node.object, instance, face):
            return None
        hit = _hit_of_face(node, instance, face, near, direction)
    return _from(eye, hit)


def _pixel_ray(frame: Any, x: int, y: int) -> Any:
    """Return the ray through a pixel's centre from the near plane: origin, direction, length.

    None outside of what a lens sees, and where rounding leaves no direction: the camera is so far
    from the origin, for the distances of its planes, that these are one place.
    """
    view, _ = frame._seen
    if isinstance(view, LensView):
        return _lens_ray(view, x + 0.5, y + 0.5)
    try:
        world_from_clip = linalg.inverse(view.clip_from_world)
    except InvalidArgumentError:
        return None
    across = 2.0 * (x + 0.5) / frame.width - 1.0
    upward = 1.0 - 2.0 * (y + 0.5) / frame.height
    end = far_depth(view.camera)
    depths = -1.0, (end - 1.0) * 0.5, end
    near, within, far = (_unproject(world_from_clip, across, upward, z) for z in depths)
    if (within == near).all():
        return None
    direction = linalg.normalize(within - near)
    length = math.inf if far is None else float(linalg.dot(far - near, direction))
    return near, direction, length, view.eye


def _lens_ray(view: LensView, x: float, y: float) -> Any:
    """Return the same ray of a lens; its near and far planes are those of a cube's faces."""
    direction = view.ray(x, y)
    if direction is None:
        return None
    slope = float(np.abs(linalg.transform_directions(view.view_from_world, direction)).max())
    near, far = view.camera.znear / slope, view.camera.zfar / slope
    return np.array(view.eye[:3]) + direction * near, direction, far - near, view.eye


def _unproject(world_from_clip: np.ndarray, x: float, y: float, z: float) -> Any:
    rows = world_from_clip
    point = rows[:, 0] * x + rows[:, 1] * y + rows[:, 2] * z + rows[:, 3]
    if not abs(point[3]) > 1e-12 * np.abs(rows[3]).max():
        return None  # without a far plane, its points are at infinity
    return point[:3] / point[3]


def _drawn_hit(scene: Any, origin: Any, direction: Any, length: float, cull: str) -> RayHit | None:
    """Return the nearest drawn face on a ray, which passes through culled sides."""
    gone = 0.0
    for _ in range(_LAYERS):
        start = origin + direction * gone
        hit = raycast(scene, start, direction, max(length - gone, 0.0), "none")
        if hit is None or _is_drawn(hit, direction, cull):
            return hit
        gone = (gone + hit.distance) * (1.0 + 1e-12) + 1e-300
    return None


def _is_drawn(hit: RayHit, direction: np.ndarray, cull: str) -> bool:
    mesh = _mesh_of(hit.node)
    if cull == "none" or mesh.materials[mesh.material_ids[hit.face_id]].two_sided:
        return True
    return (linalg.dot(hit.normal, direction) < 0.0) == (cull == "back")


def _mesh_of(node: Node) -> Any:
    obj = node.object
    return obj.mesh if isinstance(obj, InstancedMesh) else obj


def _has_face(obj: Any, instance: int, face: int) -> bool:
    """Return whether the face that a frame shows still exists."""
    many = isinstance(obj, InstancedMesh)
    return instance < (len(obj) if many else 1) and face < len((obj.mesh if many else obj).faces)


def _hit_of_face(node: Node, instance: int, face: int, origin: Any, direction: Any) -> RayHit:
    """Return the hit of a ray with the plane of the face that the frame shows; None for a line."""
    unknown = np.full(3, np.nan)
    if face < 0:
        return RayHit(node, instance, face, math.nan, unknown, unknown, unknown)
    mesh: Any = shown_object(node)
    pose = placing_pose(node)
    if isinstance(mesh, InstancedMesh):
        pose = linalg.multiply(pose, instance_matrices(mesh.poses[instance : instance + 1])[0])
        mesh = mesh.mesh
    a, b, c = linalg.transform_points(pose, mesh.positions[mesh.faces[face]])
    across = linalg.cross(b - a, c - a)
    normal = linalg.normalize(across)
    along = float(linalg.dot(normal, direction))
    distance = float(linalg.dot(normal, a - origin)) / along if along else math.nan
    position = origin + direction * distance
    area = float(linalg.dot(across, across)) or 1.0
    v = float(linalg.dot(linalg.cross(position - a, c - a), across)) / area
    w = float(linalg.dot(linalg.cross(b - a, position - a), across)) / area
    mirrored = linalg.dot(linalg.cross(pose[:3, 0], pose[:3, 1]), pose[:3, 2]) < 0.0
    return RayHit(
        node,
        instance,
        face,
        distance,
        position,
        -normal if mirrored else normal,
        np.array((1.0 - v - w, v, w)),
    )


def _from(eye: Any, hit: RayHit | None) -> RayHit | None:
    """Measure the distance from the camera or, without perspective, from the near plane."""
    if hit is None or eye[3] == 0.0:
        return hit
    return hit._replace(distance=float(linalg.length(hit.position - np.array(eye[:3]))))
