"""Checks for unsupported extensions of a glTF file.

In: a `GltfFile`. Out: an error for an unsupported extension that the file requires; one warning for
each other.
"""

from __future__ import annotations

from ...reading.text import shown
from . import (
    gltf_draco,
    gltf_materials,
    gltf_meshopt,
    gltf_nodes,
    gltf_pointers,
    gltf_primitives,
    gltf_textures,
    gltf_vrm,
)
from .gltf_file import GltfFile

_MODULES = (
    *(gltf_draco, gltf_materials, gltf_meshopt, gltf_nodes, gltf_pointers, gltf_primitives),
    *(gltf_textures, gltf_vrm),
)
READ = frozenset().union(*(module.READ for module in _MODULES))
# Extensions that affect only appearance or metadata; the rest of the file is right without them.
_OF_LOOKS = ("KHR_materials_", "KHR_xmp")


def check_extensions(file: GltfFile) -> None:
    """Refuse a file that requires an unsupported extension; warn of the others.

    Raises
    ------
    FileFormatError
    """
    used = file.sound("extensionsUsed", _names, file, "extensionsUsed") or []
    required = _names(file, "extensionsRequired")
    lacking = [name for name in required if name not in READ and not name.startswith(_OF_LOOKS)]
    if lacking:
        raise file.error(f"needs the extension {shown(lacking[0])}, which is not read")
    for name in dict.fromkeys(used + required + _of_materials(file)):
        if name not in READ:
            file.warnings.add(f"the extension {shown(name)} is not read")


def _of_materials(file: GltfFile) -> list[str]:
    """Return the extensions used by materials, listed or not: files may forget the list."""
    return [
        name
        for index, material in enumerate(file.entries("materials"))
        for name in file.spare_part(material, "extensions", f"materials[{index}]")
    ]


def _names(file: GltfFile, name: str) -> list[str]:
    names = file.tree.get(name, [])
    if not isinstance(names, list) or not all(isinstance(entry, str) for entry in names):
        raise file.damaged(f"{name} is no list of names")
    return names
