"""Raycasts against the faces of a scene.

In: a scene, rays in world space. Out: the nearest hits. C searches trees of nodes, instances and
triangles, in float64: the same bits on every machine.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..._native.rasterizer import CULLS
from ..._native.scene_graph import SHOWN, NativeShapes
from ...base import linalg
from ...base.calls import shows_annotations
from ...base.foreign_names import refuses_foreign_names
from ...base.numbers import floats
from ...base.thread_count import resolve_threads
from ...base.validation import choose, how_far, vector3
from ...errors import InvalidArgumentError
from ..scene.nodes import Node
from ..scene.scene_data import SceneData
from ._shapes import tell


@refuses_foreign_names
@shows_annotations
class RayHit(NamedTuple):
    """The intersection of a ray with a face.

    Attributes
    ----------
    node : Node
    object_id : int
        ``node.id``.
    instance_id : int
        Row in the instances; 0 for a plain mesh.
    face_id : int
        Index into ``mesh.faces``.
    distance : float
        From the ray's origin, in world units.
    position : (3,) float64
        World space.
    normal : (3,) float64
        World space; the unit normal of the front face.
    barycentric : (3,) float64
        Weights of the face's vertices.
    """

    node: Node
    instance_id: int
    face_id: int
    distance: float
    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    barycentric: NDArray[np.float64]

    @property
    def object_id(self) -> int:
        return self.node.id


@refuses_foreign_names
@shows_annotations
class RayHits(NamedTuple):
    """The intersections of many rays with faces: what `RayHit` holds, with a row per ray.

    Attributes
    ----------
    object_id, instance_id, face_id : (N,) int32
        -1 where a ray misses.
    distance : (N,) float64
        In world units; infinite where a ray misses, and the arrays below are then zero.
    position, normal : (N, 3) float64
        World space.
    barycentric : (N, 3) float64
    """

    object_id: NDArray[np.int32]
    instance_id: NDArray[np.int32]
    face_id: NDArray[np.int32]
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
    node = scene.data.arrays.nodes[slot]
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
    ids[met, 0] = scene.data.arrays.columns["id"][ids[met, 0]]
    parts = values[:, 1:4], values[:, 4:7], values[:, 7:]
    object_id, instance, face = ids.T.copy()
    position, normal, barycentric = (part.copy() for part in parts)
    distance = values[:, 0].copy()
    return RayHits(object_id, instance, face, distance, position, normal, barycentric)


def known_shapes(data: SceneData) -> NativeShapes:
    """Return the shapes of a scene's objects, all of which are told that show."""
    data.update()
    table, columns = data.objects, data.arrays.columns
    count = data.arrays.count
    shown = (columns["flags"][:count] & SHOWN) != 0
    for number in np.unique(columns["object"][:count][shown]).tolist():
        if number >= 0 and not table.shapes.knows(number):
            tell(table.shapes, number, table.objects[number])
    return table.shapes


def _cast(
    scene: Any, origins: Any, directions: Any, max_distance: Any, cull: Any
) -> tuple[np.ndarray, np.ndarray]:
    if not directions.any(axis=1).all():
        raise InvalidArgumentError("direction must not be the zero vector")
    max_distance = how_far(max_distance, "max_distance")
    number = CULLS[choose(cull, CULLS, "cull")]
    scene.data.update()
    objects = scene.data.objects
    origins = np.ascontiguousarray(origins)
    directions = np.ascontiguousarray(linalg.normalize(directions))
    ids = np.empty((len(origins), 3), np.int32)
    values = np.empty((len(origins), 10))
    lacks = np.zeros(len(origins), np.int32)
    cast, threads = scene.data.arrays.cast, resolve_threads()
    while not cast(
        objects.shapes, origins, directions, max_distance, number, ids, values, lacks, threads
    ):
        for missing in np.unique(lacks[lacks >= 0]).tolist():
            tell(objects.shapes, missing, objects.objects[missing])
    return ids, values


def _vectors(value: Any, what: str) -> np.ndarray:
    vectors = np.atleast_2d(floats(value, what))
    if vectors.ndim != 2 or vectors.shape[1] != 3:
        raise InvalidArgumentError(f"{what} must have shape (N, 3), not {vectors.shape}")
    if not np.isfinite(vectors).all():
        raise InvalidArgumentError(f"{what} must be finite")
    return vectors
