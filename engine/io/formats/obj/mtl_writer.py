"""Writer of the material library and images of an OBJ file.

In: materials. Out: the text of a library, and the PNG files that it names. Extra statements of a
file (``extras``) are written as they were read; the images of undrawn maps are not copied.
"""

from __future__ import annotations

import os
import re
from typing import Any

from ...._native.images import encode_png
from ....base.files.atomic_write import AtomicFiles
from ....model.materials.colors import display_numbers
from ....model.materials.material import Material, states_nothing, textures_of
from ...writing.rows import float_words
from ...writing.side_files import LIBRARY_MARK, SideFiles
from ...writing.written_names import encoded, line_text, unique
from .mtl_alpha import OPACITY_MAPS
from .mtl_statements import parse_map

_COLORS = ("Ka", "Tf")
_SCALARS = ("Ni", "sharpness", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor", "Pcor")
# Our own and glTF's keys, replaced by statements unless these exist already.
_SYNONYMS = {"metallicFactor": ("Pm",), "roughnessFactor": ("Pr",)}
_SAID_ELSEWHERE = {"illum", "maps", *_SYNONYMS}
_OWN_WORDS = {"newmtl", "Kd", "Ks", "Ns", "Ke", "d", "Tr", "opacity", "illum"}
_OWN_WORDS |= {*_COLORS, *_SCALARS, *_SYNONYMS}
_OWN_WORDS |= {"maps", "bump", "disp", "decal", "refl", "norm"}
# Keys of extras that the material's alpha replaces.
_ALPHA = {"d", "Tr", "opacity"}
# Options of map_Kd already applied to the texture coordinates and the texture.
_APPLIED = ("name", "s", "o", "clamp")


def is_plain(materials: list[Material]) -> bool:
    """Return whether reading without a library would give the same material."""
    return len(materials) == 1 and not materials[0].name and states_nothing(materials[0])


def material_names(materials: list[Material]) -> list[str]:
    """Return a distinct, valid name for each material."""
    return unique(
        line_text(material.name) or f"material_{number}"
        for number, material in enumerate(materials)
    )


class Library:
    """Writes a library and its images; they appear with the other ``files``.

    Attributes
    ----------
    unwritten : dict of str to list of str
        What could not be written, and for which materials.
    not_copied : list of str
        Images that it names but does not copy.
    """

    def __init__(self, side_files: SideFiles, files: AtomicFiles) -> None:
        self._side_files = side_files
        self._files = files
        self._image_names: dict[int, str] = {}
        self.unwritten: dict[str, list[str]] = {}
        self.not_copied: list[str] = []

    def write(self, materials: list[Material], names: list[str]) -> None:
        """Write the materials, each under its name."""
        text = "\n".join(
            line
            for material, name in zip(materials, names, strict=True)
            for line in [*self._statements(material, name), ""]
        )
        self._files.create(self._side_files.library, below=self._side_files.folder).write(
            LIBRARY_MARK + encoded(text)
        )

    def _statements(self, material: Material, name: str) -> list[str]:
        specular = display_numbers(material.specular)
        lines = [f"newmtl {name}"]
        if not states_nothing(material):
            lines.append(f"Kd {_numbers(display_numbers(material.rgb))}")
        lines += [f"Ks {_numbers(specular)}", f"Ns {_numbers([material.shininess])}"]
        if any(emissive := display_numbers(material.emissive)):
            lines.append(f"Ke {_numbers(emissive)}")
        if material.alpha_mode == "blend" and material.alpha < 1:
            lines.append(f"d {_numbers([material.alpha])}")
        extras = {k: v for k, v in material.extras.items() if k not in _ALPHA}
        illum: Any = extras.get("illum")
        if not _are_numbers([illum]) or (illum < 2 and any(specular)):
            illum = 2.0 if any(specular) else 1.0
        lines.append(f"illum {_numbers([illum])}")
        lines += self._extra_statements(extras, name)
        return lines + self._map_statements(material, name)

    def _extra_statements(self, extras: dict[str, Any], name: str) -> list[str]:
        lines = []
        for key, value in extras.items():
            line = _statement(key, value)
            if line is not None:
                lines.append(line)
            elif key in _SYNONYMS and _are_numbers([value]):
                if not any(statement in extras for statement in _SYNONYMS[key]):
                    lines.append(f"{_SYNONYMS[key][0]} {_numbers([value])}")
            elif key not in _SAID_ELSEWHERE or key in _SYNONYMS:
                self._leave_out(f"extras[{key!r}]", name)
        return lines

    def _map_statements(self, material: Material, name: str) -> list[str]:
        maps = material.extras.get("maps", {})
        maps = dict(maps) if isinstance(maps, dict) else {}
        texture, entry = textures_of(material).get("texture"), maps.pop("map_Kd", {})
        lines = []
        if texture is not None:
            options = {"clamp": ["on"]} if texture.wrap == "clamp" else {}
            rest = entry if isinstance(entry, dict) else {}
            options |= {key: words for key, words in rest.items() if key not in _APPLIED}
            image = self._image(texture)
            lines.append(_map_statement("map_Kd", {**options, "name": image}) or f"map_Kd {image}")
            if material.alpha_mode != "opaque" and (texture.pixels[:, :, 3] != 255).any():
                maps = {
                    key: entry for key, entry in maps.items() if key.lower() not in OPACITY_MAPS
                }
                lines.append(f"map_d {image}")
        elif entry:
            self._leave_out("map_Kd without its image", name)
        for key, entry in maps.items():
            line = _map_statement(key, entry)
            if line is None:
                self._leave_out(f"extras['maps'][{key!r}]", name)
            else:
                lines.append(line)
                self.not_copied.append(entry["name"])
        return lines

    def _leave_out(self, thing: str, name: str) -> None:
        self.unwritten.setdefault(thing, []).append(name)

    def _image(self, texture: Any) -> str:
        """Return the file name of a texture; write the file on first use."""
        name = self._image_names.get(id(texture))
        if name is None:
            path = self._side_files.next_image()
            self._files.create(path, below=self._side_files.folder).write(
                encode_png(texture.pixels)
            )
            name = self._image_names[id(texture)] = os.path.basename(path)
        return name


def _statement(key: Any, value: Any) -> str | None:
    """Return the line that reads back as these extras, or None."""
    if key in _COLORS:
        return f"{key} {_numbers(value)}" if _are_numbers(value, 3) else None
    if key in _SCALARS:
        return f"{key} {_numbers([value])}" if _are_numbers([value]) else None
    is_free = _is_word(key) and key not in _OWN_WORDS and not key.startswith("map_")
    if not is_free or not isinstance(value, str) or line_text(value) != value:
        return None
    return f"{key} {value}".rstrip()


def _map_statement(key: str, entry: dict[str, Any]) -> str | None:
    """Return the line that reads back as this map, or None."""
    try:
        options = [
            f"-{option} {' '.join(words)}" for option, words in entry.items() if option != "name"
        ]
        line = " ".join([key, *options, entry["name"]])
    except (AttributeError, KeyError, TypeError):
        return None
    is_read_so = parse_map(line.partition(" ")[2]) == entry and line_text(line) == line
    return line if is_read_so and _is_word(key) else None


def _is_word(key: Any) -> bool:
    return isinstance(key, str) and re.fullmatch(r"[A-Za-z_][\w.-]*", key, re.ASCII) is not None


def _are_numbers(values: Any, count: int = 1) -> bool:
    try:
        return len(values) == count and all(abs(float(value)) < 3e38 for value in values)
    except (TypeError, ValueError):
        return False


def _numbers(values: Any) -> str:
    return b" ".join(float_words([float(value) for value in values])).decode()
