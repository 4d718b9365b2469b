"""Saves and restores poses of nodes with the same bits.

In: nodes of a scene. Out: their poses, and also rotation and scale if the pose follows from them to
the bit: so the rotation that was given is restored, which the matrix alone does not determine.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from .nodes import Node
from .scene import Scene


class Placements:
    """The poses of some nodes at the moment of creation.

    Parameters
    ----------
    scene : Scene
    nodes : sequence of Node
        Nodes of the scene.

    Attributes
    ----------
    nodes : tuple of Node
    poses : (N, 4, 4) float64
    rotations : (N, 4) float64
    scales : (N, 3) float64
    has_parts : (N,) bool
        Whether translation, rotation and scale give exactly the pose.
    """

    def __init__(self, scene: Scene, nodes: Sequence[Node]) -> None:
        selection = scene.select(nodes)
        self.nodes = selection.nodes
        self.poses = selection.poses
        self.rotations = selection.rotations
        self.scales = selection.scales
        composed = _composed(self.rotations, self.scales)
        same = composed.view(np.uint64) == self.poses[:, :3, :3].copy().view(np.uint64)
        self.has_parts = same.all(axis=(1, 2))

    def put(self, scene: Scene) -> None:
        """Restore the nodes' poses."""
        scene.select(self.nodes).poses = self.poses
        rows = np.flatnonzero(self.has_parts)
        if len(rows):
            selection = scene.select([self.nodes[row] for row in rows.tolist()])
            selection.rotations = self.rotations[rows]
            selection.scales = self.scales[rows]

    def same(self, other: Placements) -> bool:
        """Return whether another holds the same nodes with the same poses."""
        return self.nodes == other.nodes and all(
            getattr(self, name).tobytes() == getattr(other, name).tobytes()
            for name in ("poses", "rotations", "scales", "has_parts")
        )


def _composed(rotations: NDArray[np.float64], scales: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the upper left of the matrices of `linalg.compose`, (N, 3, 3)."""
    with np.errstate(all="ignore"):
        matrices = linalg.quaternion_to_matrix(rotations)
        return matrices[:, :3, :3] * scales[:, np.newaxis, :]
