"""Totals of a tree's default scene: its triangle count, and its bounds at rest.

In: a `TreeRecord`. Out: numbers. Hidden nodes do not count.
"""

from __future__ import annotations

import numpy as np

from ...base import linalg
from ...model.geometry.mesh import Mesh
from .document_trees import NodeRecord, TreeRecord
from .tree_posing import RestPose

# If more vertices than this would have to be placed, the corners of the meshes' boxes are placed
# instead.
_MOST_PLACED = 1 << 26


def triangle_count(tree: TreeRecord) -> int:
    """Return the number of drawn triangles, including each instance."""
    total = 0
    for shown in RestPose(tree).nodes:
        node = tree.nodes[shown.number]
        if shown.visible:
            times = 1 if node.instances is None else len(node.instances)
            total += times * sum(len(part.mesh.faces) for part in tree.parts(node))
    return total


def rest_bounds(tree: TreeRecord) -> list[list[float]] | None:
    """Return the world bounds at rest, with skins and morph weights applied.

    None if nothing is visible. Non-finite vertices do not count.
    """
    rest = RestPose(tree)
    drawn = [shown for shown in rest.nodes if shown.visible]
    is_exact = sum(_vertices(tree, tree.nodes[shown.number]) for shown in drawn) <= _MOST_PLACED
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for shown in drawn:
        for mesh, pose in rest.posed(shown):
            points = mesh.positions if is_exact else _corners(mesh)
            placed = linalg.transform_points(pose, points)
            placed = placed[np.isfinite(placed).all(axis=1)]
            low = np.minimum(low, placed.min(axis=0, initial=np.inf))
            high = np.maximum(high, placed.max(axis=0, initial=-np.inf))
    return None if (low > high).any() else [low.tolist(), high.tolist()]


def _vertices(tree: TreeRecord, node: NodeRecord) -> int:
    """Return the number of vertices that a node shows."""
    times = 1 if node.instances is None else len(node.instances)
    return times * sum(len(part.mesh.positions) for part in tree.parts(node))


def _corners(mesh: Mesh) -> np.ndarray:
    """Return the corners of a mesh's box."""
    low, high = mesh.bounds
    choices = np.array(np.meshgrid(*zip(low, high, strict=True), indexing="ij"))
    return choices.reshape(3, -1).T
