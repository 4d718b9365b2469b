"""Writer of glTF 2.0: scenes and meshes, as .glb, or as self-contained .gltf.

In: a scene, or a mesh. Out: a file that holds its tree, materials, textures, cameras, lights, skins
and animations. Source: Khronos, "glTF 2.0 Specification", 2021.
"""

from __future__ import annotations

import base64
import json
import struct
from typing import Any, BinaryIO

from ....base.files.atomic_write import AtomicFiles, Files, StreamFiles
from ....errors import InvalidArgumentError, located, warn
from ....model.geometry.mesh import Mesh
from ....model.scene.scene import Scene
from ...scenes.document_trees import TreeRecord
from ...writing.writer_registry import Writer
from ...writing.written_scene import tree_of_scene
from .written_tree import GltfTree

EXTENSIONS = (".glb", ".gltf")
_MAGIC, _VERSION = b"glTF", 2
_JSON, _BINARY = b"JSON", b"BIN\0"
_MOST = 2**32 - 1
_URI = "data:application/octet-stream;base64,"


def write_scene(scene: Scene, extension: str, file: BinaryIO) -> list[str]:
    """Write a scene to an open file; return a line for each thing that glTF cannot hold."""
    tree, told = tree_of_scene(scene)
    return [*told, *write_tree(tree, extension, file)]


def save_scene_as(scene: Scene, path: str | BinaryIO, extension: str) -> None:
    """Write a scene to a file or an open stream, as one of `EXTENSIONS`; warn of losses."""
    target: Any = path
    is_stream = hasattr(target, "write")
    name = "<stream>" if is_stream else str(target)
    with StreamFiles(target) if is_stream else AtomicFiles() as files:
        told = write_scene(scene, extension, files.create(name))
    for message in told:
        warn(located(message, name))


def write_tree(tree: TreeRecord, extension: str, file: BinaryIO) -> list[str]:
    """Write a tree to an open file, as one of `EXTENSIONS`; return as `write_scene`."""
    made = GltfTree(tree)
    if extension == ".gltf":
        if made.arrays.size:
            content = base64.b64encode(b"".join(made.arrays.chunks)).decode("ascii")
            made.json["buffers"] = [{"byteLength": made.arrays.size, "uri": _URI + content}]
        file.write(_text(made, indent=1) + b"\n")
    else:
        _write_glb(made, file)
    return list(dict.fromkeys(made.told))


def _write_glb(made: GltfTree, file: BinaryIO) -> None:
    if made.arrays.size:
        made.json["buffers"] = [{"byteLength": made.arrays.size}]
    text = _text(made)
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + (8 + made.arrays.size if made.arrays.size else 0)
    if size > _MOST:
        raise InvalidArgumentError(f"a .glb file holds at most {_MOST} bytes, not {size}")
    file.write(struct.pack("<4sII", _MAGIC, _VERSION, size))
    file.write(struct.pack("<I4s", len(text), _JSON) + text)
    if made.arrays.size:
        file.write(struct.pack("<I4s", made.arrays.size, _BINARY))
        for chunk in made.arrays.chunks:
            file.write(chunk)


def _text(made: GltfTree, indent: int | None = None) -> bytes:
    try:
        text = _json(made.json, indent)
    except (TypeError, ValueError, RecursionError):  # custom extras are not JSON
        made.told.append("extras that JSON does not hold are left out")
        text = _json(_without_odd_extras(made.json), indent)
    return text.encode("utf-8", "backslashreplace")


def _json(value: Any, indent: int | None) -> str:
    separators = (",", ":") if indent is None else (",", ": ")
    form: dict[str, Any] = {"separators": separators, "indent": indent, "ensure_ascii": False}
    return json.dumps(value, **form, allow_nan=False)


def _without_odd_extras(value: Any) -> Any:
    """Return a part of the tree without extras that JSON cannot hold."""
    if isinstance(value, list):
        return [_without_odd_extras(one) for one in value]
    if not isinstance(value, dict):
        return value
    return {
        key: one if key == "extras" else _without_odd_extras(one)
        for key, one in value.items()
        if key != "extras" or _is_json(one)
    }


def _is_json(value: Any) -> bool:
    try:
        _json(value, 1)
    except (TypeError, ValueError, RecursionError):
        return False
    return True


def _write_mesh(mesh: Mesh, file: BinaryIO, extension: str) -> list[str]:
    scene = Scene()
    scene.add(mesh, name=mesh.name)
    return write_scene(scene, extension, file)


def write_glb(mesh: Mesh, path: str, files: Files) -> list[str]:
    """Write a mesh as .glb; return a line for each loss."""
    return _write_mesh(mesh, files.create(path), ".glb")


def write_gltf(mesh: Mesh, path: str, files: Files) -> list[str]:
    """Write a mesh as .gltf; return a line for each loss."""
    return _write_mesh(mesh, files.create(path), ".gltf")


WRITERS = (
    Writer("glb", "glTF 2.0, binary", (".glb",), write_glb),
    Writer("gltf", "glTF 2.0, text", (".gltf",), write_gltf),
)
