"""The materials of a glTF file.

In: a `GltfFile` and its textures. Out: a `Material` for each number, with all fields of the core
format and of the extensions in `READ`; invalid values are left out with a warning.
KHR_materials_pbrSpecularGlossiness is converted as KHR_materials_ior and KHR_materials_specular
describe: no metal, an index of refraction of 0, the specular colour.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from ....errors import InvalidArgumentError
from ....model.materials.linear_colors import floats_are_linear
from ....model.materials.material import PARAMETERS, TEXTURE_SLOTS, Material, imply
from ....model.materials.textures import PlacedTexture, Texture
from .gltf_file import Entry, GltfFile, whole_of
from .gltf_textures import GltfTextures, changed

_GLOSSY, _UNLIT = "KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit"
_VARIANTS = "KHR_materials_variants"


class Numbers(NamedTuple):
    """A numeric property in a part of a material."""

    field: str
    key: str
    default: float | tuple[float, ...]


class Map(NamedTuple):
    """A texture in a part of a material, with the number stored beside it."""

    field: str
    key: str
    beside: str = ""
    beside_key: str = ""


# The defaults in files, where they differ from those of `Material`.
_LEFT_OUT: dict[str, float | tuple[float, ...]]
_LEFT_OUT = {"color": (1.0, 1.0, 1.0, 1.0), "metallic": 1.0, "roughness": 1.0}


def _parts() -> dict[str, tuple[Numbers | Map, ...]]:
    """Return the parameters of `Material` by their part of the file, textures last."""
    rows = {field: row for field, row in PARAMETERS.items() if row.gltf}
    texts = [(*row.gltf.partition("."), field) for field, row in rows.items()]
    beside = {texture: (field, key) for texture, dot, key, field in texts if dot}
    found: dict[str, list[Numbers | Map]] = {}
    for field, row in sorted(rows.items(), key=lambda item: item[0] in TEXTURE_SLOTS):
        key = row.gltf.rpartition("/")[2]
        if field in TEXTURE_SLOTS:
            found[row.part].append(Map(field, key, *beside.get(row.gltf, ())))
        elif "." not in key:
            default = _LEFT_OUT.get(field, row.default)
            linear = tuple(map(float, default)) if isinstance(default, tuple) else default
            found.setdefault(row.part, []).append(Numbers(field, key, linear))
    return {part: tuple(items) for part, items in found.items()}


#: The parts of a material by their names in files; "" for the material itself.
PARTS = _parts()
_GLOSSY_PARTS = (
    Numbers("color", "diffuseFactor", (1.0, 1.0, 1.0, 1.0)),
    Numbers("specular_color", "specularFactor", (1.0, 1.0, 1.0)),
    Map("texture", "diffuseTexture"),
    Map("specular_color_texture", "specularGlossinessTexture"),
)
#: The extensions handled here.
READ = {*(name for name in PARTS if name.startswith("KHR")), _GLOSSY, _UNLIT, _VARIANTS}


class GltfMaterials:
    """The materials of a file, each created once.

    Parameters
    ----------
    file : GltfFile
    textures : GltfTextures
    """

    def __init__(self, file: GltfFile, textures: GltfTextures) -> None:
        self._file, self._textures = file, textures
        self._variant_names: tuple[str, ...] | None = None
        self._made: dict[tuple[int | None, bool, tuple[int, ...]], Material] = {}
        self._sets: dict[int, set[int]] = {}
        self._textures.decode(self._named_textures())

    def all(self) -> tuple[Material, ...]:
        """Return all materials of the file, for meshes with normals.

        Unused materials with equal content share one object.
        """
        used = {index for index, *_ in self._made}
        unused: dict[str, Material] = {}
        found = []
        for index, entry in enumerate(self._file.entries("materials")):
            if index in used:
                found.append(self.get(index, ""))
                continue
            words = repr(entry)
            if words not in unused:
                unused[words] = self.get(index, "")
            found.append(unused[words])
        return tuple(found)

    def made(self) -> dict[int, tuple[Material, ...]]:
        """Return all variants created so far for each material."""
        found: dict[int, tuple[Material, ...]] = {}
        for (index, *_), material in self._made.items():
            if index is not None:
                found[index] = (*found.get(index, ()), material)
        return found

    def get(
        self,
        index: int | None,
        where: str,
        *,
        flat: bool = False,
        uv_sets: tuple[int, ...] = (0, 1),
    ) -> Material:
        """Return a material.

        Parameters
        ----------
        index : int or None
            None for the default material.
        where : str
            The place that refers to it.
        flat : bool
            Whether it is for triangles without normals.
        uv_sets : tuple of int
            The file's UV sets that the mesh has.
        """
        entry = {} if index is None else self._file.entry("materials", index, where)
        key = index, flat, uv_sets
        if key not in self._made:
            self._made[key] = self._material(entry, f"materials[{index}]", flat, uv_sets)
            if index is None:
                imply(self._made[key])
        return self._made[key]

    def number(self, primitive: Entry, where: str) -> int | None:
        """Return the number of a primitive's material; None if it has no valid one."""
        if primitive.get("material") is None:
            return None
        place = f"{where}.material"
        return self._file.sound(
            place, self._file.number_in, "materials", primitive["material"], place
        )

    def uv_sets(self, primitive: Entry, where: str) -> set[int]:
        """Return the UV sets that the materials of a primitive use."""
        usual = self.number(primitive, where)
        indices = [] if usual is None else [usual]
        indices += [material for material, _ in self.variants(primitive, where)]
        return set().union(*(self._uv_sets(index, where) for index in indices))

    def variants(self, primitive: Entry, where: str) -> list[tuple[int, list[int]]]:
        """Return the alternative materials of a primitive, each with its variants."""
        extensions = self._file.spare_part(primitive, "extensions", where)
        if _VARIANTS not in extensions:
            return []
        where = f"{where}.{_VARIANTS}"
        return self._file.sound(where, self._mappings, extensions, where) or []

    def _mappings(self, extensions: Entry, where: str) -> list[tuple[int, list[int]]]:
        file, count = self._file, len(self.variant_names())
        found = []
        mappings = file.entries("mappings", file.part(extensions, _VARIANTS, where), f"{where}.")
        for mapping in mappings:
            material = file.number_in("materials", mapping.get("material"), where)
            variants = mapping.get("variants")
            if not isinstance(variants, list):
                raise file.damaged(f"{where}.mappings name no variants")
            numbers = [file.index(variant, count, "variants", where) for variant in variants]
            found.append((material, numbers))
        return found

    def variant_names(self) -> tuple[str, ...]:
        """Return the names of the file's material variants."""
        if self._variant_names is None:
            names = self._file.sound(f"extensions.{_VARIANTS}", self._read_variant_names)
            self._variant_names = names or ()
        return self._variant_names

    def _read_variant_names(self) -> tuple[str, ...]:
        file, where = self._file, f"extensions.{_VARIANTS}."
        entries = file.entries("variants", file.extension(_VARIANTS), where)
        return tuple(
            file.name(entry, f"{where}variants[{index}]") for index, entry in enumerate(entries)
        )

    def _uv_sets(self, index: int, where: str) -> set[int]:
        entry = self._file.entry("materials", index, where)
        if index not in self._sets:
            where = f"materials[{index}]"
            self._sets[index] = {
                self._textures.uv_set(info, where) for info in self._infos(entry, where)
            }
        return self._sets[index]

    def _named_textures(self) -> set[int]:
        """Return the existing textures that materials refer to."""
        count = len(self._file.entries("textures"))
        infos = [
            info
            for index, entry in enumerate(self._file.entries("materials"))
            for info in self._infos(entry, f"materials[{index}]")
        ]
        indices = [whole_of(info.get("index")) for info in infos]
        named = {index for index in indices if type(index) is int}
        return {index for index in named if 0 <= index < count}

    def _parts(self, entry: Entry, where: str) -> Iterator[tuple[Entry, tuple[Numbers | Map, ...]]]:
        """Return the parts of a material, with their possible properties."""
        file = self._file
        extensions = file.spare_part(entry, "extensions", where)
        glossy = _GLOSSY in extensions
        for name, items in PARTS.items():
            if not name:
                yield entry, items
            elif name == "pbrMetallicRoughness":
                part = file.spare_part(entry, name, where)
                yield from () if glossy else [(part, items)]
            elif name in extensions:
                yield file.spare_part(extensions, name, where), items
        if glossy:
            yield file.spare_part(extensions, _GLOSSY, where), _GLOSSY_PARTS

    def _infos(self, entry: Entry, where: str) -> list[Entry]:
        """Return a material's texture references."""
        return [
            self._file.spare_part(part, item.key, where)
            for part, items in self._parts(entry, where)
            for item in items
            if isinstance(item, Map) and item.key in part
        ]

    def _material(self, entry: Entry, where: str, flat: bool, uv_sets: tuple[int, ...]) -> Material:
        file = self._file
        values: dict[str, Any] = {"metallic": 1.0, "roughness": 1.0}
        for part, items in self._parts(entry, where):
            for item in items:
                if item.key in part:
                    place = f"{where}.{item.key}"
                    held = file.sound(place, self._values, part, item, where, uv_sets)
                    values.update(held or {})
        extensions = file.spare_part(entry, "extensions", where)
        if _GLOSSY in extensions:
            glossiness = file.sound(
                f"{where}.glossinessFactor",
                file.number,
                file.spare_part(extensions, _GLOSSY, where),
                "glossinessFactor",
                where,
                1,
            )
            values.update(_from_glossiness(values, 1.0 if glossiness is None else glossiness))
        color = values.get("color", (1.0, 1.0, 1.0))
        values["color"] = color[:3] if color[3:] == (1.0,) else color
        values |= {
            "name": file.name(entry, where),
            "two_sided": entry.get("doubleSided") is True,
            "unlit": _UNLIT in extensions,
            "alpha_mode": self._alpha_mode(entry, where),
            "flat_shading": flat,
            "extras": self._extras(entry, where),
        }
        material = Material(name=values.pop("name"))
        with floats_are_linear():
            for field, value in values.items():
                self._file.sound(f"{where}.{field}", self._put, material, field, value)
        return material

    def _put(self, material: Material, field: str, value: Any) -> None:
        try:
            setattr(material, field, value)
        except InvalidArgumentError as error:
            raise self._file.damaged(str(error)) from None

    def _values(
        self, part: Entry, item: Numbers | Map, where: str, uv_sets: tuple[int, ...]
    ) -> dict[str, Any]:
        """Return the values of one item, as parameters of a material."""
        if isinstance(item, Numbers):
            if isinstance(item.default, tuple):
                return {item.field: self._file.numbers(part, item.key, where, item.default)}
            return {item.field: self._file.number(part, item.key, where, item.default)}
        info = self._file.part(part, item.key, where)
        values: dict[str, Any]
        values = {item.field: self._textures.placed(info, f"{where}.{item.key}", uv_sets)}
        if item.beside and item.beside_key in info:
            values[item.beside] = self._file.number(info, item.beside_key, where, 1.0)
        return values

    def _alpha_mode(self, entry: Entry, where: str) -> str:
        mode = entry.get("alphaMode", "OPAQUE")
        if mode not in ("OPAQUE", "MASK", "BLEND"):
            self._file.warnings.add_once(f"{where} has no alpha mode that is known: drawn opaque")
            mode = "OPAQUE"
        return mode.lower()

    def _extras(self, entry: Entry, where: str) -> Entry:
        extras = entry.get("extras", {})
        if isinstance(extras, dict):
            return extras
        self._file.warnings.add_once(f"{where}.extras is no object: left out")
        return {}


def _from_glossiness(values: dict[str, Any], glossiness: float) -> dict[str, Any]:
    """Convert a specular-glossiness material to metallic-roughness."""
    found: dict[str, Any] = {"metallic": 0.0, "roughness": 1.0 - glossiness, "ior": 0.0}
    held: Texture | PlacedTexture | None = values.get("specular_color_texture")
    if held is not None:
        texture = held.texture if isinstance(held, PlacedTexture) else held
        roughness = np.zeros_like(texture.pixels)
        gloss = texture.pixels[:, :, 3].astype(np.float64) * glossiness
        roughness[:, :, 1] = np.floor(255.0 - gloss + 0.5).clip(0, 255)
        roughness[:, :, 3] = 255
        made = changed(texture, roughness, texture.name)
        found |= {"metallic_roughness_texture": made, "roughness": 1.0}
        if isinstance(held, PlacedTexture):
            place = {key: value for key, value in vars(held).items() if key != "texture"}
            found["metallic_roughness_texture"] = PlacedTexture(made, **place)
    return found
