"""The poses of a tree's nodes, and the rest shapes of its meshes.

In: a `TreeRecord`. Out: matrices and vertices in float64, single operations in the written order,
so that they have the same bits on every machine. At rest, morph targets have the weights of their
node or mesh, and skins follow their joints' poses in the file.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...base import linalg
from ...base.linalg import single
from ...model.geometry.mesh import Mesh
from ...model.geometry.normals import unit_vectors
from ...model.geometry.values import put_values
from ...model.geometry.vertex_attributes import attributes_of
from ...model.materials.linear_colors import floats_are_linear, marked
from .document_trees import MeshRecord, NodeRecord, SkinRecord, TreeRecord

_IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))
# Vertices deformed at a time.
_BLOCK = 1 << 14


class ShownNode(NamedTuple):
    """A node of the default scene.

    Attributes
    ----------
    number : int
        Its number in the tree.
    parent : int
        The parent's number; -1: none.
    world : (4, 4) float64
        world-from-node.
    visible : bool
        Whether neither it nor an ancestor is hidden.
    """

    number: int
    parent: int
    world: np.ndarray
    visible: bool


def shown_nodes(tree: TreeRecord) -> list[ShownNode]:
    """Return the nodes of the default scene, parents first."""
    found = []
    waiting: list[tuple[int, int, single.Rows, bool]]
    waiting = [(root, -1, _IDENTITY, True) for root in reversed(tree.roots)]
    unmoved = np.array(_IDENTITY)  # one array for all: files may have very many
    unmoved.setflags(write=False)
    while waiting:
        number, parent, above, visible = waiting.pop()
        node = tree.nodes[number]
        local = local_pose(node)
        is_moved = above is not _IDENTITY or local is not _IDENTITY
        world = single.multiply(above, local) if is_moved else _IDENTITY
        visible = visible and node.visible
        pose = np.array(world) if is_moved else unmoved
        found.append(ShownNode(number, parent, pose, visible))
        waiting += [(child, number, world, visible) for child in reversed(node.children)]
    return found


def local_pose(node: NodeRecord) -> single.Rows:
    """Return the rows of a node's parent-from-node."""
    if node.matrix is not None:
        return node.matrix.tolist()
    if node.translation is None and node.rotation is None and node.scale is None:
        return _IDENTITY
    offset = node.translation or (0.0, 0.0, 0.0)
    scale = node.scale or (1.0, 1.0, 1.0)
    turned = single.rotation(node.rotation or (0.0, 0.0, 0.0, 1.0)) or _IDENTITY
    rows = [
        (*(value * factor for value, factor in zip(row, scale, strict=False)), moved)
        for row, moved in zip(turned, offset, strict=False)
    ]
    return [*rows, _IDENTITY[3]]


class RestPose:
    """The rest shapes of a tree's meshes.

    Parameters
    ----------
    tree : TreeRecord

    Attributes
    ----------
    nodes : list of ShownNode
    """

    def __init__(self, tree: TreeRecord) -> None:
        self._tree = tree
        self.nodes = shown_nodes(tree)
        self._worlds = {shown.number: shown.world for shown in self.nodes}

    def posed(self, shown: ShownNode) -> Iterator[tuple[Mesh, np.ndarray]]:
        """Yield the meshes of a node, with morph targets and skin applied, and their poses."""
        node = self._tree.nodes[shown.number]
        if node.mesh is None:
            return
        record = self._tree.meshes[node.mesh]
        weights, skin = self._weights(node, record), self._skin(node, record)
        matrices = None if skin is None else self._joint_matrices(skin)
        for part in record.parts:
            mesh = _morphed(part.mesh, weights) if weights.any() else part.mesh
            bent = None if matrices is None else _bent(part.mesh, mesh, matrices)
            shape, place = (mesh, shown.world) if bent is None else (bent, None)
            poses = [np.eye(4)] if node.instances is None else node.instances
            colors = [None] * len(poses) if node.instance_colors is None else node.instance_colors
            for pose, color in zip(poses, colors, strict=True):
                own = shape if color is None else _tinted(shape, color)
                yield own, np.eye(4) if place is None else linalg.multiply(place, pose)

    def _weights(self, node: NodeRecord, record: MeshRecord) -> np.ndarray:
        given = record.morph_weights if node.weights is None else node.weights
        return np.array(given[: len(record.mesh.morph_targets)], np.float64)

    def _skin(self, node: NodeRecord, record: MeshRecord) -> SkinRecord | None:
        has_joints = any(part.mesh.joints is not None for part in record.parts)
        return self._tree.skins[node.skin] if node.skin is not None and has_joints else None

    def _joint_matrices(self, skin: SkinRecord) -> np.ndarray:
        """Return world-from-mesh of each joint, (J, 4, 4)."""
        worlds = np.array([self._worlds.get(joint, np.eye(4)) for joint in skin.joints])
        return linalg.multiply(worlds, skin.inverse_binds)


