"""Rays against the faces of a scene, and what a pixel of a frame shows.

In: a scene, rays in world space, or a frame and a pixel. Out: the nearest hits. C searches, through
trees of nodes, instances and triangles, in float64: the same bits on every machine.
"""

from __future__ import annotations

import math
import numbers
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import linalg
from .._native.rasterizer import CULLS
from .._support.calls import shows_annotations
from .._support.numbers import floats, shown
from .._support.validation import choose, how_far, vector3
from ..errors import InvalidArgumentError
from ..motion.shown import placing_pose, shown_object
from ..rendering.frame import Frame
from ..scene.instances import InstancedMesh
from ..scene.nodes import Node
from ._shapes import tell

_LAYERS = 256  # faces that are not drawn, one behind the other, that a pick looks through


@shows_annotations
class RayHit(NamedTuple):
    """Where a ray meets a face.

    Attributes
    ----------
    node : Node
    instance : int
        Row of the instances; 0 for a plain mesh.
    face : int
        Index into ``mesh.faces``.
    distance : float
        From the ray's origin, in world units.
    position, normal : (3,) float64
        World space; the unit normal of the face's front.
    barycentric : (3,) float64
        Weights of the face's vertices.
    """

    node: Node
    instance: int
    face: int
    distance: float
    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    barycentric: NDArray[np.float64]


@shows_annotations
class RayHits(NamedTuple):
    """Where many rays meet faces: a row per ray.

    Attributes
    ----------
    object_id, instance, face : (N,) int32
        -1 where a ray meets nothing.
    distance : (N,) float64
        Infinite where a ray meets nothing; the other arrays are then zero.
    position, normal, barycentric : (N, 3) float64
    """

    object_id: NDArray[np.int32]
    instance: NDArray[np.int32]
    face: NDArray[np.int32]
    distance: NDArray[np.float64]
    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    barycentric: NDArray[np.float64]


def raycast(scene: Any, origin: Any, direction: Any, max_distance: Any, cull: Any) -> RayHit | None:
    """See `Scene.raycast`."""
    origin, direction = vector3(origin, "origin"), vector3(direction, "direction")
    ids, values = _cast(scene, origin[np.newaxis], direction[np.newaxis], max_distance, cull)
    slot, instance, face = ids[0].tolist()
    if slot < 0:
        return None
    position, normal, barycentric = values[0, 1:].reshape(3, 3)
    node = scene._arrays.nodes[slot]
    return RayHit(node, instance, face, float(values[0, 0]), position, normal, barycentric)


def raycast_many(
    scene: Any, origins: Any, directions: Any, max_distance: Any, cull: Any
) -> RayHits:
    """See `Scene.raycast_many`."""
    origins, directions = _vectors(origins, "origins"), _vectors(directions, "directions")
    try:
        origins, directions = np.broadcast_arrays(origins, directions)
    except ValueError:
        raise InvalidArgumentError("origins and directions must be equally many") from None
    ids, values = _cast(scene, origins, directions, max_distance, cull)
    met = ids[:, 0] >= 0
    values[~met] = 0.0
    values[~met, 0] = np.inf
    ids[met, 0] = scene._arrays.columns["id"][ids[met, 0]]
    parts = values[:, 1:4], values[:, 4:7], values[:, 7:]
    object_id, instance, face = ids.T.copy()
    position, normal, barycentric = (part.copy() for part in parts)
    distance = values[:, 0].copy()
    return RayHits(object_id, instance, face, distance, position, normal, barycentric)


def _cast(
    scene: Any, origins: Any, directions: Any, max_distance: Any, cull: Any
) -> tuple[np.ndarray, np.ndarray]:
    if not directions.any(axis=1).all():
        raise InvalidArgumentError("direction must not be the zero vector")
    max_distance = how_far(max_distance, "max_distance")
    number = CULLS[choose(cull, CULLS, "cull")]
    scene._update()
    objects = scene._objects
    origins = np.ascontiguousarray(origins)
    directions = np.ascontiguousarray(linalg.normalize(directions))
    ids = np.empty((len(origins), 3), np.int32)
    values = np.empty((len(origins), 10))
    done, missing = 0, 0
    while missing >= 0:
        done, missing = scene._arrays.cast(
            objects.shapes, origins, directions, max_distance, number, ids, values, done
        )
        if missing >= 0:
            tell(objects.shapes, missing, objects.objects[missing])
    return ids, values


