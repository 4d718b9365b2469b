"""The material library and the images beside an OBJ file.

In: materials. Out: the text of a library, and the PNG files that it names, all under the model's
name. What a file said of a material beyond our own fields (``extras``) is written as it was read,
but for the images of other maps, which stay where they are.
"""

from __future__ import annotations

import os
import re

from .._native.images import encode_png
from ..atomic_write import AtomicFiles
from ..colors import linear_color
from ..materials import Material
from .names import encoded
from .rows import float_words

_COLORS = ("Ka", "Tf")
_SCALARS = ("Ni", "d", "Tr", "sharpness", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor", "Pcor")


def is_plain(materials: list[Material]) -> bool:
    """Tell whether a reader makes the same of a file without a library."""
    return len(materials) == 1 and _fields(materials[0]) == _fields(Material())


def _fields(material: Material) -> tuple:
    return (
        material.name,
        tuple(linear_color(material.color).tolist()),
        material.texture,
        *(tuple(linear_color(c).tolist()) for c in (material.specular, material.emissive)),
        material.extras,
    )


def material_names(materials: list[Material]) -> list[str]:
    """Return a name for each material that a library can hold, all different."""
    copies: dict[str, int] = {}  # of each name that is taken, the last number behind it
    names: list[str] = []
    for number, material in enumerate(materials):
        name = re.sub(r"(^|\s)#", r"\1_", " ".join(material.name.split())).rstrip("\\")
        name = name or f"material_{number}"
        candidate = name
        while candidate in copies:
            copies[name] += 1
            candidate = f"{name}_{copies[name]}"
        copies[candidate] = 1
        names.append(candidate)
    return names


def write_library(
    materials: list[Material], names: list[str], path: str, files: AtomicFiles
) -> None:
    """Write a library ``path``, and its images beside it; they appear with the other ``files``."""
    folder, file_name = os.path.split(path)
    images = _Images(folder, os.path.splitext(file_name)[0], files)
    text = "\n".join(
        line
        for material, name in zip(materials, names, strict=True)
        for line in [*_statements(material, name, images), ""]
    )
    files.create(path).write(b"# written by engine3d\n" + encoded(text))


class _Images:
    """Writes each texture once."""

    def __init__(self, folder: str, stem: str, files: AtomicFiles) -> None:
        self._folder = folder
        self._stem = stem
        self._files = files
        self._names: dict[int, str] = {}

    def name(self, texture) -> str:
        name = self._names.get(id(texture))
        if name is None:
            name = f"{self._stem}_{len(self._names)}.png"
            file = self._files.create(os.path.join(self._folder, name))
            file.write(encode_png(texture.pixels))
            self._names[id(texture)] = name
        return name


def _statements(material: Material, name: str, images: _Images) -> list[str]:
    specular = linear_color(material.specular)
    extras = material.extras
    lines = [f"newmtl {name}", f"Kd {_numbers(linear_color(material.color))}"]
    lines += [f"Ks {_numbers(specular)}", f"Ns {_numbers([material.shininess])}"]
    if linear_color(material.emissive).any():
        lines.append(f"Ke {_numbers(linear_color(material.emissive))}")
    illum = extras.get("illum", 2.0 if specular.any() else 1.0)
    lines.append(f"illum {_numbers([illum])}")
    lines += [f"{key} {_numbers(extras[key])}" for key in _COLORS if key in extras]
    lines += [f"{key} {_numbers([extras[key]])}" for key in _SCALARS if key in extras]
    if material.texture is not None:
        clamp = "-clamp on " if material.texture.wrap == "clamp" else ""
        lines.append(f"map_Kd {clamp}{images.name(material.texture)}")
    for key, entry in extras.get("maps", {}).items():
        if key != "map_Kd":
            options = " ".join(
                f"-{option} {' '.join(words)}"
                for option, words in entry.items()
                if option != "name"
            )
            lines.append(f"{key} {options + ' ' if options else ''}{entry['name']}")
    return lines


def _numbers(values) -> str:
    return b" ".join(float_words(values)).decode()
