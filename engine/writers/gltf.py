"""glTF 2.0: scenes and meshes, as .glb, or as .gltf with all in one file.

In: a scene, or a mesh. Out: a file that holds its tree, materials, textures, cameras, lights, skins
and animations. Source: Khronos, "glTF 2.0 Specification", 2021.
"""

from __future__ import annotations

import base64
import json
import os
import struct
from typing import Any, BinaryIO

from ..errors import InvalidArgumentError
from ..files.atomic_write import Files
from ..geometry.mesh import Mesh
from ..loaders.documents import TreeRecord
from ..scene.scene import Scene
from .gltf_tree import GltfTree
from .registry import Writer
from .scene_tree import tree_of_scene

EXTENSIONS = (".glb", ".gltf")
_MAGIC, _VERSION = b"glTF", 2
_JSON, _BINARY = b"JSON", b"BIN\0"
_MOST = 2**32 - 1
_URI = "data:application/octet-stream;base64,"


def is_gltf(path: str) -> bool:
    """Return whether a path's extension is one of glTF's."""
    return os.path.splitext(path)[1].lower() in EXTENSIONS


def write_scene(scene: Scene, path: str, file: BinaryIO) -> list[str]:
    """Write a scene as ``path`` says; returns a line for each thing that the file does not hold."""
    tree, told = tree_of_scene(scene)
    return [*told, *write_tree(tree, path, file)]


def write_tree(tree: TreeRecord, path: str, file: BinaryIO) -> list[str]:
    """Write a tree to an open file, as .gltf if the path ends so and else as .glb."""
    made = GltfTree(tree)
    if os.path.splitext(path)[1].lower() == ".gltf":
        if made.arrays.size:
            content = base64.b64encode(b"".join(made.arrays.chunks)).decode("ascii")
            made.json["buffers"] = [{"byteLength": made.arrays.size, "uri": _URI + content}]
        file.write(_text(made.json, indent=1) + b"\n")
    else:
        _write_glb(made, path, file)
    return list(dict.fromkeys(made.told))


def _write_glb(made: GltfTree, path: str, file: BinaryIO) -> None:
    if made.arrays.size:
        made.json["buffers"] = [{"byteLength": made.arrays.size}]
    text = _text(made.json)
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + (8 + made.arrays.size if made.arrays.size else 0)
    if size > _MOST:
        raise InvalidArgumentError(f"{path}: a .glb file holds at most {_MOST} bytes, not {size}")
    file.write(struct.pack("<4sII", _MAGIC, _VERSION, size))
    file.write(struct.pack("<I4s", len(text), _JSON) + text)
    if made.arrays.size:
        file.write(struct.pack("<I4s", made.arrays.size, _BINARY))
        for chunk in made.arrays.chunks:
            file.write(chunk)


def _text(tree: dict[str, Any], indent: int | None = None) -> bytes:
    separators = (",", ":") if indent is None else (",", ": ")
    text = json.dumps(tree, separators=separators, indent=indent, ensure_ascii=False)
    return text.encode("utf-8", "backslashreplace")


def _write_mesh(mesh: Mesh, path: str, files: Files, kind: str) -> list[str]:
    scene = Scene()
    scene.add(mesh, name=mesh.name)
    return write_scene(scene, kind, files.create(path))


def write_glb(mesh: Mesh, path: str, files: Files) -> list[str]:
    """Write a mesh as .glb; returns what such files do not hold."""
    return _write_mesh(mesh, path, files, "mesh.glb")


def write_gltf(mesh: Mesh, path: str, files: Files) -> list[str]:
    """Write a mesh as .gltf; returns what such files do not hold."""
    return _write_mesh(mesh, path, files, "mesh.gltf")


WRITERS = (
    Writer("glb", "glTF 2.0, binary", (".glb",), write_glb),
    Writer("gltf", "glTF 2.0, text", (".gltf",), write_gltf),
)
