"""The object that a node shows, as it is bent now, and its pose.

In: a node whose scene is up to date. Out: a mesh and its world pose. For rays, colliders and all
others that look at vertices.
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

    #: What of a node is drawn.
    Drawn: TypeAlias = Mesh | InstancedMesh | PosedMesh

Held = TypeVar("Held")


def shown_object(node: Node) -> SceneObject | None:
    """Return the node's object; of a mesh that is bent, one with the vertices as they are."""
    return as_shown(node._drawn)


def as_shown(drawn: Held | PosedMesh) -> Held | Mesh:
    """Return what is drawn as an object of a node."""
    return drawn.now() if isinstance(drawn, PosedMesh) else drawn


def placing_poses(arrays: NodeArrays, slots: NDArray[np.int32]) -> NDArray[np.float64]:
    """Return the world poses (N, 4, 4) that place what nodes draw, as of the last update."""
    anchors = arrays.columns["anchor"][slots]
    poses = arrays.world_poses(np.where(anchors < 0, slots, anchors))
    poses[anchors == slots] = np.eye(4)
    return poses


def placing_pose(node: Node) -> NDArray[np.float64]:
    """Return the world pose that places what a node draws."""
    return placing_poses(node._arrays, np.array([node._slot], np.int32))[0]
