"""The materials of a glTF file, as far as the engine has a place for them.

In: a `GltfFile` and its buffers. Out: a `Material` for each number, with the image of its base
colour; where the coordinates of that image stand; which kinds of things are left out. An image that
is missing, damaged or too large is a warning, its material has none then.
"""

from __future__ import annotations

import math

import numpy as np

from ..errors import Engine3DError
from ..materials.material import Material
from ..materials.textures import Texture
from .gltf_buffers import GltfBuffers
from .gltf_file import GltfFile
from .registry import find_reader
from .sources import Source
from .warning_list import WarningList

_WRAPS = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
_REPEAT, _NEAREST = 10497, 9728
_TRANSFORM, _WEBP = "KHR_texture_transform", "EXT_texture_webp"
_STRENGTH, _UNLIT = "KHR_materials_emissive_strength", "KHR_materials_unlit"
_GLOSSY = "KHR_materials_pbrSpecularGlossiness"
#: The extensions that are read here, or told of by a warning of their own.
READ = {_TRANSFORM, _WEBP, _STRENGTH, _UNLIT, _GLOSSY}
_NO_TRANSFORM = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


class GltfMaterials:
    """The materials of a file, each made once.

    Parameters
    ----------
    file : GltfFile
    buffers : GltfBuffers
    warnings : WarningList
    """

    def __init__(self, file: GltfFile, buffers: GltfBuffers, warnings: WarningList) -> None:
        self._file, self._buffers, self._warnings = file, buffers, warnings
        self._materials: dict[tuple, Material] = {}
        self._textures: dict[tuple, Texture | None] = {}
        self._undrawn: dict[int, set[str]] = {}

    def get(self, index: int | None, where: str, *, flat: bool) -> Material:
        """Return a material; with ``flat`` one for triangles without normals."""
        if (index, flat) not in self._materials:
            entry = {} if index is None else self._file.entry("materials", index, where)
            self._materials[index, flat] = self._material(entry, index, flat)
        return self._materials[index, flat]

    def coordinates(self, index: int | None, where: str) -> tuple[int, np.ndarray]:
        """Return the set of texture coordinates of a material's image, and what to do to them.

        Returns
        -------
        uv_set : int
        transform : (2, 3) float64
            Applies to (u, v, 1), v from the top down.
        """
        entry = {} if index is None else self._file.entry("materials", index, where)
        where = f"materials[{index}]"
        _, info = self._base(entry, where)
        transform = self._file.part(self._file.part(info, "extensions", where), _TRANSFORM, where)
        default = self._file.whole(info, "texCoord", where, 0)
        return self._file.whole(transform, "texCoord", where, default), _matrix(
            self._file, transform, where
        )

    def names(self) -> list[str]:
        """Return the names of the materials in use."""
        names = dict.fromkeys(material.name for material in self._materials.values())
        return [name for name in names if name]

    def undrawn(self) -> list[set[str]]:
        """Return for each material in use what is left out, as keys of `undrawn.KINDS`."""
        return list(self._undrawn.values())

    def _base(self, entry: dict, where: str) -> tuple[tuple[float, ...], dict]:
        """The factor of the base colour, and what is said of its image."""
        glossy = self._file.part(self._file.part(entry, "extensions", where), _GLOSSY, where)
        part = glossy or self._file.part(entry, "pbrMetallicRoughness", where)
        names = ("diffuseFactor", "diffuseTexture") if glossy else _BASE
        factor = self._file.numbers(part, names[0], where, (1.0, 1.0, 1.0, 1.0))
        return factor, self._file.part(part, names[1], where)

    def _material(self, entry: dict, index: int | None, flat: bool) -> Material:
        where = f"materials[{index}]"
        file = self._file
        factor, info = self._base(entry, where)
        emissive = file.numbers(entry, "emissiveFactor", where, (0.0, 0.0, 0.0))
        if min(*factor, *emissive) < 0:
            raise file.error(f"damaged: {where} has a factor below zero")
        strength = file.part(file.part(entry, "extensions", where), _STRENGTH, where)
        times = file.numbers({"s": [strength.get("emissiveStrength", 1.0)]}, "s", where, (1.0,))[0]
        undrawn = self._undrawn.setdefault(-1 if index is None else index, set())
        undrawn |= _undrawn_kinds(entry, file.part(entry, "pbrMetallicRoughness", where))
        texture = None if "index" not in info else self._texture(info["index"], where, undrawn)
        # Where an image says what gives off light, all of it would be too much.
        is_dark = "emission map" in undrawn or not math.isfinite(max(emissive) * times)
        return Material(
            name=str(entry.get("name") or ""),
            color=factor[:3],
            texture=texture,
            emissive=(0.0, 0.0, 0.0) if is_dark else tuple(e * max(times, 0) for e in emissive),
            two_sided=entry.get("doubleSided") is True,
            flat_shading=flat,
            extras=self._extras(entry, where),
        )

    def _extras(self, entry: dict, where: str) -> dict:
        part = self._file.part(entry, "pbrMetallicRoughness", where)
        return {
            key: self._file.numbers({name: [part[name]]}, name, where, (1.0,))[0]
            for key, name in (("Pm", "metallicFactor"), ("Pr", "roughnessFactor"))
            if name in part
        }

    def _texture(self, index, where: str, undrawn: set[str]) -> Texture | None:
        entry = self._file.entry("textures", index, where)
        where = f"textures[{index}]"
        sampler = {}
        if "sampler" in entry:
            sampler = self._file.entry("samplers", entry["sampler"], where)
        wraps = [_wrap(sampler.get(name, _REPEAT)) for name in ("wrapS", "wrapT")]
        if wraps[0] != wraps[1]:
            undrawn.add("wraps")
        webp = self._file.part(self._file.part(entry, "extensions", where), _WEBP, where)
        image = webp.get("source", entry.get("source"))
        if image is None:
            others = " that is read" if "extensions" in entry else ""
            self._warnings.add(f"{where} has no image{others}: left out")
            return None
        entry = self._file.entry("images", image, where)
        key = (image, wraps[0], "nearest" if sampler.get("magFilter") == _NEAREST else "trilinear")
        if key not in self._textures:
            self._textures[key] = self._load(entry, *key)
        return self._textures[key]

    def _load(self, entry: dict, image: int, wrap: str, filter: str) -> Texture | None:
        uri = entry.get("uri")
        is_file = isinstance(uri, str) and uri[:5].lower() != "data:"
        name = str(entry.get("name") or (uri if is_file else ""))
        where = f"images[{image}]"
        try:
            if "bufferView" in entry:
                data = bytes(self._buffers.view(entry["bufferView"], where))
            else:
                data = self._buffers.named(uri, where)
            source = Source(f"<{uri if is_file else where}>", data)
            pixels = find_reader(source, "image").read(source)
        except Engine3DError as error:
            reason = getattr(error, "message", None) or str(error)
            reason = reason.removeprefix(f"{where}: ")
            self._warnings.add(f"{where} is left out: {reason}")
            return None
        return Texture(pixels, wrap=wrap, filter=filter, name=name)


