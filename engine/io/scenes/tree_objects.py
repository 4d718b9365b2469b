"""The objects of a document with a tree: the visible meshes, node by node.

In: a `TreeRecord`. Out: an object for each mesh of each visible node, and counts. Since any number
of nodes may repeat a mesh, the joined size is limited.
"""

from __future__ import annotations

from typing import Any

from ...errors import FileFormatError
from ..reading.documents import DocumentObject
from ..reading.posed_parts import PosedPart, counts_of, document_objects
from ..reading.sources import Source
from .document_trees import TreeRecord
from .tree_posing import RestPose, ShownNode

# Each takes some kilobytes, however small its entry.
_MAX_OBJECTS = 50_000


def tree_objects(
    source: Source, tree: TreeRecord, most_vertices: int, split: bool
) -> list[DocumentObject]:
    """Return the visible objects of a tree.

    Parameters
    ----------
    source : Source
    tree : TreeRecord
    most_vertices : int
        The limit of the total vertices if poses are applied.
    split : bool
        Whether to keep poses separate and meshes as stored, each instanced mesh once; otherwise
        poses, skins and morph targets are applied.

    Raises
    ------
    FileFormatError
        There are too many objects or vertices, or one mesh is requested and there are no vertices.
    """
    rest = RestPose(tree)
    shown = [node for node in rest.nodes if node.visible]
    drawn = [node for node in shown if tree.nodes[node.number].mesh is not None]
    if sum(len(tree.parts(tree.nodes[node.number])) for node in drawn) > _MAX_OBJECTS:
        raise FileFormatError(f"more than {_MAX_OBJECTS} objects", source.path)
    if not split:
        _check_vertices(source, tree, drawn, most_vertices)
    parts: list[PosedPart] = []
    for node in drawn:
        if split:
            held = tree.parts(tree.nodes[node.number])
            meshes = [(part.mesh, node.world.copy()) for part in held]
        else:
            meshes = list(rest.posed(node))
        meshes = [(mesh, pose) for mesh, pose in meshes if len(mesh.positions)]
        name = tree.nodes[node.number].name or str(node.number)
        names = [name] if len(meshes) == 1 else [f"{name}_{k}" for k in range(len(meshes))]
        named = zip(names, meshes, strict=True)
        parts += [PosedPart(name, mesh, pose) for name, (mesh, pose) in named]
    if not parts and split:
        return []
    return document_objects(source, parts, most_vertices, split)


def _check_vertices(source: Source, tree: TreeRecord, drawn: list[ShownNode], most: int) -> None:
    """Refuse too many vertices before creating any."""
    total = 0
    for node in drawn:
        record = tree.nodes[node.number]
        times = 1 if record.instances is None else len(record.instances)
        total += times * sum(len(part.mesh.positions) for part in tree.parts(record))
        if times > _MAX_OBJECTS:
            raise FileFormatError(f"more than {_MAX_OBJECTS} objects", source.path)
    if total > most:
        raise FileFormatError(
            f"{total} vertices where meshes are repeated: one mesh of them is limited to "
            f"{most}; load_scene keeps the meshes apart",
            source.path,
        )


def tree_counts(tree: TreeRecord, objects: list[DocumentObject]) -> dict[str, Any]:
    """Return the sizes of a tree's lists, for `Document.counts`."""
    return {
        **counts_of(objects),
        "nodes": len(tree.nodes),
        "meshes": len(tree.meshes),
        "materials": [material.name for material in tree.materials if material.name],
    }
