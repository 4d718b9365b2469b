"""Reader of engine3d's scene files: a tree of nodes in JSON, and the files it names.

In: the bytes of a file. Out: a `Document` whose ``scene`` holds the tree, with its meshes,
materials and textures; other objects of nodes are created when a scene is built. The objects of the
document are the visible meshes, with their world poses. docs/formats.md has the format.
"""

from __future__ import annotations

import re

from ...errors import FileFormatError
from ..addresses.linked_urls import linked_files
from ..reading.documents import Document
from ..reading.json_values import JsonValue, parsed_json
from ..reading.posed_parts import MAX_REPEATED, counts_of, document_objects
from ..reading.reader_registry import Reader
from ..reading.sources import Source
from ..reading.text import shown
from ..reading.warning_list import WarningList
from ..scenes.document_trees import SceneRecord
from .scene_looks import SceneLooks
from .scene_meshes import SceneMeshes
from .scene_tree import links_of, pose_parts, shown_parts

FORMAT = "engine3d scene"
VERSION = 1
#: Keys of a file besides ``format`` and ``version``.
LISTS = ("environments", "textures", "materials", "objects", "nodes")

# A node takes about a kilobyte, however small its entry.
_NODES, _BYTES_OF_A_NODE = 20_000, 32
_SIGNATURE = re.compile(rb'\A(?:\xef\xbb\xbf)?\s*\{\s*"format"\s*:\s*"engine3d scene"')


def read_scene_file(source: Source, split: bool = False) -> Document:
    """Read a scene file, as `Reader.read`; its objects are the visible meshes."""
    root = parsed_json(source)
    _check_format(root)
    warnings = WarningList(source.path)
    for key in root.members():
        if key not in ("format", "version", "scene", *LISTS):
            warnings.add(f"{shown(key)} is not known")
    files = linked_files(source)
    looks = SceneLooks(source, root, files, warnings)
    meshes = SceneMeshes(source, looks, files, warnings)
    record = _record(source, root, looks, meshes)
    parts = [part for part in shown_parts(record, source) if len(part.mesh.positions)]
    objects = document_objects(source, parts, MAX_REPEATED + source.size, split) if parts else []
    if not (objects or split):
        raise FileFormatError("no vertices in this scene", source.path)
    counts = {
        **counts_of(objects),
        "nodes": len(record.nodes),
        "materials": [material.name for material in record.materials],
    }
    told = [*warnings.messages(), *meshes.parts.told]
    return Document("e3d", objects, counts=counts, warnings=told, scene=record)


def _check_format(root: JsonValue) -> None:
    if not isinstance(root.value, dict) or root.value.get("format") != FORMAT:
        raise root.error(f'not a scene of engine3d: it does not begin with "format": "{FORMAT}"')
    version = root.need("version").value
    if type(version) is not int or version < 1:
        raise root.need("version").wrong("a version")
    if version > VERSION:
        raise root.error(f"a scene of version {version}, which a newer engine3d reads")


def _record(source: Source, root: JsonValue, looks: SceneLooks, meshes: SceneMeshes) -> SceneRecord:
    objects = root.entries("objects")
    made = {
        number: meshes.mesh(entry)
        for number, entry in enumerate(objects)
        if entry.need("kind").text() == "mesh"
    }
    nodes = root.entries("nodes")
    if len(nodes) > _NODES + source.size // _BYTES_OF_A_NODE:
        raise root.error(f"{len(nodes)} nodes are more than the file can say something of")
    return SceneRecord(
        root.get("scene") or JsonValue({}, source.path),
        looks.materials,
        made,
        objects,
        nodes,
        [pose_parts(node) for node in nodes],
        *links_of(nodes),
        looks.environments,
    )


def _is_scene(head: bytes) -> bool:
    return _SIGNATURE.match(head) is not None


READERS = (Reader("e3d", "engine3d scene", "mesh", (".json",), read_scene_file, _is_scene),)
