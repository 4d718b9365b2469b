"""Support functions of boxes, points and scenes: how far each extends in a direction.

In: a box, points, or a `Scene`. Out: functions from directions (D, 3) float64, of any length, to
the maximum scalar product of each with any point, (D,) float64. Framing needs nothing else, and
unlike a bounding box this has no empty corners. Non-finite vertices do not count.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from .._native.scene_graph import SHOWN
from ..base import linalg
from ..model.geometry.mesh import Mesh
from ..model.scene.instances import InstancedMesh, instance_matrices
from ..model.scene.scene import Scene
from ..model.scene.shown import as_shown, placing_poses

SupportFunction = Callable[[np.ndarray], np.ndarray]

_BLOCK = 1 << 14  # vertices at a time: three coordinates and a sum fit into the cache
# Up to this many vertices are visited, at some 20 ns each; beyond, only boxes.
_MAX_VERTICES = 1 << 23
_MAX_INSTANCES = 1 << 16


def support_of_box(bounds: ArrayLike) -> SupportFunction:
    """Return the support function of a box, (2, 3)."""
    low, high = np.asarray(bounds, np.float64)
    center, half = (low + high) * 0.5, (high - low) * 0.5
    return lambda directions: linalg.dot(directions, center) + linalg.dot(np.abs(directions), half)


def support_of_points(points: np.ndarray) -> SupportFunction:
    """Return the support function of points, (N, 3); without points it is minus infinity."""
    return lambda directions: _farthest(points, directions)


def support_of_scene(scene: Scene) -> SupportFunction | None:
    """Return the support function of a scene's visible objects, or None if there are none.

    Meshes count with their vertices. If those are too many, boxes replace some of them, which never
    underestimates the extent.
    """
    placed = _Placed()
    scene.data.update()
    arrays = scene.data.arrays
    shown = arrays.columns["flags"][: arrays.count] & SHOWN != 0
    numbers = arrays.columns["object"][: arrays.count]
    slots = np.flatnonzero(shown & (numbers >= 0)).astype(np.int32)
    slots = slots[np.argsort(numbers[slots], kind="stable")]  # those of each object in a row
    poses = placing_poses(arrays, slots)
    shares, starts = np.unique(numbers[slots], return_index=True)
    ends = [*starts[1:].tolist(), len(slots)]
    for number, start, end in zip(shares.tolist(), starts.tolist(), ends, strict=False):
        obj = scene.data.objects.objects[number]
        if obj is not None:
            placed.add(as_shown(obj), poses[start:end])
    return placed.support if placed.count else None


class _Placed:
    """Meshes at the poses of nodes and of single instances."""

    def __init__(self) -> None:
        self.count = 0
        self._meshes: list[Mesh | None] = []  # None if only the box counts
        self._poses: list[np.ndarray] = []
        self._boxes: list[np.ndarray] = []  # one for each array of poses

    def add(self, obj: Mesh | InstancedMesh, poses: np.ndarray) -> None:
        """Add an object at each of the world poses (K, 4, 4)."""
        if isinstance(obj, Mesh):
            if len(obj.positions):
                self._add(obj, poses, obj.bounds)
            return
        box = obj.bounds_in_node()
        if box is not None and len(obj) > _MAX_INSTANCES:
            self._add(None, poses, box)
        elif box is not None:
            instances = instance_matrices(obj.poses)
            instances = instances[np.isfinite(instances).all(axis=(1, 2))]
            for pose in poses:
                self._add(obj.mesh, linalg.multiply(pose, instances), obj.mesh.bounds)

    def _add(self, mesh: Mesh | None, poses: np.ndarray, box: np.ndarray) -> None:
        self.count += len(poses)
        self._meshes += [mesh] * len(poses)
        self._poses.append(poses)
        self._boxes.append(box)

    @cached_property
    def _joined(self) -> tuple[np.ndarray, np.ndarray]:
        """All poses, and the box at each; nothing is added once they are asked for."""
        counts = [len(poses) for poses in self._poses]
        return np.concatenate(self._poses), np.array(self._boxes).repeat(counts, axis=0)

    def support(self, directions: np.ndarray) -> np.ndarray:
        """Return the support, searching vertices only where the boxes extend farthest."""
        poses, boxes = self._joined
        local, offset = _in_their_own_space(poses, directions)
        center, half = (boxes[:, 0] + boxes[:, 1]) * 0.5, (boxes[:, 1] - boxes[:, 0]) * 0.5
        bound = linalg.dot(local, center[:, np.newaxis])
        bound = offset + bound + linalg.dot(np.abs(local), half[:, np.newaxis])
        farthest, most = np.full(len(directions), -np.inf), bound.max(axis=0)
        budget = _MAX_VERTICES
        for column in range(len(directions)):
            while True:
                row = int(bound[:, column].argmax())
                if not bound[row, column] > farthest[column]:
                    break
                mesh = self._meshes[row]
                if mesh is None or len(mesh.positions) > budget:
                    found = bound[row]
                else:
                    budget -= len(mesh.positions)
                    found = offset[row] + _farthest(mesh.positions, local[row])
                farthest = np.maximum(farthest, found)
                bound[row] = -np.inf
        return np.where(np.isfinite(farthest), farthest, most)


def _in_their_own_space(poses: np.ndarray, directions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return directions (K, D, 3) in the spaces of K poses, and the origins' products (K, D)."""
    columns = (poses[:, np.newaxis, :3, k] for k in range(4))
    *local, offset = (linalg.dot(column, directions) for column in columns)
    return np.stack(local, axis=-1), offset


def _farthest(points: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Return the maximum scalar products of directions (D, 3) with points (N, 3)."""
    farthest = np.full(len(directions), -np.inf)
    for start in range(0, len(points), _BLOCK):
        block = points[start : start + _BLOCK]
        found = _farthest_of_block(block, directions)
        if not np.isfinite(found).all():
            finite = block[np.isfinite(block).all(axis=1)]
            if len(finite) == 0:
                continue
            found = _farthest_of_block(finite, directions)
        farthest = np.maximum(farthest, found)
    return farthest


def _farthest_of_block(points: np.ndarray, directions: np.ndarray) -> np.ndarray:
    x, y, z = points.T.astype(np.float64)
    with np.errstate(invalid="ignore"):
        return np.array([(x * a + y * b + z * c).max() for a, b, c in directions.tolist()])
