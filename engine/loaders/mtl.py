"""Wavefront MTL: the material libraries that OBJ files name.

In: the bytes of a library. Out: materials by name. Colours are linear light, as the numbers are
floats. What physically based materials and maps of normals are is in mtl_physical.py. Whatever
else a file says, and all maps with their options, is kept in the material's ``extras`` under the
file's own keys. A line that makes no sense is a warning; a library never fails as a whole unless it
is no text.
"""

from __future__ import annotations

import math

from ..errors import Engine3DError
from ..materials.material import Material
from ..materials.textures import Texture
from .linked_files import LinkedFileError
from .linked_textures import TextureCache
from .mtl_alpha import OPACITY_MAPS, set_alpha
from .mtl_physical import PHYSICAL_MAPS, physical_fields
from .sources import Source
from .text import decoded, shown, text_lines
from .warning_list import WarningList

_COLORS = {"Ka", "Kd", "Ks", "Ke", "Tf"}
_SCALARS = {"Ns", "Ni", "d", "Tr", "illum", "sharpness", "Pr", "Pm", "Ps", "Pc", "Pcr"}
_SCALARS |= {"aniso", "anisor", "Pcor"}
_MAPS = {"bump", "disp", "decal", "refl", "norm"}
_UNDRAWN_NUMBERS = ("aniso", "anisor")
# What is said of maps that are not drawn, by their keywords in lower case.
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
# Keys of ``extras`` that are ours: no statement's.
_RESERVED = {"maps", "opacity"}
# The words that follow each option of a map; the last three of -s, -o and -t may be left out.
_OPTIONS = {
    "-blendu": 1,
    "-blendv": 1,
    "-boost": 1,
    "-bm": 1,
    "-cc": 1,
    "-clamp": 1,
    "-colorspace": 1,
    "-imfchan": 1,
    "-mm": 2,
    "-o": 3,
    "-s": 3,
    "-t": 3,
    "-texres": 1,
    "-type": 1,
}


def read_mtl(source: Source, textures: TextureCache, warnings: WarningList) -> dict[str, Material]:
    """Read a material library.

    Parameters
    ----------
    source : Source
        The library; images are looked for beside it first.
    textures : TextureCache
    warnings : WarningList

    Returns
    -------
    materials : dict of str to Material
        The first definition of a name counts. ``extras["maps"]`` holds each map's ``name`` and
        options by its keyword.

    Raises
    ------
    FileFormatError
        The library is not text.
    """
    materials: dict[str, Material] = {}
    current: dict | None = None
    for number, line in enumerate(text_lines(source).split(b"\n"), 1):
        keyword, _, rest = line.strip().partition(b" ")
        if b"\t" in keyword:
            keyword, _, rest = line.strip().partition(b"\t")
        if not keyword or keyword.startswith(b"#"):
            continue
        rest = _without_comment(rest)
        if keyword == b"newmtl":
            _finish(current, materials, textures, warnings, source)
            current = {"name": decoded(rest), "line": number, "maps": {}, "values": {}}
        elif current is None:
            warnings.add(f"{shown(keyword)} before any newmtl", number, source.path)
        else:
            _read_statement(current, decoded(keyword), rest, number, warnings, source.path)
    _finish(current, materials, textures, warnings, source)
    return materials


def _without_comment(rest: bytes) -> bytes:
    for mark in (b" #", b"\t#"):
        rest = rest.partition(mark)[0]
    return b"" if rest.startswith(b"#") else rest.strip()


def _read_statement(current, keyword, rest, line, warnings, path) -> None:
    if keyword in _COLORS or keyword in _SCALARS:
        value = _color(rest) if keyword in _COLORS else _scalar(rest)
        if value is None:
            warnings.add(f"{keyword} {shown(rest)} is left out", line, path)
        else:
            current["values"][keyword] = value
    elif keyword.startswith("map_") or keyword in _MAPS:
        entry = parse_map(decoded(rest))
        if entry["name"]:
            entry["line"] = line
            current["maps"][keyword] = entry
        else:
            warnings.add(f"{keyword} without a file name", line, path)
    elif keyword in _RESERVED:
        warnings.add(f"{keyword} is left out", line, path)
    else:
        current["values"].setdefault(keyword, decoded(rest))


def _color(rest: bytes) -> tuple[float, float, float] | None:
    """Three numbers, or one for all channels; None for anything else (``spectral``, ``xyz``)."""
    numbers = _numbers(rest.split()[:3])
    if numbers is None or len(numbers) not in (1, 3):
        return None
    numbers = numbers * 3 if len(numbers) == 1 else numbers
    return tuple(max(0.0, number) for number in numbers)


def _scalar(rest: bytes) -> float | None:
    words = [word for word in rest.split() if word != b"-halo"]
    numbers = _numbers(words[:1])
    return numbers[0] if numbers else None


def _numbers(words: list[bytes]) -> list[float] | None:
    """Finite floats that float32 can hold, or None."""
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return None
    return numbers if all(math.isfinite(n) and abs(n) < 3e38 for n in numbers) else None


