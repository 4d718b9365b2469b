"""The nodes of a glTF file: the tree that its scene shows, and what each of them names.

In: a `GltfFile`. Out: a `NodeRecord` each, and the nodes that the scene begins with. Nodes may be
nested to any depth; one that two others name, or that names itself, is an error.
"""

from __future__ import annotations

import numpy as np

from .. import linalg
from .documents import NodeRecord
from .gltf_accessors import GltfAccessors
from .gltf_file import LIGHTS, GltfFile
from .text import shown
from .warning_list import WarningList

INSTANCING, VISIBILITY = "EXT_mesh_gpu_instancing", "KHR_node_visibility"
#: The extensions that are read here.
READ = (INSTANCING, VISIBILITY, LIGHTS)
_POSE_PARTS = {"TRANSLATION": 3, "ROTATION": 4, "SCALE": 3}
_COLORS = "_COLOR_0"


def read_nodes(file: GltfFile, accessors: GltfAccessors) -> tuple[NodeRecord, ...]:
    """Return all nodes of a file.

    Raises
    ------
    FileFormatError
        A node names what does not exist, or is no node.
    """
    return tuple(
        _node(file, accessors, node, f"nodes[{index}]")
        for index, node in enumerate(file.entries("nodes"))
    )


def warn_of_unknown_attributes(file: GltfFile, warnings: WarningList) -> None:
    """Tell which attributes of instances are not drawn, each once."""
    for index, node in enumerate(file.entries("nodes")):
        where = f"nodes[{index}]"
        extension = file.part(file.part(node, "extensions", where), INSTANCING, where)
        for name in file.part(extension, "attributes", where):
            if name not in (*_POSE_PARTS, _COLORS):
                warnings.add_once(f"what instances say of {shown(name)} is left out")


def read_roots(
    file: GltfFile, nodes: tuple[NodeRecord, ...], warnings: WarningList
) -> tuple[int, ...]:
    """Return the nodes that the file's scene begins with.

    Raises
    ------
    FileFormatError
        The nodes below them are no tree.
    """
    scenes = file.entries("scenes")
    if scenes:
        number = file.tree.get("scene", 0)
        scene = file.entry("scenes", number, "scene")
        if len(scenes) > 1:
            warnings.add(f"{len(scenes)} scenes: only scenes[{number}] is shown")
        roots = _references(file, scene, "nodes", f"scenes[{number}]")
    else:
        named = {child for node in nodes for child in node.children}
        roots = tuple(index for index in range(len(nodes)) if index not in named)
    _check_tree(file, nodes, roots)
    return roots


def _check_tree(file: GltfFile, nodes: tuple[NodeRecord, ...], roots: tuple[int, ...]) -> None:
    """Raise unless each node is below one other at most, and none below itself."""
    above = [-1] * len(nodes)
    for index, node in enumerate(nodes):
        for child in node.children:
            if above[child] >= 0:
                raise file.error(f"damaged: nodes[{child}] is named twice")
            above[child] = index
    _reached(file, nodes, roots)
    tops = tuple(index for index, parent in enumerate(above) if parent < 0)
    missed = _reached(file, nodes, tops).find(0)
    if missed >= 0:
        raise file.error(f"damaged: nodes[{missed}] is below itself")


def _reached(file: GltfFile, nodes: tuple[NodeRecord, ...], roots: tuple[int, ...]) -> bytearray:
    """A one for each node that stands below these, or is one of them; each is so once."""
    seen = bytearray(len(nodes))
    waiting = list(roots)
    while waiting:
        index = waiting.pop()
        if seen[index]:
            raise file.error(f"damaged: nodes[{index}] is named twice")
        seen[index] = 1
        waiting += nodes[index].children
    return seen


