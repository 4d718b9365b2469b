"""The textures of a model: those that its files name, and the one beside it that bears its name.

In: names as they stand in files, or the model's own. Out: `Texture` objects, each image loaded
once.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from ...errors import Engine3DError
from ...model.materials.material import Material
from ...model.materials.textures import Texture
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
        """Return the texture that a name means, and what to say of it ("" for nothing).

        Parameters
        ----------
        name : str
        folder : str
            Where it is looked for first, before the model's folder.
        wrap : {"repeat", "clamp"}
        is_data : bool
            Whether its codes are numbers, not colours: of images whose pixels are light.

        Raises
        ------
        LinkedFileError, Engine3DError
            There is no such image, or it is damaged.
        """
        path, note = self._files.find_near(name, folder)
        is_data = is_data and path.lower().endswith(LIGHT_EXTENSIONS)  # others are read alike
        key = (os.path.realpath(path), wrap, is_data)
        if key not in self._textures:
            self._textures[key] = _read_texture(self._files, path, wrap, is_data)
        return self._textures[key], note


def give_companion_texture(
    source: Source, materials: list[Material], warnings: WarningList
) -> None:
    """Paint materials with the image that bears the model's name, if there is one, and say so."""
    path = companion_texture(source.path, source.companion) if source.has_name else None
    if path is None:
        return
    name = shown(os.path.basename(path))
    try:
        texture = _read_texture(LinkedFiles.of(source), path, "repeat")
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
