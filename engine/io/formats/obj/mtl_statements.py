"""The statements of MTL: case-insensitive keywords, numbers, and maps with their options.

In: the words of a line. Out: values and maps by the format's own keywords. mtl.py and the modules
beside it define the meaning of statements.
"""

from __future__ import annotations

import math
import re
from typing import Any, TypeAlias

from ...reading.text import words_of

COLORS = {"Ka", "Kd", "Ks", "Ke", "Tf"}
SCALARS = {"Ns", "Ni", "d", "Tr", "illum", "sharpness", "Pr", "Pm", "Ps", "Pc", "Pcr"}
SCALARS |= {"aniso", "anisor", "Pcor"}
_MAPS = {"bump", "disp", "decal", "refl", "norm"}
#: Known maps; others begin with ``map_``.
_KNOWN_MAPS = {"map_Ka", "map_Kd", "map_Ks", "map_Ke", "map_Ns", "map_d", "map_Tr", "map_opacity"}
_KNOWN_MAPS |= {"map_Bump", "map_bump", "map_disp", "map_decal", "map_refl", "map_norm", "map_Kn"}
_KNOWN_MAPS |= {"map_Pr", "map_Pm", "map_Ps", "map_Pc", "map_Pcr", "map_ORM", "map_RMA", "map_AO"}
_KNOWN_MAPS |= {"map_aniso", "map_anisor", "map_aat"}
_KNOWN = sorted({"newmtl", *COLORS, *SCALARS, *_MAPS, *_KNOWN_MAPS}, reverse=True)
_SPELLINGS = {keyword.lower(): keyword for keyword in _KNOWN} | {word: word for word in _KNOWN}
# Other statements about appearance.
_LOOKS = re.compile(
    r"k[a-z]\w?|.*(?:colou?r|diffuse|specular|shin|gloss|albedo|ambient|emi|opacity|alpha|transp|tex|"
    r"map|image|metal|rough|normal|bump).*",
    re.IGNORECASE,
)
# The number of arguments of each map option; trailing ones of -s, -o and -t are optional.
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
_NUMBERED = ("-s", "-o", "-t", "-mm")

#: A map, as returned by `parse_map`.
MapEntry: TypeAlias = dict[str, Any]


def keyword_of(word: str) -> str:
    """Return the format's spelling of a keyword, or the word itself if unknown."""
    return _SPELLINGS.get(word) or _SPELLINGS.get(word.lower(), word)


def is_map(keyword: str) -> bool:
    """Return whether a keyword names an image."""
    return keyword in _MAPS or keyword[:4].lower() == "map_"


def looks_like_a_look(keyword: str) -> bool:
    """Return whether an unknown keyword seems to be about colour, opacity or a map."""
    return keyword not in _SPELLINGS and _LOOKS.fullmatch(keyword) is not None


def color_of(rest: bytes) -> tuple[float, float, float] | None:
    """Return three numbers, or one for all channels; None for ``spectral`` and ``xyz``."""
    numbers = _numbers(rest.split()[:3])
    if numbers is None or len(numbers) not in (1, 3):
        return None
    red, green, blue = numbers * 3 if len(numbers) == 1 else numbers
    return max(0.0, red), max(0.0, green), max(0.0, blue)


def scalar_of(rest: bytes) -> float | None:
    """Return the first number, or None."""
    words = [word for word in rest.split() if word != b"-halo"]
    numbers = _numbers(words[:1])
    return numbers[0] if numbers else None


def _numbers(words: list[bytes]) -> list[float] | None:
    """Return finite floats that float32 can hold, or None."""
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return None
    return numbers if all(math.isfinite(n) and abs(n) < 3e38 for n in numbers) else None


def parse_map(text: str) -> MapEntry:
    """Parse the arguments of a map statement.

    Returns
    -------
    entry : dict
        ``name`` (the file name, which may contain blanks; "" if missing), and each option without
        its dash, in lower case, with a list of words. Options may precede or follow the name.
    """
    words = words_of(text)
    entry: MapEntry = {"name": ""}
    position = _take_options(words, 0, entry)
    if position == len(words):
        return entry
    last = len(words)
    for start in range(position + 1, len(words)):
        behind: MapEntry = {}
        if words[start].lower() in _OPTIONS and _take_options(words, start, behind) == len(words):
            entry |= {key: values for key, values in behind.items() if values}
            last = start
            break
    # Verbatim, since blanks in a name count.
    entry["name"] = _between(text, position, last)
    return entry


def _take_options(words: list[str], position: int, entry: MapEntry) -> int:
    """Read options into an entry; return the position after them."""
    while position < len(words) and words[position].lower() in _OPTIONS:
        option = words[position].lower()
        position += 1
        values: list[str] = []
        while len(values) < _OPTIONS[option] and position < len(words):
            if option in _NUMBERED and not _is_number(words[position]):
                break
            values.append(words[position])
            position += 1
        entry[option[1:]] = values
    return position


def _between(text: str, first: int, last: int) -> str:
    """Return the text of the words first..last-1, with everything between them."""
    found = list(re.finditer(r"[^ \t\r\n\v\f]+", text))
    return text[found[first].start() : found[last - 1].end()]


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
