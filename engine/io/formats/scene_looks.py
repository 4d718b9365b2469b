"""The appearance data of a scene file: environments, textures and materials.

In: entries of the file's lists. Out: environments, textures and materials, or an error that names
the place. Unreadable files give a warning and a placeholder.
"""

from __future__ import annotations

import inspect
import math
import os
from typing import Any

import numpy as np

from ...errors import FileFormatError, InvalidArgumentError
from ...model.environments.environment import (
    BUILT_IN,
    Environment,
    environment_of,
    named_environment,
)
from ...model.materials.linear_colors import floats_are_linear
from ...model.materials.material import TEXTURE_SLOTS, Material
from ...model.materials.textures import (
    ImageFile,
    PlacedTexture,
    Texture,
    image_file_of,
    remember_image_file,
)
from ..reading.json_values import JsonValue
from ..reading.linked_files import LinkedFileError, LinkedFiles
from ..reading.loading import texture_of
from ..reading.sources import Source
from ..reading.text import shown
from ..reading.warning_list import WarningList
from .images import read_image

_MAX_NAME = 4096
_MATERIAL_FIELDS = frozenset(inspect.signature(Material).parameters)


class SceneLooks:
    """The environments, textures and materials of a scene file.

    Attributes
    ----------
    environments : list of Environment or None
        None if its file cannot be read.
    materials : list of Material
    """

    def __init__(
        self, source: Source, root: JsonValue, files: LinkedFiles, warnings: WarningList
    ) -> None:
        self._source, self._files, self._warnings = source, files, warnings
        self._images: dict[str, Texture] = {}
        self.environments = [self._environment(entry) for entry in root.entries("environments")]
        self._textures = [self._texture(entry) for entry in root.entries("textures")]
        self.materials = [self._material(entry) for entry in root.entries("materials")]

    def chosen(self, numbers: JsonValue) -> list[Material]:
        """Return the materials with given numbers."""
        count = len(self.materials)
        return [self.materials[number.index(count, "materials")] for number in numbers]

    def _environment(self, entry: JsonValue) -> Environment | None:
        """Return an environment; None, with a warning, if its file cannot be read."""
        if (name := entry.get("built_in")) is not None:
            if name.text() not in BUILT_IN:
                raise name.wrong(f"one of {', '.join(BUILT_IN)}")
            if name.text() == "sky" and "sun_direction" in entry.members():
                return _sky(entry)
            return named_environment(name.text())
        if (file := entry.get("file")) is not None:
            try:
                with self._files.read(self._files.find(file.text())) as source:
                    return environment_of(source)
            except (LinkedFileError, FileFormatError, OSError) as error:
                left_out = f"environment {shown(file.text())} is left out: {error}"
                self._warnings.add(f"{file.where}: {left_out}")
                return None
        pixels, name = entry.need("pixels"), entry.get("name")
        try:
            return Environment(pixels.array(), name="" if name is None else name.text())
        except InvalidArgumentError as error:
            raise pixels.error(str(error)) from None

    def _texture(self, entry: JsonValue) -> Texture:
        held = entry.members()
        numbers = [key for key in held if key in ("anisotropy", "lod_bias")]
        texts = (key for key in held if key not in ("file", "png", "wrap", *numbers))
        options: dict[str, Any] = {key: held[key].text() for key in texts}
        options |= {key: held[key].value for key in numbers}  # checked by Texture
        if (wrap := entry.get("wrap")) is not None:
            pair = isinstance(wrap.value, list)
            options["wrap"] = tuple(side.text() for side in wrap) if pair else wrap.text()
        png = entry.get("png")
        try:
            if png is None:
                return self._texture_of_file(entry.need("file"), options)
            name = f"{self._source.path}: {png.where}"
            pixels = read_image(Source(name, png.base64()))
            return Texture(pixels, **options)
        except FileFormatError:
            raise
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None

    def _texture_of_file(self, file: JsonValue, options: dict[str, Any]) -> Texture:
        name = file.text()
        if name not in self._images:
            self._images[name] = self._image(name, file)
        image = self._images[name]
        texture = Texture(image.pixels, **options)
        remember_image_file(texture, image_file_of(image))
        return texture

    def _image(self, name: str, file: JsonValue) -> Texture:
        """Return the image of a file, or a placeholder with a warning."""
        try:
            with self._files.read(self._files.find(name)) as source:
                return texture_of(source)
        except (LinkedFileError, FileFormatError, OSError) as error:
            self._warnings.add(f"{file.where}: texture {shown(name)} is left out: {error}")
        image = Texture(np.full((1, 1, 3), 255, np.uint8))
        remember_image_file(image, ImageFile(place_of(self._source, name), is_missing=True))
        return image

    def _material(self, entry: JsonValue) -> Material:
        values = {key: held.value for key, held in entry.members().items()}
        for slot in TEXTURE_SLOTS:
            if slot in values:
                values[slot] = self._slot(entry.need(slot))
        if values.get("attenuation_distance", 0) is None:
            values["attenuation_distance"] = math.inf
        try:
            with floats_are_linear():
                if not values.keys() <= _MATERIAL_FIELDS:
                    return Material(**values)  # Material reports unknown values
                material = Material()
                for key, value in values.items():
                    setattr(material, key, value)
                return material
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None

    def _slot(self, entry: JsonValue) -> Texture | PlacedTexture:
        """Return a texture by its number, or a placed one."""
        if not isinstance(entry.value, dict):
            return self._textures[entry.index(len(self._textures), "textures")]
        values = {key: held.value for key, held in entry.members().items()}
        number = entry.need("texture").index(len(self._textures), "textures")
        try:
            return PlacedTexture(**{**values, "texture": self._textures[number]})
        except (InvalidArgumentError, TypeError) as error:
            raise entry.error(str(error)) from None


def _sky(entry: JsonValue) -> Environment:
    """Return the sky of an entry, for its sun direction."""
    turbidity, disc = entry.get("turbidity"), entry.get("sun_disc")
    try:
        return Environment.sky(
            entry.need("sun_direction").value,
            3.0 if turbidity is None else turbidity.value,
            sun_disc=disc is None or disc.flag(),
        )
    except (InvalidArgumentError, TypeError) as error:
        raise entry.error(str(error)) from None


def place_of(source: Source, name: str) -> str | None:
    """Return the path where a missing file would be, if it has one."""
    if source.folder is None or "\0" in name or len(name) > _MAX_NAME:
        return None
    return os.path.abspath(os.path.join(source.folder, name))