def parse_map(text: str) -> dict:
    """Take the arguments of a map statement apart.

    Returns
    -------
    entry : dict
        ``name`` (the file's, which may hold blanks; "" if there is none), and each option without
        its dash: a list of words.
    """
    entry: dict = {"name": ""}
    words = text.split()
    position = 0
    while position < len(words) and words[position] in _OPTIONS:
        option = words[position]
        position += 1
        values = []
        while len(values) < _OPTIONS[option] and position < len(words):
            if option in ("-s", "-o", "-t", "-mm") and not _is_number(words[position]):
                break
            values.append(words[position])
            position += 1
        entry[option[1:]] = values
    if position < len(words):
        # The rest as it was written: blanks in a name count.
        entry["name"] = text.split(None, position)[-1].strip()
    return entry


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _finish(current, materials, textures, warnings, source) -> None:
    """Turn what was gathered of one material into a `Material`."""
    if current is None or current["name"] in materials:
        return
    values, maps = current["values"], current["maps"]

    def load(entry):
        return _texture(entry, textures, warnings, source)

    texture = load(maps.get("map_Kd"))
    color = values.get("Kd", (1.0, 1.0, 1.0))
    if texture is not None and not any(color):
        # Exporters that know nothing but the image write Kd 0 0 0 beside it.
        color = (1.0, 1.0, 1.0)
    extras = {key: value for key, value in values.items() if key not in ("Kd", "Ks", "Ke", "Ns")}
    if "d" in values or "Tr" in values:
        opacity = values.get("d", 1.0 - values.get("Tr", 0.0))
        extras["opacity"] = min(max(opacity, 0.0), 1.0)
    if maps:
        extras["maps"] = {
            key: {k: v for k, v in entry.items() if k != "line"} for key, entry in maps.items()
        }
    material = Material._plain(current["name"])
    given = {
        "color": color if color != (1.0, 1.0, 1.0) else None,
        "texture": texture,
        "specular": _specular(values) if "Ks" in values else None,
        "shininess": max(values["Ns"], 0.0) if "Ns" in values else None,
        # Where an image says what gives off light, all of it would be too much.
        "emissive": None if "map_Ke" in maps else values.get("Ke"),
        "extras": extras or None,
        **physical_fields(values, maps, load, _scale_and_offset),
    }
    for name, value in given.items():
        if value is not None:
            setattr(material, name, value)
    _finish_alpha(material, maps, textures, warnings, source)
    materials[current["name"]] = material


def _finish_alpha(material, maps, textures, warnings, source) -> None:
    entries = {key.lower(): entry for key, entry in maps.items()}
    keyword = next((key for key in OPACITY_MAPS if key in entries), None)
    opacity_map = _texture(entries.get(keyword), textures, warnings, source)
    if opacity_map is not None or material.texture is not None or "opacity" in material.extras:
        opacity = material.extras.get("opacity", 1.0)
        set_alpha(material, opacity, opacity_map, OPACITY_MAPS.get(keyword, False))


def _specular(values: dict) -> tuple[float, float, float]:
    """Ks, unless the illumination model has no highlight or the exponent would light all."""
    has_highlight = values.get("illum", 2.0) >= 2 and values.get("Ns", 32.0) > 0
    return values.get("Ks", (0.0, 0.0, 0.0)) if has_highlight else (0.0, 0.0, 0.0)


def _texture(entry: dict | None, textures: TextureCache, warnings, source) -> Texture | None:
    if entry is None:
        return None
    name, line = entry["name"], entry["line"]
    wrap = "clamp" if entry.get("clamp", ["off"])[:1] == ["on"] else "repeat"
    try:
        texture, note = textures.get(name, source.folder, wrap)
        if note:
            warnings.add(f"texture {shown(name)}: {note}", line, source.path)
        return texture
    except (LinkedFileError, Engine3DError) as error:
        warnings.add(f"texture {shown(name)}: {error}", line, source.path)
    return None


def undrawn_kinds(material: Material) -> set[str]:
    """Return what a material says that is not drawn, as keys of `undrawn.KINDS`."""
    extras = material.extras
    maps = extras.get("maps", {})
    drawn = PHYSICAL_MAPS if material.is_physical else ()
    undrawn = (key.lower() for key in maps if key not in drawn)
    kinds = {_UNDRAWN_MAPS[key] for key in undrawn if key in _UNDRAWN_MAPS}
    # Most exporters name the image of the colour here, too.
    if maps.get("map_Ka", {}).get("name") not in (None, maps.get("map_Kd", {}).get("name")):
        kinds.add("ambient map")
    if any(extras.get(key) for key in _UNDRAWN_NUMBERS):
        kinds.add("anisotropy")
    return kinds


def uv_transform(material: Material) -> tuple[float, float, float, float]:
    """Return scale u, scale v, offset u, offset v of a material's ``map_Kd``."""
    return _scale_and_offset(material.extras.get("maps", {}).get("map_Kd", {}))


def _scale_and_offset(entry: dict) -> tuple[float, float, float, float]:
    scale = _pair(entry.get("s", []), 1.0)
    offset = _pair(entry.get("o", []), 0.0)
    transform = (*scale, *offset)
    return transform if all(map(math.isfinite, transform)) else (1.0, 1.0, 0.0, 0.0)


def _pair(words: list[str], default: float) -> tuple[float, float]:
    numbers = [float(word) for word in words[:2]]
    return tuple([*numbers, default, default][:2])