def _tinted(mesh: Mesh, color: np.ndarray) -> Mesh:
    """Return a mesh with multiplied vertex colours; glTF vertex colours are floats."""
    held = np.ones((len(mesh.positions), 4), np.float32) if mesh.colors is None else mesh.colors
    return _changed(mesh, {"colors": marked(held * color)})


def _morphed(mesh: Mesh, weights: np.ndarray) -> Mesh:
    """Return a mesh with its morph targets added."""
    changed = {}
    for key in ("positions", "normals", "tangents"):
        base = getattr(mesh, key)
        if base is None or not any(getattr(t, key) is not None for t in mesh.morph_targets):
            continue
        total = base.astype(np.float64)
        for target, weight in zip(mesh.morph_targets, weights.tolist(), strict=True):
            deltas = getattr(target, key)
            if deltas is not None and weight:
                total[:, :3] += weight * deltas.astype(np.float64)
        changed[key] = total
    if "normals" in changed:
        changed["normals"] = unit_vectors(changed["normals"])
    return _changed(mesh, changed)


def _bent(moved: Mesh, mesh: Mesh, matrices: np.ndarray) -> Mesh | None:
    """Return a morphed mesh, skinned by another's joints; None without joints."""
    joints, weights = moved.joints, moved.weights
    if joints is None or weights is None:
        return None
    positions = np.empty((len(mesh.positions), 3))
    normals = np.empty_like(positions) if mesh.has_normals else None
    tangents = None if mesh.tangents is None else mesh.tangents.astype(np.float64)
    for first in range(0, len(positions), _BLOCK):
        rows = slice(first, first + _BLOCK)
        blended = _blended(joints[rows], weights[rows], matrices)
        positions[rows] = _times(blended, mesh.positions[rows]) + blended[:, :3, 3]
        if normals is not None:
            normals[rows] = _times(_cofactors(blended), mesh.normals[rows])
        if tangents is not None:
            tangents[rows, :3] = _times(blended, tangents[rows, :3])
    changed = {"positions": positions}
    if normals is not None:
        changed["normals"] = unit_vectors(normals)
    if tangents is not None:
        tangents[:, :3] = unit_vectors(tangents[:, :3])
        changed["tangents"] = tangents
    return _changed(mesh, changed)


def _blended(joints: np.ndarray, weights: np.ndarray, matrices: np.ndarray) -> np.ndarray:
    """Return the matrix of each vertex, (V, 4, 4)."""
    total = np.zeros((len(joints), 4, 4))
    for joint, weight in zip(joints.T, weights.T.astype(np.float64), strict=True):
        total += weight[:, np.newaxis, np.newaxis] * matrices[joint]
    return total


def _times(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Return the upper 3x3 of each matrix times a vector, (V, 3)."""
    x, y, z = vectors.T.astype(np.float64)
    return np.stack(
        [m[:, 0] * x + m[:, 1] * y + m[:, 2] * z for m in (matrices[:, k] for k in range(3))],
        axis=1,
    )


def _cofactors(matrices: np.ndarray) -> np.ndarray:
    """Return the normal matrices for the upper 3x3 of point matrices, (V, 3, 3)."""
    rows = [matrices[:, k, :3] for k in range(3)]
    return np.stack([linalg.cross(rows[k - 2], rows[k - 1]) for k in range(3)], axis=1)


def _changed(mesh: Mesh, arrays: dict[str, np.ndarray]) -> Mesh:
    """Return a mesh with other positions, normals and tangents."""
    held = {"positions": mesh.positions, **attributes_of(mesh)}
    if mesh.has_normals:
        held["normals"] = mesh.normals
    with floats_are_linear():
        changed = type(mesh)(
            **{**held, **arrays},
            faces=mesh.faces,
            materials=mesh.materials,
            material_ids=mesh.material_ids,
            lines=mesh.lines,
            points=mesh.points,
            position_ids=mesh.position_ids,
            crease_angle=mesh.crease_angle,
            name=mesh.name,
        )
    put_values(changed, mesh.values)
    return changed
