"""The materials and textures of a written glTF file.

In: `Material` objects. Out: their numbers, and the lists of the JSON. An unchanged image keeps its
encoded bytes; others become PNG. Non-physical materials are converted to similar physical ones.
"""

from __future__ import annotations

import os
from typing import Any

from ...._native.images import encode_png
from ....errors import Engine3DError
from ....model.materials.colors import linear_color
from ....model.materials.linear_colors import LinearColor
from ....model.materials.material import Material, is_implied, states_nothing
from ....model.materials.phong import roughness_of
from ....model.materials.textures import PlacedTexture, Texture, image_file_of
from ...reading.sources import read_source
from ...writing.losses import lost_of_reading
from .gltf_materials import PARTS, Map, Numbers
from .written_arrays import GltfArrays

_WRAPS = {"clamp": 33071, "mirror": 33648, "repeat": 10497}
_NEAREST, _LINEAR, _LEVELS = 9728, 9729, 9987
_FILTERS = {
    "nearest": (_NEAREST, _NEAREST),
    "bilinear": (_LINEAR, _LINEAR),
    "trilinear": (_LINEAR, _LEVELS),
}
_TRANSFORM, _UNLIT = "KHR_texture_transform", "KHR_materials_unlit"
# Signatures of images -> media type, and the extension that a texture needs for it.
_IMAGES = (
    (b"\x89PNG\r\n\x1a\n", "image/png", None),
    (b"\xff\xd8\xff", "image/jpeg", None),
    (b"RIFF", "image/webp", "EXT_texture_webp"),
    (b"\xabKTX 20\xbb\r\n\x1a\n", "image/ktx2", "KHR_texture_basisu"),
)


class GltfMaterialList:
    """The materials of a file, each written once.

    Parameters
    ----------
    arrays : GltfArrays

    Attributes
    ----------
    materials, textures, images, samplers : list of dict
        The lists in the JSON.
    extensions : set of str
        The extensions used.
    required : set of str
    converted : int
        How many materials that state something were converted to physical ones.
    mirrors : list of str
        The names of materials that mirror, which glTF cannot hold.
    lost : dict of str to int
        Sampling settings that glTF cannot hold, and how many textures have them.
    """

    def __init__(self, arrays: GltfArrays) -> None:
        self._arrays = arrays
        self.materials: list[dict[str, Any]] = []
        self.textures: list[dict[str, Any]] = []
        self.images: list[dict[str, Any]] = []
        self.samplers: list[dict[str, Any]] = []
        self.extensions: set[str] = set()
        self.required: set[str] = set()
        self.converted = 0
        self.mirrors: list[str] = []
        self.lost: dict[str, int] = {}
        self._numbers: dict[int, int] = {}
        self._twins: dict[tuple[str, bool], list[int]] = {}
        self._images: dict[int, tuple[int, str | None]] = {}
        self._read: set[int] = set()
        self._kept: list[Any] = []  # keeps IDs from being reused

    def number(self, material: Material) -> int | None:
        """Return the number of a material; None for the default material."""
        if id(material) not in self._numbers:
            self._kept.append(material)
            self._numbers[id(material)] = self._add(material)
        number = self._numbers[id(material)]
        return None if number < 0 else number

    def _add(self, material: Material) -> int:
        if material.mirror:
            self.mirrors.append(material.name or f"material_{len(self.materials)}")
        entry = self._entry(material)
        if not entry and is_implied(material):
            return -1
        # If a flat and a smooth material are otherwise equal, the file's meshes tell them apart.
        words, flat = repr(entry), material.flat_shading
        if twins := self._twins.get((words, not flat)):
            return twins.pop()
        self._twins.setdefault((words, flat), []).append(len(self.materials))
        self.materials.append(entry)
        self.converted += not (material.is_physical or states_nothing(material))
        return len(self.materials) - 1

    def _entry(self, material: Material) -> dict[str, Any]:
        entry: dict[str, Any] = {"name": material.name} if material.name else {}
        if material.extras:
            entry["extras"] = material.extras
        extensions: dict[str, Any] = {}
        if material.unlit:
            extensions[_UNLIT] = {}
        for name, items in PARTS.items():
            part: dict[str, Any] = {}
            for item in items:
                part.update(self._words(material, item))
            if not name:
                entry.update(part)
            elif part and name == "pbrMetallicRoughness":
                entry[name] = part
            elif part:
                extensions[name] = part
        if material.alpha_mode != "opaque":
            entry["alphaMode"] = material.alpha_mode.upper()
        if material.two_sided:
            entry["doubleSided"] = True
        if extensions:
            self.extensions |= extensions.keys()
            entry["extensions"] = extensions
        return entry

    def _words(self, material: Material, item: Numbers | Map) -> dict[str, Any]:
        """Return the JSON of one item; nothing if it has the defaults."""
        if isinstance(item, Numbers):
            value = _value(material, item.field)
            return {} if value == item.default else {item.key: value}
        held = getattr(material, item.field)
        if held is None:
            return {}
        info = self._info(held)
        if item.beside and (beside := getattr(material, item.beside)) != 1.0:
            info[item.beside_key] = beside
        return {item.key: info}

    def _info(self, held: Texture | PlacedTexture) -> dict[str, Any]:
        if isinstance(held, Texture):
            return {"index": self._texture(held)}
        info: dict[str, Any] = {"index": self._texture(held.texture)}
        if held.uv_set:
            info["texCoord"] = held.uv_set
        defaults = {"offset": (0.0, 0.0), "rotation": 0.0, "scale": (1.0, 1.0)}
        values = {key: getattr(held, key) for key in defaults}
        moved = {key: value for key, value in values.items() if value != defaults[key]}
        if moved:
            self.extensions.add(_TRANSFORM)
            info["extensions"] = {_TRANSFORM: moved}
        return info

    def _texture(self, texture: Texture) -> int:
        if id(texture) not in self._read:
            self._read.add(id(texture))
            self._kept.append(texture)
            for thing in lost_of_reading(texture):
                self.lost[thing] = self.lost.get(thing, 0) + 1
        image, extension = self._image(texture)
        entry: dict[str, Any] = {}
        if extension is None:
            entry["source"] = image
        else:
            entry["extensions"] = {extension: {"source": image}}
        if (texture.wrap, texture.filter) != ("repeat", "trilinear"):
            entry["sampler"] = self._sampler(texture)
        return _number_of(self.textures, entry)

    def _sampler(self, texture: Texture) -> int:
        magnified, reduced = _FILTERS[texture.filter]
        u, v = (_WRAPS[wrap] for wrap in texture.side_wraps)
        entry = {"magFilter": magnified, "minFilter": reduced, "wrapS": u, "wrapT": v}
        return _number_of(self.samplers, entry)

    def _image(self, texture: Texture) -> tuple[int, str | None]:
        """Return the number of a texture's image, and the extension it needs."""
        key = id(texture.pixels)
        if key not in self._images:
            self._kept.append(texture.pixels)
            content, media, extension = _content(texture)
            if extension is not None:
                self.extensions.add(extension)
                self.required.add(extension)
            entry = {"bufferView": self._arrays.bytes(content), "mimeType": media}
            if texture.name:
                entry["name"] = texture.name
            self.images.append(entry)
            self._images[key] = len(self.images) - 1, extension
        return self._images[key]


