"""The nodes of a glTF file that show a mesh, each with its place in the scene.

In: a `GltfFile`. Out: names, numbers of meshes and poses, in the order of the file's own tree.
Nodes may be nested to any depth; one that two others name, or that names itself, is an error.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..linalg import single
from .gltf_file import GltfFile
from .warning_list import WarningList

_IDENTITY = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))


class PlacedMesh(NamedTuple):
    """A node that shows a mesh.

    Attributes
    ----------
    name : str
        The node's, or its number.
    mesh : int
    pose : (4, 4) float64
    """

    name: str
    mesh: int
    pose: np.ndarray


def placed_meshes(file: GltfFile, warnings: WarningList) -> list[PlacedMesh]:
    """Return the nodes of the file's scene that show a mesh.

    Raises
    ------
    FileFormatError
        The nodes are no tree, or a pose is none.
    """
    nodes = file.entries("nodes")
    seen = [False] * len(nodes)
    found = []
    waiting = [(root, _IDENTITY, place) for root, place in reversed(_roots(file, nodes, warnings))]
    while waiting:
        index, above, place = waiting.pop()
        node = file.entry("nodes", index, place)
        if seen[index]:
            raise file.error(f"damaged: nodes[{index}] is named twice")
        seen[index] = True
        where = f"nodes[{index}]"
        if not _is_visible(file, node, where):
            continue
        pose = single.multiply(above, _pose(file, node, where))
        if "mesh" in node:
            file.entry("meshes", node["mesh"], where)
            name = node.get("name") or index
            found.append(PlacedMesh(str(name), node["mesh"], np.array(pose, np.float64)))
        children = _list(file, node, "children", where)
        waiting.extend((child, pose, where) for child in reversed(children))
    return found


def _roots(file: GltfFile, nodes: list[dict], warnings: WarningList) -> list[tuple[int, str]]:
    """The nodes that the scene begins with, and the place that names them."""
    scenes = file.entries("scenes")
    if not scenes:
        named = {
            child
            for index, node in enumerate(nodes)
            for child in _list(file, node, "children", f"nodes[{index}]")
            if type(child) is int
        }
        return [(index, "") for index in range(len(nodes)) if index not in named]
    number = file.tree.get("scene", 0)
    scene = file.entry("scenes", number, "scene")
    if len(scenes) > 1:
        warnings.add(f"{len(scenes)} scenes: only scenes[{number}] is read")
    where = f"scenes[{number}]"
    return [(root, where) for root in _list(file, scene, "nodes", where)]


def _list(file: GltfFile, entry: dict, name: str, where: str) -> list:
    values = entry.get(name, [])
    if not isinstance(values, list):
        raise file.error(f"damaged: {where}.{name} is no list")
    return values


def _is_visible(file: GltfFile, node: dict, where: str) -> bool:
    extensions = file.part(node, "extensions", where)
    return file.part(extensions, "KHR_node_visibility", where).get("visible") is not False


def _pose(file: GltfFile, node: dict, where: str):
    """The rows of a node's matrix, or of its translation, rotation and scale."""
    if "matrix" in node:
        columns = file.numbers(node, "matrix", where, (0.0,) * 16)
        return [columns[row::4] for row in range(4)]
    if not node.keys() & {"translation", "rotation", "scale"}:
        return _IDENTITY
    offset = file.numbers(node, "translation", where, (0.0, 0.0, 0.0))
    scale = file.numbers(node, "scale", where, (1.0, 1.0, 1.0))
    turned = single.rotation(file.numbers(node, "rotation", where, (0.0, 0.0, 0.0, 1.0)))
    if turned is None:
        raise file.error(f"damaged: {where}.rotation has no direction")
    rows = [
        (*(value * factor for value, factor in zip(row, scale, strict=True)), moved)
        for row, moved in zip(turned, offset, strict=True)
    ]
    return [*rows, _IDENTITY[3]]
