"""The materials of a PLY file, one for each image it names.

In: the names in ``comment TextureFile``, and the number of each triangle's image. Out: `Material`
objects, and that of each triangle. An image that is missing, damaged or outside the model's folder
gives a warning.
"""

from __future__ import annotations

import numpy as np

from ...._native.loaders import frozen
from ....errors import Engine3DError
from ....model.materials.material import Material
from ....model.materials.textures import Texture
from ...addresses.linked_urls import linked_files
from ...reading.linked_files import LinkedFileError
from ...reading.linked_textures import TextureCache, give_companion_texture
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.warning_list import WarningList

_MAX_TEXTURES = 1000


def read_materials(
    source: Source, names: list[str], has_uvs: bool, warnings: WarningList
) -> list[Material]:
    """Return the materials, at least one; a file without any may use its companion image."""
    if not names or not has_uvs:
        materials = [Material()]
        if has_uvs:
            give_companion_texture(source, materials, warnings)
        return materials
    if len(names) > _MAX_TEXTURES:
        warnings.add(f"{len(names)} textures, {_MAX_TEXTURES} are the limit")
    textures = TextureCache(linked_files(source))
    return [
        Material(name=name, texture=_texture(name, textures, source, warnings))
        for name in names[:_MAX_TEXTURES]
    ]


def _texture(
    name: str, textures: TextureCache, source: Source, warnings: WarningList
) -> Texture | None:
    try:
        texture, note = textures.get(name, source.folder, "repeat")
    except (LinkedFileError, Engine3DError) as error:
        warnings.add(f"texture {shown(name)}: {error}")
        return None
    if note:
        warnings.add(f"texture {shown(name)}: {note}")
    return texture


def material_ids(numbers: np.ndarray | None, triangles: int, materials: int) -> np.ndarray:
    """Return the material of each triangle: (T,) int32, the first for invalid image numbers."""
    if numbers is None:
        return frozen(np.zeros(triangles, np.int32))  # the mesh can keep it without copying
    is_known = (numbers >= 0) & (numbers < materials)
    return np.where(is_known, numbers, 0).astype(np.int32)
