"""The tree of a scene file: parents, poses, and visibility.

In: nodes from JSON, or a `SceneRecord`. Out: links, poses, meshes in the world.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ...base import linalg
from ...errors import FileFormatError
from ...model.geometry.mesh import Mesh
from ..reading.json_values import JsonValue
from ..reading.posed_parts import PosedPart
from ..reading.sources import Source
from ..scenes.document_trees import Place, SceneRecord

# As an object of the document, each instance takes some kilobytes.
_MAX_OBJECTS = 50_000
_IDENTITY = {"translation": (0.0, 0, 0), "rotation": (0.0, 0, 0, 1), "scale": (1.0, 1, 1)}
_PARTS = {**{key: len(part) for key, part in _IDENTITY.items()}, "pose": 12}


def links_of(nodes: list[JsonValue]) -> tuple[list[int], dict[int, list[int]]]:
    """Return the parent of each node, and the children of nodes that have some.

    Raises
    ------
    FileFormatError
        A node has several parents, or is its own ancestor.
    """
    parents = [-1] * len(nodes)
    children: dict[int, list[int]] = {}
    for number, node in enumerate(nodes):
        held = node.get("children")
        for child in () if held is None else held:
            index = child.index(len(nodes), "nodes")
            if parents[index] >= 0:
                raise child.error(f"nodes[{index}] is a child of nodes[{parents[index]}] already")
            parents[index] = number
            children.setdefault(number, []).append(index)
    state = bytearray(len(nodes))  # 1: on the current path up, 2: leads to the top
    for number in range(len(nodes)):
        way = []
        while number >= 0 and not state[number]:
            state[number] = 1
            way.append(number)
            number = parents[number]
        if number >= 0 and state[number] == 1:
            raise nodes[number].error("is below itself")
        for passed in way:
            state[passed] = 2
    return parents, children


def pose_parts(node: JsonValue) -> Place:
    """Return the parts of a node's pose."""
    found: Place = {}
    for key, count in _PARTS.items():
        if (held := node.get(key)) is not None:
            found[key] = held.numbers(count)
    if "rotation" in found and not 0.0 < sum(x * x for x in found["rotation"]) < math.inf:
        raise node.need("rotation").wrong("a quaternion that has a length")
    if "pose" in found:
        if len(found) > 1:
            raise node.error("give pose or translation, rotation and scale, not both")
        rows = found["pose"]
        found["pose"] = [rows[0:4], rows[4:8], rows[8:12], [0.0, 0.0, 0.0, 1.0]]
    return found


def shown_parts(record: SceneRecord, source: Source) -> list[PosedPart]:
    """Return the visible parts with world poses, one for each instance."""
    worlds, is_shown = _standing(record)
    parts: list[PosedPart] = []
    for number, node in enumerate(record.nodes):
        held = node.get("object")
        if held is None or not is_shown[number]:
            continue
        index = held.index(len(record.objects), "objects")
        name = "" if node.get("name") is None else node.need("name").text()
        if index in record.meshes:
            parts.append(PosedPart(name, record.meshes[index], worlds[number]))
        for mesh, pose in _instances(record, index):
            parts.append(PosedPart(name, mesh, linalg.multiply(worlds[number], pose)))
            if len(parts) > _MAX_OBJECTS:
                raise FileFormatError(f"more than {_MAX_OBJECTS} instances", source.path)
    return parts


def _instances(record: SceneRecord, index: int) -> Iterator[tuple[Mesh, np.ndarray]]:
    """Return the meshes of an object of instances, and their poses in node space."""
    entry = record.objects[index]
    if entry.need("kind").value != "instances":
        return
    mesh = mesh_of(record, entry.need("mesh"))
    for row in entry.need("poses").array().astype(np.float64):
        pose = np.eye(4)
        if row.shape == (4,):
            pose[:3, :3] *= row[3]
            pose[:3, 3] = row[:3]
        yield mesh, pose if row.shape == (4,) else row


def mesh_of(record: SceneRecord, number: JsonValue) -> Mesh:
    """Return the mesh with a number."""
    index = number.index(len(record.objects), "objects")
    if index not in record.meshes:
        raise number.error(f"objects[{index}] is no mesh")
    return record.meshes[index]


def _standing(record: SceneRecord) -> tuple[np.ndarray, np.ndarray]:
    """Return the nodes' world poses, (N, 4, 4) float64, and which nodes are visible."""
    hidden = [node.get("hidden") for node in record.nodes]
    is_shown = np.array([held is None or not held.flag() for held in hidden], bool)
    worlds, parents = _poses(record.places), np.array(record.parents)
    for level in _levels(record)[1:]:
        worlds[level] = linalg.multiply(worlds[parents[level]], worlds[level])
        is_shown[level] &= is_shown[parents[level]]
    return worlds, is_shown


def _levels(record: SceneRecord) -> list[list[int]]:
    """Yield the nodes level by level, from the roots down."""
    level = [number for number, parent in enumerate(record.parents) if parent < 0]
    levels = []
    while level:
        levels.append(level)
        level = [child for number in level for child in record.children.get(number, ())]
    return levels


def _poses(places: list[Place]) -> np.ndarray:
    """Return the poses for given parts, (N, 4, 4) float64."""
    parts = {
        key: np.array([place.get(key, default) for place in places]).reshape(-1, len(default))
        for key, default in _IDENTITY.items()
    }
    poses = linalg.quaternion_to_matrix(parts["rotation"])
    poses[:, :3, :3] *= parts["scale"][:, np.newaxis, :]
    poses[:, :3, 3] = parts["translation"]
    for number, place in enumerate(places):
        if "pose" in place:
            poses[number] = place["pose"]
    return poses
