"""The object that a node shows, in its current deformation, and its pose.

In: a node whose scene is up to date. Out: a mesh and its world pose. Rays, colliders and everything
else that reads vertices use it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..motion.posed_mesh import PosedMesh

if TYPE_CHECKING:
    from ..geometry.mesh import Mesh
    from .instances import InstancedMesh
    from .node_arrays import NodeArrays
    from .nodes import Node, SceneObject

    #: The drawable objects of a node.
    Drawn: TypeAlias = Mesh | InstancedMesh | PosedMesh

Held = TypeVar("Held")


def shown_object(node: Node) -> SceneObject | None:
    """Return the node's object; for a deformed mesh, one with its current vertices."""
    return as_shown(node._drawn)


def as_shown(drawn: Held | PosedMesh) -> Held | Mesh:
    """Return the drawn object as a mesh or instances."""
    return drawn.now() if isinstance(drawn, PosedMesh) else drawn


def placing_poses(arrays: NodeArrays, slots: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return the world poses (N, 4, 4) of what nodes draw, as of the last update."""
    anchors = arrays.columns["anchor"][slots]
    poses = arrays.world_poses(np.where(anchors < 0, slots, anchors))
    poses[anchors == slots] = np.eye(4)
    return poses


def placing_pose(node: Node) -> NDArray[np.float64]:
    """Return the world pose of what a node draws."""
    arrays, slot = node._arrays, node._slot
    anchor = int(arrays.columns["anchor"][slot])
    return np.eye(4) if anchor == slot else arrays.world_pose(slot if anchor < 0 else anchor)
