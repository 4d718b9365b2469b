"""Property groups of 3MF files: base materials, colours, texture coordinates, and mixtures.

In: elements of the XML. Out: `PropertyGroup` records, by ID. Colours are sRGB with alpha, 0 to 255.
Properties affect only appearance: an invalid entry gives a warning and a placeholder, white or at
the origin, so that the indices of others stay valid.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ....model.materials.colors import linear_color, srgb_bytes
from ...reading.text import shown
from ...reading.warning_list import WarningList
from ...reading.xml_events import SEPARATOR, Attributes, XmlFault

if TYPE_CHECKING:
    from ....choices import Filter, Wrap

_MATERIALS = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02"
Color = tuple[int, int, int, int]
WHITE: Color = (255, 255, 255, 255)
_TILES: dict[str, Wrap] = {"wrap": "repeat", "mirror": "mirror", "clamp": "clamp", "none": "clamp"}


@dataclass
class TextureRecord:
    """An image of the package, and how to sample it."""

    path: str
    wrap: tuple[Wrap, Wrap]
    filter: Filter


@dataclass
class PropertyGroup:
    """Properties that triangles name by index.

    Attributes
    ----------
    kind : {"base", "color", "texture", "multi", "image", "display"}
        Images and display properties are not used by triangles directly; texture groups and base
        materials refer to them.
    names : list of str
        Names of base materials.
    entries : list
        Colours, (u, v), or the indices in each layer of ``layers``.
    texture : int
        For texture groups, the ID of the image.
    layers : tuple of int
        For multi-properties, the IDs of the groups.
    image : TextureRecord or None
    display : int
        For base materials, the ID of their display properties; -1 for none.
    """

    kind: str
    names: list[str] = field(default_factory=list)
    entries: list[Any] = field(default_factory=list)
    texture: int = -1
    layers: tuple[int, ...] = ()
    image: TextureRecord | None = None
    display: int = -1


class PropertyParser:
    """Handles the elements that define properties.

    Parameters
    ----------
    groups : dict of int to PropertyGroup
        The groups; the parser fills them.
    warnings : WarningList
    """

    def __init__(self, groups: dict[int, PropertyGroup], warnings: WarningList) -> None:
        self._groups, self._warnings = groups, warnings
        self._group = PropertyGroup("")
        self._bases: tuple[list[Color], tuple[int, ...]] = [], ()

    def handlers(self, core: str) -> dict[str, Callable[[Attributes], object]]:
        """Return the handler of each element."""
        of_core: dict[str, Callable[[Attributes], object]]
        of_core = {"basematerials": self._base_materials, "base": self._base}
        of_materials = {
            "colorgroup": lambda attributes: self._open("color", attributes),
            "color": self._color,
            "texture2d": self._image,
            "texture2dgroup": self._texture_group,
            "tex2coord": self._coordinates,
            "compositematerials": self._composites,
            "composite": self._composite,
            "multiproperties": self._multi_properties,
            "multi": self._multi,
            "pbmetallicdisplayproperties": lambda attributes: self._open("display", attributes),
            "pbmetallic": self._metallic,
        }
        found = {f"{core}{SEPARATOR}{name}": handler for name, handler in of_core.items()}
        for name, handler in of_materials.items():
            found[f"{_MATERIALS}{SEPARATOR}{name}"] = handler
        return found

    def _sensible(self, read: Callable[..., Any], *words: Any, default: Any) -> Any:
        """Return converted words; the default, with a warning, if the conversion fails."""
        try:
            return read(*words)
        except XmlFault as fault:
            self._warnings.add_once(f"{fault}; left out")
            return default

    def _number_of(self, attributes: Attributes, key: str) -> int:
        """Return the ID in an attribute; an ID of nothing if invalid."""
        return self._sensible(_index, attributes.get(key, ""), key, default=-1)

    def _open(self, kind: str, attributes: Attributes) -> PropertyGroup:
        number = self._number_of(attributes, "id")
        self._group = PropertyGroup(kind)
        if number in self._groups:
            self._warnings.add_once(f"id {number} is given twice; the first counts")
        elif number >= 0:
            self._groups[number] = self._group
        return self._group

    def _add(self, kind: str, entry: Any, name: str = "") -> None:
        if self._group.kind != kind:
            self._warnings.add_once(f"a property outside of its group: {kind}; left out")
            return
        self._group.entries.append(entry)
        self._group.names.append(name)

    def _base_materials(self, attributes: Attributes) -> None:
        group = self._open("base", attributes)
        if "displaypropertiesid" in attributes:
            group.display = self._number_of(attributes, "displaypropertiesid")

    def _base(self, attributes: Attributes) -> None:
        name, color = attributes.get("name", ""), self._color_of(attributes, "displaycolor")
        if color[3] == 0:  # some programs write opaque colours this way
            self._warnings.add(f"material {shown(name)}, which would not show, is drawn opaque")
            color = (*color[:3], 255)
        self._add("base", color, name)

    def _color(self, attributes: Attributes) -> None:
        self._add("color", self._color_of(attributes, "color"))

    def _color_of(self, attributes: Attributes, key: str) -> Color:
        return self._sensible(_color, attributes.get(key, ""), default=WHITE)

    def _image(self, attributes: Attributes) -> None:
        group = self._open("image", attributes)
        tiles = [attributes.get(f"tilestyle{side}", "wrap") for side in "uv"]
        if "none" in tiles:
            self._warnings.add_once("a texture of tile style none goes on as its edge")
        across, up = (_TILES.get(tile, "repeat") for tile in tiles)
        reading: Filter = "nearest" if attributes.get("filter") == "nearest" else "trilinear"
        group.image = TextureRecord(attributes.get("path", ""), (across, up), reading)

    def _texture_group(self, attributes: Attributes) -> None:
        group = self._open("texture", attributes)
        group.texture = self._number_of(attributes, "texid")

    def _coordinates(self, attributes: Attributes) -> None:
        place = (self._sensible(_number, attributes, key, default=0.0) for key in "uv")
        self._add("texture", tuple(place))

    def _composites(self, attributes: Attributes) -> None:
        bases = self._groups.get(self._number_of(attributes, "matid"))
        colors = bases.entries if bases is not None and bases.kind == "base" else []
        text = attributes.get("matindices", "")
        indices = self._sensible(_indices, text, "matindices", default=())
        if not indices or max(indices) >= len(colors):
            self._warnings.add_once("composite materials of what is not there; left out")
            colors, indices = [], ()
        self._bases = colors, indices
        self._open("base", attributes)

    def _composite(self, attributes: Attributes) -> None:
        mixed = self._sensible(self._mixed, attributes.get("values", ""), default=WHITE)
        self._add("base", mixed)

    def _mixed(self, values: str) -> Color:
        """Return the colour of a composite: its parts weighted in linear light."""
        entries, indices = self._bases
        shares = [_float(word, "values") for word in values.split()]
        shares = [max(share, 0.0) for share in shares[: len(indices)]]
        total = sum(shares)
        if not total > 0.0:
            raise XmlFault("a composite of nothing")
        colors = [entries[index] for index in indices]
        parts = [(*linear_color(color[:3]).tolist(), color[3] / 255) for color in colors]
        mixed = [
            sum(share * part[k] for share, part in zip(shares, parts, strict=False)) / total
            for k in range(4)
        ]
        red, green, blue, alpha = srgb_bytes(np.array([mixed]))[0].tolist()
        return red, green, blue, alpha

    def _multi_properties(self, attributes: Attributes) -> None:
        group = self._open("multi", attributes)
        group.layers = self._indices_of(attributes, "pids")

    def _multi(self, attributes: Attributes) -> None:
        self._add("multi", self._indices_of(attributes, "pindices"))

    def _indices_of(self, attributes: Attributes, key: str) -> tuple[int, ...]:
        return self._sensible(_indices, attributes.get(key, ""), key, default=())

    def _metallic(self, attributes: Attributes) -> None:
        usual = (("metallicness", 0.0), ("roughness", 1.0))
        values = (self._sensible(_number, attributes, *one, default=one[1]) for one in usual)
        self._add("display", tuple(min(max(value, 0.0), 1.0) for value in values))


def _index(text: str, key: str) -> int:
    if text.isdigit() and text.isascii() and len(text) < 10:
        return int(text)
    raise XmlFault(f"{key!r} is no index: {shown(text)}")


def _indices(text: str, key: str) -> tuple[int, ...]:
    return tuple(_index(word, key) for word in text.split())


def _float(text: str, key: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise XmlFault(f"{key!r} is no number: {shown(text)}")
    return value


def _number(attributes: Attributes, key: str, default: float | None = None) -> float:
    if key not in attributes and default is not None:
        return default
    return _float(attributes.get(key, ""), key)


def _color(text: str) -> Color:
    """Return a colour from ``#RRGGBB`` or ``#RRGGBBAA``."""
    digits = text[1:]
    try:
        if text[:1] != "#" or len(digits) not in (6, 8) or not digits.isalnum():
            raise ValueError
        red, green, blue, *alpha = bytes.fromhex(digits)
    except ValueError:
        raise XmlFault(f"no colour like #rrggbb: {shown(text)}") from None
    return red, green, blue, alpha[0] if alpha else 255
