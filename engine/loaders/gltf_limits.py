"""What a glTF file announces, found before anything is made of it.

In: the bytes of a `.gltf` or `.glb` file. Out: how many numbers its meshes would have, and which
files hold them. An accessor without bytes of its own stands for any number of zeros, and any number
of meshes may use the same accessor: a few hundred bytes announce gigabytes. What is no sound glTF
counts for nothing here: whoever reads it finds fault with it.
"""

from __future__ import annotations

import json
import struct
from typing import NamedTuple

_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
# A .glb begins with its header, and the length and kind of its first chunk, which is JSON.
_GLB, _CHUNK = b"glTF", 20


class Announced(NamedTuple):
    """What a file announces.

    Attributes
    ----------
    numbers : int
        In all accessors that meshes use, each time anew, and in those without bytes of their own.
    files : list of str
        The names of others that hold its buffers.
    """

    numbers: int
    files: list[str]


def announced(data: bytes) -> Announced:
    """Tell what a glTF file announces."""
    tree = _tree(data)
    uris = [buffer.get("uri") for buffer in _entries(tree, "buffers")]
    files = {uri for uri in uris if isinstance(uri, str) and not uri.startswith("data:")}
    return Announced(_numbers(tree), sorted(files))


def _numbers(tree: dict) -> int:
    accessors = _entries(tree, "accessors")
    sizes = [_size(accessor) for accessor in accessors]
    total = sum(
        size
        for accessor, size in zip(accessors, sizes, strict=True)
        if "bufferView" not in accessor or "sparse" in accessor
    )
    for mesh in _entries(tree, "meshes"):
        for primitive in _entries(mesh, "primitives"):
            attributes = primitive.get("attributes")
            used = list(attributes.values()) if isinstance(attributes, dict) else []
            for index in [*used, primitive.get("indices")]:
                if isinstance(index, int) and 0 <= index < len(sizes):
                    total += sizes[index]
    return total


def _tree(data: bytes) -> dict:
    if data.startswith(_GLB):
        if len(data) < _CHUNK:
            return {}
        (length,) = struct.unpack_from("<I", data, 12)
        data = data[_CHUNK : _CHUNK + length]
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return {}
    return tree if isinstance(tree, dict) else {}


def _entries(tree: dict, name: str) -> list[dict]:
    """A list of the tree; what is no object in it stands for an empty one."""
    entries = tree.get(name)
    if not isinstance(entries, list):
        return []
    return [entry if isinstance(entry, dict) else {} for entry in entries]


def _size(accessor: dict) -> int:
    count, kind = accessor.get("count"), accessor.get("type")
    width = _WIDTHS.get(kind, 0) if isinstance(kind, str) else 0
    return max(count, 0) * width if isinstance(count, int) else 0