def _number_of(entries: list[dict[str, Any]], entry: dict[str, Any]) -> int:
    if entry not in entries:
        entries.append(entry)
    return entries.index(entry)


def _content(texture: Texture) -> tuple[bytes, str, str | None]:
    """Return the bytes of a texture's image, their media type, and the extension they need."""
    path, content, is_missing = image_file_of(texture)
    if content is None and path is not None and not is_missing:
        content = _read(path)
    if content is not None:
        for signature, media, extension in _IMAGES:
            if content.startswith(signature):
                return content, media, extension
    return bytes(encode_png(texture.pixels)), "image/png", None


def _read(path: str) -> bytes | None:
    """Return the file that a texture came from, if it still exists and may still be read."""
    try:
        return read_source(path).data if os.path.isfile(path) else None
    except (OSError, Engine3DError):
        return None


def _value(material: Material, field: str) -> Any:
    """Return one or several numbers of a material, linear, as in files."""
    if field == "color":
        return (*_linear(material.rgb), material.alpha)
    if field in ("metallic", "roughness"):
        return _physical(material)[field == "roughness"]
    value = getattr(material, field)
    return _linear(value) if isinstance(value, tuple) else value


def _linear(color: tuple[Any, ...]) -> tuple[float, ...]:
    return tuple(color if isinstance(color, LinearColor) else linear_color(color).tolist())


def _physical(material: Material) -> tuple[float, float]:
    """Return metallic and roughness; a Blinn highlight becomes a GGX one of similar width."""
    if material.is_physical:
        metallic = 1.0 if material.metallic is None else material.metallic
        return metallic, 1.0 if material.roughness is None else material.roughness
    roughness = roughness_of(material)
    return 0.0, 1.0 if roughness is None else roughness
