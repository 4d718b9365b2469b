"""The things of a scene at one moment: what its nodes draw, and where.

In: a scene as it is now. Out: vertices as bent, faces and poses, by the IDs that frames show, which
stay as they are while the scene moves on; the core's list of some of them, as a camera has them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..._native.scene_graph import SHOWN, NativeThings
from ...base import linalg
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh, flat_poses, shown_ids
from ...model.scene.scene import Scene
from ...model.scene.shown import as_shown, placing_poses


class Thing(NamedTuple):
    """What a node draws at a moment: vertices as bent, faces, world pose, poses of instances."""

    positions: NDArray[np.float32]
    faces: NDArray[np.int32]
    pose: NDArray[np.float64]
    poses: NDArray[np.float32] | None


#: Things by the value of object_id.
Things: TypeAlias = Mapping[int, Thing]


def things_of(scene: Scene) -> Things:
    """Return what the scene's visible nodes draw.

    IDs that several visible nodes share are left out: their faces cannot be told apart.
    """
    data = scene.data
    data.update()
    arrays, count = data.arrays, data.arrays.count
    columns = arrays.columns
    is_drawn = (columns["flags"][:count] & SHOWN != 0) & (columns["object"][:count] >= 0)
    slots = np.flatnonzero(is_drawn).astype(np.int32)
    ids, numbers = columns["object_id"][slots], columns["object"][slots]
    found, shares = np.unique(ids, return_counts=True)
    shared = set(found[shares > 1].tolist())
    poses, things = placing_poses(arrays, slots), {}
    for row, (identity, number) in enumerate(zip(ids.tolist(), numbers.tolist(), strict=True)):
        obj = as_shown(data.objects.objects[number])
        if identity not in shared and isinstance(obj, (Mesh, InstancedMesh)):
            things[identity] = _thing_of(obj, poses[row])
    return things


def _thing_of(obj: Mesh | InstancedMesh, pose: NDArray[np.float64]) -> Thing:
    if isinstance(obj, InstancedMesh):
        return Thing(obj.mesh.positions, obj.mesh.faces, pose, _poses_by_id(obj))
    return Thing(obj.positions, obj.faces, pose, None)


def _poses_by_id(instances: InstancedMesh) -> NDArray[np.float32]:
    """Return a row for each value of instance_id; NaN for those that are not drawn."""
    poses, ids = flat_poses(instances), shown_ids(instances)
    if ids is None:
        return poses
    rows = np.full((int(ids.max(initial=-1)) + 1, poses.shape[1]), np.nan, np.float32)
    rows[ids] = poses
    return rows


def known_to_both(some: Things, others: Things) -> list[int]:
    """Return the IDs of things that have the same faces at both moments."""
    pairs = ((one, some[one].faces, others[one].faces) for one in some.keys() & others.keys())
    return sorted(one for one, a, b in pairs if a is b or np.array_equal(a, b))


def as_seen(
    things: Things, ids: Iterable[int], view_from_world: NDArray[np.float64]
) -> NativeThings:
    """Return the core's list of some things, as a camera has them."""
    numbers = list(ids)
    thing_of = np.full(max(numbers, default=-1) + 1, -1, np.int32)
    thing_of[numbers] = np.arange(len(numbers))
    native = NativeThings(len(numbers), thing_of)
    chosen = [things[one] for one in numbers]
    poses = np.array([thing.pose for thing in chosen]).reshape(-1, 4, 4)
    poses = linalg.multiply(view_from_world, poses)
    for number, thing in enumerate(chosen):
        native.set(number, thing.positions, thing.faces, poses[number], thing.poses)
    return native