def _node(file: GltfFile, accessors: GltfAccessors, node: dict, where: str) -> NodeRecord:
    extensions = file.part(node, "extensions", where)
    matrix = None
    if "matrix" in node:
        columns = file.numbers(node, "matrix", where, (0.0,) * 16)
        matrix = np.array(columns).reshape(4, 4).T.copy()
        if columns[3::4] != (0.0, 0.0, 0.0, 1.0):
            raise file.error(f"{where}.matrix is no affine pose")
    rotation = _numbers(file, node, "rotation", where, 4)
    if rotation is not None and not 0.0 < sum(x * x for x in rotation) < np.inf:
        raise file.error(f"damaged: {where}.rotation has no direction")
    mesh = _reference(file, node, "mesh", "meshes", where)
    return NodeRecord(
        name=file.text(node, "name", where),
        children=_references(file, node, "children", where),
        translation=_numbers(file, node, "translation", where, 3),
        rotation=rotation,
        scale=_numbers(file, node, "scale", where, 3),
        matrix=matrix,
        visible=file.part(extensions, VISIBILITY, where).get("visible") is not False,
        mesh=mesh,
        skin=_reference(file, node, "skin", "skins", where),
        camera=_reference(file, node, "camera", "cameras", where),
        light=_light(file, extensions, where),
        weights=file.number_list(node, "weights", where),
        **(_instances(file, accessors, extensions, where) if mesh is not None else {}),
        extras=node.get("extras"),
    )


def _numbers(file: GltfFile, node: dict, name: str, where: str, count: int):
    return file.numbers(node, name, where, (0.0,) * count) if name in node else None


def _reference(file: GltfFile, node: dict, name: str, list_name: str, where: str) -> int | None:
    if name not in node:
        return None
    file.entry(list_name, node[name], where)
    return node[name]


def _references(file: GltfFile, entry: dict, name: str, where: str) -> tuple[int, ...]:
    values = entry.get(name, [])
    if not isinstance(values, list):
        raise file.error(f"damaged: {where}.{name} is no list")
    for value in values:
        file.entry("nodes", value, where)
    return tuple(values)


def _light(file: GltfFile, extensions: dict, where: str) -> int | None:
    if LIGHTS not in extensions:
        return None
    return file.index(
        file.part(extensions, LIGHTS, where).get("light"), len(file.lights()), "lights", where
    )


def _instances(file: GltfFile, accessors: GltfAccessors, extensions: dict, where: str) -> dict:
    """The poses and colours of instances; none where the mesh is drawn once."""
    if INSTANCING not in extensions:
        return {}
    where = f"{where}.{INSTANCING}"
    entry = file.part(extensions, INSTANCING, where)
    attributes = file.part(entry, "attributes", where)
    held = {
        name: accessors.floats(attributes[name], where, width).astype(np.float64)
        for name, width in _POSE_PARTS.items()
        if name in attributes
    }
    colors = _colors(accessors, attributes, where)
    counts = {len(values) for values in (*held.values(), *([] if colors is None else [colors]))}
    if len(counts) != 1 or not held:
        raise file.error(f"damaged: {where} has no instances, or unequal numbers of their parts")
    if not all(np.isfinite(values).all() for values in held.values()):
        raise file.error(f"damaged: {where} has instances that are nowhere")
    count = len(next(iter(held.values())))
    parts = (
        held.get("TRANSLATION", np.zeros((count, 3))),
        held.get("ROTATION", np.tile((0.0, 0.0, 0.0, 1.0), (count, 1))),
        held.get("SCALE", np.ones((count, 3))),
    )
    return {"instances": poses_of(*parts), "instance_parts": parts, "instance_colors": colors}


def _colors(accessors: GltfAccessors, attributes: dict, where: str) -> np.ndarray | None:
    """(N, 4) float32, linear, as three.js and others read the attribute; None if there are none."""
    if _COLORS not in attributes:
        return None
    colors = np.nan_to_num(accessors.floats(attributes[_COLORS], where, 3, 4)).clip(0, 1)
    opaque = np.ones((len(colors), 4 - colors.shape[1]), np.float32)
    return np.concatenate([colors, opaque], axis=1)


def poses_of(translations: np.ndarray, rotations: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """Return matrices (N, 4, 4) of (N, 3), (N, 4) and (N, 3); no rotation for a null quaternion."""
    square = (rotations * rotations).sum(axis=1)
    is_none = ~((square > 0) & (square < np.inf))
    rotations = np.where(is_none[:, np.newaxis], (0.0, 0.0, 0.0, 1.0), rotations)
    poses = linalg.quaternion_to_matrix(rotations)
    poses[:, :3, :3] *= scales[:, np.newaxis, :]
    poses[:, :3, 3] = translations
    return poses
