"""The nodes of a glTF file: the tree of its scene, and the objects of each node.

In: a `GltfFile`. Out: a `NodeRecord` each, and the root nodes of the scene. Nodes may be nested to
any depth; a node with two parents, or in a cycle, is an error. A node with an invalid pose is
hidden with its subtree; missing references are left out.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any, TypeAlias

import numpy as np

from ....base import linalg
from ...reading.posed_parts import without_rounding
from ...reading.text import shown
from ...scenes.document_trees import MeshRecord, NodeRecord, SkinRecord
from .gltf_accessors import GltfAccessors
from .gltf_file import LIGHTS, DamagedError, Entry, GltfFile, once
from .gltf_lists import SoundList

INSTANCING, VISIBILITY = "EXT_mesh_gpu_instancing", "KHR_node_visibility"
#: The extensions handled here.
READ = (INSTANCING, VISIBILITY, LIGHTS)
_POSE_PARTS = {"TRANSLATION": 3, "ROTATION": 4, "SCALE": 3}
_COLORS = "_COLOR_0"
# Translations, rotations and scales of instances.
_Parts: TypeAlias = tuple[np.ndarray, np.ndarray, np.ndarray]


def read_nodes(
    file: GltfFile, accessors: GltfAccessors, lists: dict[str, SoundList]
) -> tuple[NodeRecord, ...]:
    """Return all nodes of a file.

    Parameters
    ----------
    file : GltfFile
    accessors : GltfAccessors
    lists : dict of str to SoundList
        Skins, cameras and lights.

    Raises
    ------
    FileFormatError
        A node has children that do not exist.
    """
    reading = _Nodes(file, accessors, lists)
    return tuple(
        reading.node(node, f"nodes[{index}]") for index, node in enumerate(file.entries("nodes"))
    )


def read_roots(file: GltfFile, nodes: tuple[NodeRecord, ...]) -> tuple[int, ...]:
    """Return the root nodes of the file's scene.

    Raises
    ------
    FileFormatError
        The nodes below them do not form a tree.
    """
    scenes = file.entries("scenes")
    if scenes:
        number = file.number_in("scenes", file.tree.get("scene", 0), "scene")
        scene = scenes[number]
        if len(scenes) > 1:
            file.warnings.add(f"{len(scenes)} scenes: only scenes[{number}] is shown")
        roots = _references(file, scene, "nodes", f"scenes[{number}]")
    else:
        named = {child for node in nodes for child in node.children}
        roots = tuple(index for index in range(len(nodes)) if index not in named)
    _check_tree(file, nodes, roots)
    return roots


def _check_tree(file: GltfFile, nodes: tuple[NodeRecord, ...], roots: tuple[int, ...]) -> None:
    """Raise unless each node has at most one parent, and no node is its own ancestor."""
    above = [-1] * len(nodes)
    for index, node in enumerate(nodes):
        for child in node.children:
            if above[child] >= 0:
                raise file.damaged(f"nodes[{child}] is named twice")
            above[child] = index
    _reached(file, nodes, roots)
    tops = tuple(index for index, parent in enumerate(above) if parent < 0)
    missed = _reached(file, nodes, tops).find(0)
    if missed >= 0:
        raise file.damaged(f"nodes[{missed}] is below itself")


def _reached(file: GltfFile, nodes: tuple[NodeRecord, ...], roots: tuple[int, ...]) -> bytearray:
    """Return flags for the nodes reachable from the given ones; each may be reached once."""
    seen = bytearray(len(nodes))
    waiting = list(roots)
    while waiting:
        index = waiting.pop()
        if seen[index]:
            raise file.damaged(f"nodes[{index}] is named twice")
        seen[index] = 1
        waiting += nodes[index].children
    return seen


def with_fitting(
    file: GltfFile,
    nodes: tuple[NodeRecord, ...],
    meshes: tuple[MeshRecord, ...],
    skins: tuple[SkinRecord, ...],
) -> tuple[NodeRecord, ...]:
    """Return nodes without skins and weights that do not fit their meshes."""
    highest: dict[int, int | DamagedError] = {}
    found = list(nodes)
    for index, node in enumerate(nodes):
        if node.mesh is None or (node.skin is None and node.weights is None):
            continue
        where, record = f"nodes[{index}]", meshes[node.mesh]
        if node.skin is not None:
            joint = once(highest, node.mesh, partial(_highest_joint, record))
            count = len(skins[node.skin].joints)
            if joint >= count:
                reason = f"its mesh is moved by joint {joint}, there are {count}"
                file.leave_out(f"{where}.skin", file.damaged(reason))
                node = replace(node, skin=None)
        count = len(record.mesh.morph_targets)
        if node.weights is not None and len(node.weights) != count:
            told = f"{where} has {len(node.weights)} weights, its mesh {count} targets"
            file.warnings.add(f"{told}: those of none are left out, others are 0")
            padding = (0.0,) * (count - len(node.weights))
            node = replace(node, weights=(*node.weights[:count], *padding))
        found[index] = node
    return tuple(found)


def _highest_joint(record: MeshRecord) -> int:
    """Return the highest joint index of any vertex; -1 if none."""
    moving = [
        np.where(part.mesh.weights > 0, part.mesh.joints, 0).max(initial=0)
        for part in record.parts
        if part.mesh.joints is not None and part.mesh.weights is not None
    ]
    return max(map(int, moving), default=-1)


class _Nodes:
    """Reads nodes."""

    def __init__(
        self, file: GltfFile, accessors: GltfAccessors, lists: dict[str, SoundList]
    ) -> None:
        self._file, self._accessors, self._lists = file, accessors, lists
        self._light_count = len(file.lights())
        self._drawn: set[tuple[int, str]] = set()
        self._poses: dict[str, tuple[np.ndarray, _Parts] | DamagedError] = {}
        self._instance_colors: dict[str, np.ndarray | None | DamagedError] = {}

    def node(self, node: Entry, where: str) -> NodeRecord:
        file = self._file
        extensions = file.spare_part(node, "extensions", where)
        is_hidden = file.spare_part(extensions, VISIBILITY, where).get("visible") is False
        place: dict[str, Any] = {}
        try:
            place = _place(file, node, where)
        except DamagedError as error:
            file.lose(where, error)
            is_hidden = True
        return NodeRecord(
            name=file.name(node, where),
            children=_references(file, node, "children", where),
            visible=not is_hidden,
            skin=self._spare(node, "skin", "skins", where),
            camera=self._spare(node, "camera", "cameras", where),
            light=self._light(extensions, where),
            weights=self._weights(node, where),
            **place,
            **self._shown(node, extensions, where),
            extras=node.get("extras"),
        )

    def _shown(self, node: Entry, extensions: Entry, where: str) -> dict[str, Any]:
        """Return the mesh of a node, and its instances."""
        if "mesh" not in node:
            return {}
        try:
            mesh = self._file.number_in("meshes", node["mesh"], where)
            return {"mesh": mesh, **self._instances(extensions, mesh, where)}
        except DamagedError as error:
            self._file.lose(f"{where}.mesh", error)
            return {}

    def _weights(self, node: Entry, where: str) -> tuple[float, ...] | None:
        if "weights" not in node:
            return None
        return self._file.sound(f"{where}.weights", self._file.number_list, node, "weights", where)

    def _spare(self, node: Entry, name: str, list_name: str, where: str) -> int | None:
        """Return the record of an optional reference of a node."""
        if name not in node:
            return None
        number = self._file.sound(
            f"{where}.{name}", self._file.number_in, list_name, node[name], where
        )
        return None if number is None else self._lists[list_name].number_of.get(number)

    def _light(self, extensions: Entry, where: str) -> int | None:
        if LIGHTS not in extensions:
            return None
        given = self._file.spare_part(extensions, LIGHTS, where).get("light")
        place = f"{where}.{LIGHTS}"
        number = self._file.sound(
            place, self._file.index, given, self._light_count, "lights", place
        )
        return None if number is None else self._lists["lights"].number_of.get(number)

    def _instances(self, extensions: Entry, mesh: int, where: str) -> dict[str, Any]:
        """Return the poses and colours of instances; none if the mesh is drawn once."""
        if INSTANCING not in extensions:
            return {}
        file, accessors, where = self._file, self._accessors, f"{where}.{INSTANCING}"
        attributes = file.part(file.part(extensions, INSTANCING, where), "attributes", where)
        for name in attributes:
            if name not in (*_POSE_PARTS, _COLORS):
                file.warnings.add_once(f"what instances say of {shown(name)} is left out")
        # Nodes with equal entries share arrays.
        key = repr(attributes)
        poses, parts = once(self._poses, key, partial(self._instance_poses, attributes, where))
        if (mesh, key) not in self._drawn:
            self._drawn.add((mesh, key))
            accessors.count(16 * len(poses))  # a scene has them for each mesh
        kept = self._instance_colors
        read = partial(_colors, accessors, attributes, where, len(poses))
        colors = file.sound(f"{where}.{_COLORS}", once, kept, key, read)
        return {"instances": poses, "instance_parts": parts, "instance_colors": colors}

    def _instance_poses(self, attributes: Entry, where: str) -> tuple[np.ndarray, _Parts]:
        """Return the poses of instances, and their parts."""
        file, accessors = self._file, self._accessors
        held = {
            name: accessors.floats(attributes[name], where, width).astype(np.float64)
            for name, width in _POSE_PARTS.items()
            if name in attributes
        }
        if len({len(values) for values in held.values()}) != 1:
            raise file.damaged(f"{where} has no instances, or unequal numbers of their parts")
        if not all(np.isfinite(values).all() for values in held.values()):
            raise file.damaged(f"{where} has instances that are nowhere")
        count = len(next(iter(held.values())))
        parts = (
            held.get("TRANSLATION", np.zeros((count, 3))),
            held.get("ROTATION", np.tile((0.0, 0.0, 0.0, 1.0), (count, 1))),
            held.get("SCALE", np.ones((count, 3))),
        )
        return poses_of(*parts), parts


def _place(file: GltfFile, node: Entry, where: str) -> dict[str, Any]:
    """Return the parts of a node's pose."""
    found: dict[str, Any] = {
        name: file.numbers(node, name, where, (0.0,) * count)
        for name, count in (("translation", 3), ("rotation", 4), ("scale", 3))
        if name in node
    }
    if "rotation" in found and not 0.0 < sum(x * x for x in found["rotation"]) < np.inf:
        raise file.damaged(f"{where}.rotation has no direction")
    if "matrix" in node:
        columns = file.numbers(node, "matrix", where, (0.0,) * 16)
        matrix = without_rounding(np.array(columns).reshape(4, 4).T.copy())
        if matrix[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
            raise DamagedError(f"{where}.matrix is no affine pose", file.path)
        found["matrix"] = matrix
    return found


def _references(file: GltfFile, entry: Entry, name: str, where: str) -> tuple[int, ...]:
    values = entry.get(name, [])
    if not isinstance(values, list):
        raise file.damaged(f"{where}.{name} is no list")
    return tuple(file.number_in("nodes", value, where) for value in values)


def _colors(
    accessors: GltfAccessors, attributes: Entry, where: str, count: int
) -> np.ndarray | None:
    """Return linear colours, (N, 4) float32, as three.js reads them; None without any."""
    if _COLORS not in attributes:
        return None
    colors = np.nan_to_num(accessors.floats(attributes[_COLORS], where, 3, 4)).clip(0, 1)
    if len(colors) != count:
        raise accessors.file.damaged(f"{len(colors)} colours for {count} instances")
    opaque = np.ones((len(colors), 4 - colors.shape[1]), np.float32)
    return np.concatenate([colors, opaque], axis=1)


def poses_of(translations: np.ndarray, rotations: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """Return matrices (N, 4, 4) of translations, quaternions (null: no rotation) and scales."""
    square = (rotations * rotations).sum(axis=1)
    is_none = ~((square > 0) & (square < np.inf))
    rotations = np.where(is_none[:, np.newaxis], (0.0, 0.0, 0.0, 1.0), rotations)
    poses = linalg.quaternion_to_matrix(rotations)
    poses[:, :3, :3] *= scales[:, np.newaxis, :]
    poses[:, :3, 3] = translations
    return poses
