"""Scales a document: its meshes and the poses of its nodes, so that lengths have another unit.

In: a `Document` of meshes and nodes at rest, as converters of CAD make them. Out: the same, larger.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..reading.documents import Document
from ..scenes.document_trees import NodeRecord


def scale_document(document: Document, factor: float) -> None:
    """Multiply all lengths of meshes and places of nodes; a mesh that is shown twice, once."""
    shown = [one.mesh for one in document.objects]
    if document.tree is not None:
        shown += [part.mesh for record in document.tree.meshes for part in record.parts]
        nodes = tuple(_scaled_node(node, factor) for node in document.tree.nodes)
        document.tree = replace(document.tree, nodes=nodes)
    for mesh in {id(mesh): mesh for mesh in shown}.values():
        mesh.positions = mesh.positions * np.float32(factor)
    document.objects = [
        one._replace(pose=None if one.pose is None else _scaled_pose(one.pose, factor))
        for one in document.objects
    ]


def _scaled_node(node: NodeRecord, factor: float) -> NodeRecord:
    place = node.translation
    return replace(
        node,
        translation=None if place is None else tuple(part * factor for part in place),
        matrix=None if node.matrix is None else _scaled_pose(node.matrix, factor),
    )


def _scaled_pose(pose: np.ndarray, factor: float) -> np.ndarray:
    scaled = pose.copy()
    scaled[:3, 3] *= factor
    return scaled
