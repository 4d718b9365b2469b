"""Wavefront MTL: the material libraries that OBJ files name.

In: the bytes of a library. Out: materials by name. Colours are display values, as in
most programs. mtl_alpha.py handles alpha, and mtl_physical.py physically based materials and normal
maps. All other statements, d and Tr, and all maps with their options are kept in the material's
``extras`` under the file's own keys. An invalid line gives a warning; a library fails only if it is
not text.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ....errors import Engine3DError
from ....model.materials.colors import linear_from_display
from ....model.materials.linear_colors import LinearColor
from ....model.materials.material import Material
from ....model.materials.textures import Texture
from ...reading.linked_files import LinkedFileError
from ...reading.linked_textures import TextureCache
from ...reading.sources import Source
from ...reading.text import decoded, shown, text_lines
from ...reading.warning_list import WarningList
from .mtl_alpha import OPACITY_MAPS, set_alpha
from .mtl_physical import PHYSICAL_MAPS, physical_fields
from .mtl_statements import (
    COLORS,
    SCALARS,
    MapEntry,
    color_of,
    is_map,
    keyword_of,
    looks_like_a_look,
    parse_map,
    scalar_of,
)

if TYPE_CHECKING:
    from ....choices import Wrap

_UNDRAWN_NUMBERS = ("aniso", "anisor")
# Warnings about undrawn maps, by keyword in lower case.
_UNDRAWN_MAPS = {
    "disp": "displacement",
    "map_disp": "displacement",
    "decal": "decal",
    "map_decal": "decal",
    "refl": "reflection",
    "map_refl": "reflection",
    "map_ke": "emission map",
    "map_ks": "specular map",
    "map_ns": "specular map",
    "map_ao": "occlusion",
    "map_aniso": "anisotropy",
    "map_anisor": "anisotropy",
}
# Our own keys of ``extras``, which are not statements.
_WHITE = (1.0, 1.0, 1.0)
_RESERVED = {"maps", "opacity"}


def read_mtl(source: Source, textures: TextureCache, warnings: WarningList) -> dict[str, Material]:
    """Read a material library.

    Parameters
    ----------
    source : Source
        The library; images are searched beside it first.
    textures : TextureCache
    warnings : WarningList

    Returns
    -------
    materials : dict of str to Material
        The first definition of a name wins. ``extras["maps"]`` holds each map's ``name`` and
        options by its keyword.

    Raises
    ------
    FileFormatError
        The library is not text.
    """
    library = _Library(source, textures, warnings)
    for number, line in enumerate(text_lines(source).split(b"\n"), 1):
        keyword, _, rest = line.strip().partition(b" ")
        if b"\t" in keyword:
            keyword, _, rest = line.strip().partition(b"\t")
        if keyword and not keyword.startswith(b"#"):
            library.read(keyword_of(decoded(keyword)), _without_comment(rest), number)
    return library.finished()


def _without_comment(rest: bytes) -> bytes:
    for mark in (b" #", b"\t#"):
        rest = rest.partition(mark)[0]
    return b"" if rest.startswith(b"#") else rest.strip()


class _Gathered(NamedTuple):
    """The data read for a material: its maps, and its other statements, by keyword."""

    name: str
    line: int
    maps: dict[str, MapEntry]
    values: dict[str, Any]


class _Library:
    """Reads the statements of a library, and builds materials."""

    def __init__(self, source: Source, textures: TextureCache, warnings: WarningList) -> None:
        self._source, self._textures, self._warnings = source, textures, warnings
        self._materials: dict[str, Material] = {}
        self._current: _Gathered | None = None
        self._unknown: set[str] = set()
        self._clear: list[int] = []  # lines of materials that would be invisible

    def read(self, keyword: str, rest: bytes, line: int) -> None:
        """Process a statement."""
        if keyword == "newmtl":
            self._finish()
            self._current = _Gathered(decoded(rest), line, {}, {})
        elif self._current is None:
            self._warn(f"{shown(keyword)} before any newmtl", line)
        elif keyword in COLORS or keyword in SCALARS:
            value = color_of(rest) if keyword in COLORS else scalar_of(rest)
            if value is None:
                self._warn(f"{keyword} {shown(rest)} is left out", line)
            else:
                self._current.values[keyword] = value
        elif is_map(keyword):
            self._read_map(self._current.maps, keyword, rest, line)
        elif keyword in _RESERVED:
            self._warn(f"{keyword} is left out", line)
        else:
            self._current.values.setdefault(keyword, decoded(rest))
            self._warn_of_unknown(keyword, line)

    def finished(self) -> dict[str, Material]:
        """Return the materials."""
        self._finish()
        if self._clear:
            count = len(self._clear)
            what = "1 material" if count == 1 else f"{count} materials"
            self._warn(f"Tr 1 of {what}, which would not show, counts as opaque", self._clear[0])
        return self._materials

    def _read_map(self, maps: dict[str, MapEntry], keyword: str, rest: bytes, line: int) -> None:
        entry = parse_map(decoded(rest))
        if entry["name"]:
            entry["line"] = line
            maps[keyword] = entry
            self._warn_of_unknown(keyword, line)
        else:
            self._warn(f"{keyword} without a file name", line)

    def _warn_of_unknown(self, keyword: str, line: int) -> None:
        if looks_like_a_look(keyword) and keyword not in self._unknown:
            self._unknown.add(keyword)
            self._warn(f"{shown(keyword)} is not understood, and not drawn", line)

    def _warn(self, message: str, line: int) -> None:
        self._warnings.add(message, line, self._source.path)

    def _finish(self) -> None:
        """Turn the gathered data of one material into a `Material`."""
        current = self._current
        if current is None or current.name in self._materials:
            return
        if current.values.get("Tr", 0.0) >= 1 and "d" not in current.values:
            self._clear.append(current.line)
        self._materials[current.name] = _material(current, self._load)

    def _load(self, entry: MapEntry | None, is_data: bool = False) -> Texture | None:
        return _texture(entry, self._textures, self._warnings, self._source, is_data)


def _material(
    gathered: _Gathered, load: Callable[[MapEntry | None, bool], Texture | None]
) -> Material:
    name, _, maps, values = gathered
    texture = load(maps.get("map_Kd"), False)
    color = _shown(values.get("Kd", _WHITE))
    if texture is not None and not any(color):
        # Exporters that know only the image write Kd 0 0 0 beside it.
        color = _WHITE
    extras = {key: value for key, value in values.items() if key not in ("Kd", "Ks", "Ke", "Ns")}
    if "d" in values or "Tr" in values:
        extras["opacity"] = _opacity(values)
    if maps:
        extras["maps"] = {
            key: {k: v for k, v in entry.items() if k != "line"} for key, entry in maps.items()
        }
    material = Material(name=name)
    given = {
        "color": color if color != _WHITE or "Kd" in values else None,
        "texture": texture,
        "specular": _shown(_specular(values)) if "Ks" in values else None,
        "shininess": max(values["Ns"], 0.0) if "Ns" in values else None,
        # With an emission map, the constant would add to it.
        "emissive": None if "map_Ke" in maps else _shown(values["Ke"]) if "Ke" in values else None,
        "extras": extras or None,
        **physical_fields(values, maps, load, _scale_and_offset),
    }
    for field, value in given.items():
        if value is not None:
            setattr(material, field, value)
    _finish_alpha(material, maps, load)
    return material


def _shown(color: tuple[float, float, float]) -> Any:
    """Return display values, or linear light if a number is above 1: such numbers stay."""
    if max(color) <= 1:
        return color
    light = linear_from_display(np.array(color)).tolist()
    return LinearColor(map(max, light, (part if part > 1 else 0.0 for part in color)))


def _opacity(values: dict[str, Any]) -> float:
    """Return d, or 1 - Tr; Tr 1 alone comes from programs that mean opaque."""
    transparency = values.get("Tr", 0.0)
    opacity = values.get("d", 1.0 if transparency >= 1 else 1.0 - transparency)
    return min(max(opacity, 0.0), 1.0)


def _finish_alpha(
    material: Material,
    maps: dict[str, MapEntry],
    load: Callable[[MapEntry | None, bool], Texture | None],
) -> None:
    entries = {key.lower(): entry for key, entry in maps.items()}
    keyword = next((key for key in OPACITY_MAPS if key in entries), "")
    opacity_map = load(entries.get(keyword), True)
    if opacity_map is not None or material.texture is not None or "opacity" in material.extras:
        opacity = material.extras.get("opacity", 1.0)
        set_alpha(material, opacity, opacity_map, OPACITY_MAPS.get(keyword, False))


def _specular(values: dict[str, Any]) -> tuple[float, float, float]:
    """Return Ks, unless the model has no highlight or the exponent would light everything."""
    has_highlight = values.get("illum", 2.0) >= 2 and values.get("Ns", 32.0) > 0
    return values.get("Ks", (0.0, 0.0, 0.0)) if has_highlight else (0.0, 0.0, 0.0)


def _texture(
    entry: MapEntry | None,
    textures: TextureCache,
    warnings: WarningList,
    source: Source,
    is_data: bool,
) -> Texture | None:
    if entry is None:
        return None
    name, line = entry["name"], entry["line"]
    wrap: Wrap = "clamp" if entry.get("clamp", ["off"])[:1] == ["on"] else "repeat"
    try:
        texture, note = textures.get(name, source.folder, wrap, is_data)
        if note:
            warnings.add(f"texture {shown(name)}: {note}", line, source.path)
        return texture
    except (LinkedFileError, Engine3DError) as error:
        warnings.add(f"texture {shown(name)}: {error}", line, source.path)
    return None


def undrawn_kinds(material: Material) -> set[str]:
    """Return the undrawn features of a material, as keys of `undrawn.KINDS`."""
    extras = material.extras
    maps = extras.get("maps", {})
    drawn = PHYSICAL_MAPS if material.is_physical else ()
    undrawn = (key.lower() for key in maps if key not in drawn)
    kinds = {_UNDRAWN_MAPS[key] for key in undrawn if key in _UNDRAWN_MAPS}
    # Most exporters repeat the colour image here.
    if maps.get("map_Ka", {}).get("name") not in (None, maps.get("map_Kd", {}).get("name")):
        kinds.add("ambient map")
    if any(extras.get(key) for key in _UNDRAWN_NUMBERS):
        kinds.add("anisotropy")
    return kinds


def uv_transform(material: Material) -> tuple[float, float, float, float]:
    """Return scale u, scale v, offset u, offset v of a material's ``map_Kd``."""
    return _scale_and_offset(material.extras.get("maps", {}).get("map_Kd", {}))


def _scale_and_offset(entry: MapEntry) -> tuple[float, float, float, float]:
    scale = _pair(entry.get("s", []), 1.0)
    offset = _pair(entry.get("o", []), 0.0)
    transform = (*scale, *offset)
    return transform if all(map(math.isfinite, transform)) else (1.0, 1.0, 0.0, 0.0)


def _pair(words: list[str], default: float) -> tuple[float, float]:
    first, second, *_ = (*(float(word) for word in words[:2]), default, default)
    return first, second
