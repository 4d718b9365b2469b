"""What a glTF file needs or says that is not read.

In: a `GltfFile`. Out: an error for an extension that it cannot be read without; one warning for
each other extension, and one for each kind of thing that is left out.
"""

from __future__ import annotations

from . import gltf_materials
from .gltf_file import GltfFile
from .text import shown
from .warning_list import WarningList

_READ = {*gltf_materials.READ, "KHR_mesh_quantization", "KHR_node_visibility"}
# What changes only how surfaces look or move: the rest of the file is right without it.
_OF_LOOKS = ("KHR_materials_", "KHR_lights_punctual", "KHR_animation_pointer", "KHR_xmp")


def check_extensions(file: GltfFile, warnings: WarningList) -> None:
    """Refuse a file that cannot be read without an unknown extension; tell of the others.

    Raises
    ------
    FileFormatError
    """
    used, required = (_names(file, name) for name in ("extensionsUsed", "extensionsRequired"))
    lacking = [name for name in required if name not in _READ and not name.startswith(_OF_LOOKS)]
    if lacking:
        raise file.error(f"needs the extension {shown(lacking[0])}, which is not read")
    for name in dict.fromkeys(used + required):
        if name not in _READ:
            warnings.add(f"the extension {shown(name)} is not read")


def warn_of_unread(file: GltfFile, meshes: set[int], warnings: WarningList) -> None:
    """Tell of animations, skins, morph targets and cameras.

    Parameters
    ----------
    file : GltfFile
    meshes : set of int
        Those that are in the scene.
    warnings : WarningList
    """
    entries = file.entries("meshes")
    morphed = sum(
        any("targets" in primitive for primitive in file.entries("primitives", entries[index]))
        for index in meshes
    )
    for count, one, several, consequence in (
        (len(file.entries("animations")), "animation", "animations", "left out"),
        (len(file.entries("skins")), "skin", "skins", "left out, what moves is drawn as modelled"),
        (morphed, "mesh has morph targets", "meshes have morph targets", "drawn without"),
        (len(file.entries("cameras")), "camera", "cameras", "left out"),
    ):
        if count:
            warnings.add(f"{count} {one if count == 1 else several}: {consequence}")


def _names(file: GltfFile, name: str) -> list[str]:
    names = file.tree.get(name, [])
    if not isinstance(names, list) or not all(isinstance(entry, str) for entry in names):
        raise file.error(f"damaged: {name} is no list of names")
    return names
