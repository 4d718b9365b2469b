"""The binary form of glTF 2.0, which `gltf` reads.

It is a separate module, so that this extension can be read without importing all formats.
"""

from __future__ import annotations

from ..reading.reader_registry import Reader
from .gltf.gltf import read_gltf
from .gltf.gltf_file import GLB


def _is_glb(head: bytes) -> bool:
    return head.startswith(GLB)


READERS = (Reader("glb", "glTF 2.0, binary", "mesh", (".glb",), read_gltf, _is_glb),)
