"""Flattens a scene, meshes or instances into meshes with world poses.

In: a `Mesh`, an `InstancedMesh`, a `Scene` or a sequence of meshes. Out: (mesh, world_from_mesh)
one by one, including instances; and the box around all.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from ...base import linalg
from ...base.box_corners import box_corners
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..scene.instances import InstancedMesh, instance_matrices
from ..scene.scene import Scene
from ..scene.shown import placing_pose, shown_object

_IDENTITY = np.eye(4)


def placed_meshes(thing: Any) -> list[tuple[Mesh, np.ndarray]]:
    """Return the meshes that have faces, and their world poses, (4, 4) float64."""
    if isinstance(thing, Scene):
        thing.data.update()
        nodes = [node for node in thing.nodes if node.shown]
        shown = [(shown_object(node), placing_pose(node)) for node in nodes]
        placed = [part for obj, pose in shown for part in _placed(obj, pose)]
    elif isinstance(thing, (Mesh, InstancedMesh)):
        placed = list(_placed(thing, _IDENTITY))
    elif isinstance(thing, Iterable):
        placed = [part for item in thing for part in _placed(_checked(item), _IDENTITY)]
    else:
        _checked(thing)
    return [(mesh, pose) for mesh, pose in placed if len(mesh.faces)]


def _checked(item: Any) -> Any:
    if not isinstance(item, (Mesh, InstancedMesh)):
        raise InvalidArgumentError(f"thing must be a scene or meshes, not {type(item).__name__}")
    return item


def _placed(thing: Any, pose: np.ndarray) -> Iterator[tuple[Mesh, np.ndarray]]:
    if isinstance(thing, Mesh):
        yield thing, pose
    elif isinstance(thing, InstancedMesh):
        for instance in instance_matrices(thing.poses):
            yield thing.mesh, linalg.multiply(pose, instance)


def bounds_of(placed: list[tuple[Mesh, np.ndarray]]) -> np.ndarray:
    """Return the box around placed meshes, (2, 3) float64."""
    boxes = []
    for mesh, pose in placed:
        corners = linalg.transform_points(pose, box_corners(mesh.bounds))
        boxes.append((corners.min(axis=0), corners.max(axis=0)))
    lows, highs = zip(*boxes, strict=True)
    return np.stack([np.min(lows, axis=0), np.max(highs, axis=0)])