def _vectors(value: Any, what: str) -> np.ndarray:
    vectors = np.atleast_2d(floats(value, what))
    if vectors.ndim != 2 or vectors.shape[1] != 3:
        raise InvalidArgumentError(f"{what} must have shape (N, 3), not {vectors.shape}")
    if not np.isfinite(vectors).all():
        raise InvalidArgumentError(f"{what} must be finite")
    return vectors


def pick(scene: Any, frame: Any, x: int, y: int) -> RayHit | None:
    """See `Scene.pick`."""
    if not isinstance(frame, Frame):
        raise InvalidArgumentError(f"frame must be a Frame, not {type(frame).__name__}")
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
    near, direction, length, eye = _pixel_ray(frame, x, y)
    if not {"object_id", "instance_id", "triangle_id"} <= set(frame.outputs):
        return _from(eye, _drawn_hit(scene, near, direction, length, frame._seen[1]))
    number, face = int(frame.object_id[y, x]), int(frame.triangle_id[y, x])
    node = None if number < 0 else scene._node_of(number)
    if node is None:
        return None
    instance = int(frame.instance_id[y, x])
    hit = _drawn_hit(scene, near, direction, length, frame._seen[1])
    if node.object is None:  # several nodes show as this one: levels of detail
        return (
            None
            if hit is None
            else _from(eye, hit._replace(node=node, instance=instance, face=face))
        )
    if hit is None or (hit.node, hit.instance, hit.face) != (node, instance, face):
        if not _has_face(node.object, instance, face):
            return None
        hit = _hit_of_face(node, instance, face, near, direction)
    return _from(eye, hit)


def _pixel_ray(frame: Any, x: int, y: int) -> Any:
    """The ray through a pixel's centre, from the near plane on: origin, unit direction, length."""
    view, _ = frame._seen
    world_from_clip = linalg.inverse(view.clip_from_world)
    across = 2.0 * (x + 0.5) / frame.width - 1.0
    upward = 1.0 - 2.0 * (y + 0.5) / frame.height
    end = view.camera._far_depth
    depths = -1.0, (end - 1.0) * 0.5, end
    near, within, far = (_unproject(world_from_clip, across, upward, z) for z in depths)
    direction = linalg.normalize(within - near)
    length = math.inf if far is None else float(linalg.dot(far - near, direction))
    return near, direction, length, view.eye


def _unproject(world_from_clip: np.ndarray, x: float, y: float, z: float) -> Any:
    rows = world_from_clip
    point = rows[:, 0] * x + rows[:, 1] * y + rows[:, 2] * z + rows[:, 3]
    if not abs(point[3]) > 1e-12 * np.abs(rows[3]).max():
        return None  # without a far plane, its points are at infinity
    return point[:3] / point[3]


def _drawn_hit(scene: Any, origin: Any, direction: Any, length: float, cull: str) -> RayHit | None:
    """The nearest face that is drawn: the sides that were culled are looked through."""
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
    if cull == "none" or mesh.materials[mesh.material_ids[hit.face]].two_sided:
        return True
    return (linalg.dot(hit.normal, direction) < 0.0) == (cull == "back")


def _mesh_of(node: Node) -> Any:
    obj = node.object
    return obj.mesh if isinstance(obj, InstancedMesh) else obj


def _has_face(obj: Any, instance: int, face: int) -> bool:
    """Whether what a frame showed is there still."""
    many = isinstance(obj, InstancedMesh)
    return instance < (len(obj) if many else 1) and face < len((obj.mesh if many else obj).faces)


def _hit_of_face(node: Node, instance: int, face: int, origin: Any, direction: Any) -> RayHit:
    """Where a ray meets the plane of a face that the frame says it shows; of a line, nowhere."""
    unknown = np.full(3, np.nan)
    if face < 0:
        return RayHit(node, instance, face, math.nan, unknown, unknown, unknown)
    mesh, pose = shown_object(node), placing_pose(node)
    if isinstance(mesh, InstancedMesh):
        pose = linalg.multiply(pose, mesh._pose_of(instance))
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
    """Measure the distance from the camera; without perspective, from the near plane."""
    if hit is None or eye[3] == 0.0:
        return hit
    return hit._replace(distance=float(linalg.length(hit.position - np.array(eye[:3]))))