_BASE = ("baseColorFactor", "baseColorTexture")


def _wrap(value) -> str:
    return _WRAPS.get(value, "repeat") if type(value) is int else "repeat"


def _undrawn_kinds(entry: dict, physical: dict) -> set[str]:
    """What a material says that is not drawn, as keys of `undrawn.KINDS`."""
    extensions = entry.get("extensions", ())
    says = {
        "transparent": entry.get("alphaMode") == "BLEND",
        "cut out": entry.get("alphaMode") == "MASK",
        "emission map": "emissiveTexture" in entry,
        "normal map": "normalTexture" in entry,
        "occlusion": "occlusionTexture" in entry,
        "physical": "metallicRoughnessTexture" in physical
        or physical.get("metallicFactor", 0) != 0
        or physical.get("roughnessFactor", 1) != 1
        or _GLOSSY in extensions,
        "unlit": _UNLIT in extensions,
    }
    return {kind for kind, is_said in says.items() if is_said}


def _matrix(file: GltfFile, transform: dict, where: str) -> np.ndarray:
    """Scale, then turn, then move, as KHR_texture_transform has it."""
    if not transform.keys() & {"scale", "rotation", "offset"}:
        return _NO_TRANSFORM
    (across, down) = file.numbers(transform, "scale", where, (1.0, 1.0))
    (angle,) = file.numbers({"rotation": [transform.get("rotation", 0.0)]}, "rotation", where, (0,))
    (left, top) = file.numbers(transform, "offset", where, (0.0, 0.0))
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine * across, sine * down, left], [-sine * across, cosine * down, top]])
