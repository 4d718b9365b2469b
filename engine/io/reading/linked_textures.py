"""The textures of a model: those its files refer to, and its companion texture.

In: names in files, or the model's own. Out: `Texture` objects, each image loaded once.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from ...errors import Engine3DError
from ...model.materials.material import Material
from ...model.materials.textures import Texture
from ..addresses.linked_urls import linked_files
from ..formats.radiance_pictures import LIGHT_EXTENSIONS
from .companion_textures import companion_texture
from .linked_files import LinkedFiles
from .sources import Source
from .text import shown
from .warning_list import WarningList

if TYPE_CHECKING:
    from ...choices import Wrap


class TextureCache:
    """The textures of one model, each image loaded once.

    Parameters
    ----------
    files : LinkedFiles
        The files that the model may name.
    """

    def __init__(self, files: LinkedFiles) -> None:
        self._files = files
        self._textures: dict[tuple[str, str, bool], Texture] = {}

    def get(
        self, name: str, folder: str | None, wrap: Wrap, is_data: bool = False
    ) -> tuple[Texture, str]:
        """Return the texture for a name, and a note about it ("" for none).

        Parameters
        ----------
        name : str
        folder : str
            The folder to search before the model's.
        wrap : {"repeat", "clamp"}
        is_data : bool
            Whether it holds numbers, not colours; this matters for images whose pixels are light.

        Raises
        ------
        LinkedFileError, Engine3DError
            The image is missing or damaged.
        """
        path, note = self._files.find_near(name, folder)
        # others are read the same way
        is_data = is_data and path.lower().endswith(LIGHT_EXTENSIONS)
        key = (os.path.realpath(path), wrap, is_data)
        if key not in self._textures:
            self._textures[key] = _read_texture(self._files, path, wrap, is_data)
        return self._textures[key], note


def give_companion_texture(
    source: Source, materials: list[Material], warnings: WarningList
) -> None:
    """Apply the companion texture to materials, if there is one, with a warning."""
    path = companion_texture(source.path, source.companion) if source.has_name else None
    if path is None:
        return
    name = shown(os.path.basename(path))
    try:
        texture = _read_texture(linked_files(source), path, "repeat")
    except Engine3DError as error:
        warnings.add(f"texture {name} beside the model left out: {error}")
        return
    warnings.add(f"no materials: {name} beside the model is taken as its texture, for its name")
    for material in materials:
        material.texture = texture


def _read_texture(files: LinkedFiles, path: str, wrap: Wrap, is_data: bool = False) -> Texture:
    from .loading import texture_of

    with files.read(path) as source:
        return texture_of(source, is_data=is_data, wrap=wrap)
