"""Physically based materials and normal maps of material libraries.

In: the numbers of a material and its maps, and a function that loads their images. Out: fields of
`Material`. The statements are those of the common extension of MTL (Pr, Pm, Ps, Pc, Pcr, norm and
their maps). Bump maps become normal maps: white is 1/64 of the image's width above black.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from ....model.materials.linear_colors import linear
from ....model.materials.material import PARAMETERS, TEXTURE_SLOTS
from ....model.materials.parameters import TextureSlot
from ....model.materials.textures import PlacedTexture, Texture
from .mtl_statements import MapEntry

_NUMBERS = ("Pr", "Pm", "Ps", "Pc", "Pcr")
_ROUGHNESS, _METALLIC = ("map_Pr",), ("map_Pm",)
_ALL_IN_ONE = ("map_ORM", "map_RMA")
_NORMALS = ("norm", "map_norm", "map_Kn")
_BUMPS = ("map_Bump", "map_bump", "bump")
#: Slots that a single image fills, by the statements that name it.
_SLOTS = {
    "map_Ps": "sheen_color_texture",
    "map_Pc": "clearcoat_texture",
    "map_Pcr": "clearcoat_roughness_texture",
    "map_Ke": "emissive_texture",
    "map_AO": "occlusion_texture",
}
#: All maps drawn for physically based materials.
PHYSICAL_MAPS = (*_ROUGHNESS, *_METALLIC, *_ALL_IN_ONE, *_SLOTS)
_DEPTH = 1 / 64
# Returns the image of a map, None if left out; the flag says that it holds numbers, not colours.
_Load: TypeAlias = Callable[[MapEntry, bool], Texture | None]
# Scale and offset, u and v each.
_Place: TypeAlias = tuple[float, float, float, float]
_MOST_NEUTRAL = 32  # largest mean deviation of a normal map's red and green from the middle


def is_physical(values: dict[str, Any], maps: dict[str, MapEntry]) -> bool:
    """Return whether a material has any physically based statement."""
    named = (*_ROUGHNESS, *_METALLIC, *_ALL_IN_ONE, "map_Ps", "map_Pc", "map_Pcr")
    return any(key in values for key in _NUMBERS) or any(key in maps for key in named)


def physical_fields(
    values: dict[str, Any],
    maps: dict[str, MapEntry],
    load: _Load,
    place: Callable[[MapEntry], _Place],
) -> dict[str, Any]:
    """Return a material's physical properties, as fields of `Material`.

    Parameters
    ----------
    values : dict of str to object
        Numbers and colours by keyword.
    maps : dict of str to dict
        As `mtl_statements.parse_map` returns them.
    load : callable
        ``load(map, is_data)`` returns the image of a map, or None if it is left out; with
        ``is_data`` it holds numbers, not colours.
    place : callable
        Returns scale and offset of a map (u, then v of each).
    """
    fields = _normal_fields(maps, load)
    if is_physical(values, maps):
        fields |= _number_fields(values) | _map_fields(values, maps, load)
    base = place(maps.get("map_Kd", {}))
    for slot in TEXTURE_SLOTS:
        if slot in fields:
            texture, entry = fields[slot]
            fields[slot] = _placed(texture, place(entry), base)
    return fields


def _number_fields(values: dict[str, Any]) -> dict[str, Any]:
    fields: dict[str, Any] = {
        "roughness": _fraction(values.get("Pr", 1.0)),
        "metallic": _fraction(values.get("Pm", 0.0)),
        "clearcoat": _fraction(values.get("Pc", 0.0)),
        "clearcoat_roughness": _fraction(values.get("Pcr", 0.0)),
    }
    if (sheen := _fraction(values.get("Ps", 0.0))) > 0:
        fields |= {"sheen_color": linear(sheen, sheen, sheen), "sheen_roughness": 0.5}
    if (ior := values.get("Ni", 0.0)) >= 1:
        fields["ior"] = ior
    return fields


def _map_fields(values: dict[str, Any], maps: dict[str, MapEntry], load: _Load) -> dict[str, Any]:
    """Return the maps of a physical material; the numbers beside them are factors."""
    fields: dict[str, Any] = {}
    for key, slot in _SLOTS.items():
        row = PARAMETERS[slot]
        is_color = isinstance(row, TextureSlot) and row.is_color
        if (texture := _loaded(maps, (key,), load, not is_color)) is not None:
            fields[slot] = texture
    if "emissive_texture" in fields and not any(values.get("Ke", (0.0,))):
        fields["emissive"] = (1.0, 1.0, 1.0)
    if "sheen_color_texture" in fields and not _fraction(values.get("Ps", 0.0)):
        fields |= {"sheen_color": (1.0, 1.0, 1.0), "sheen_roughness": 0.5}
    if "clearcoat_texture" in fields and "Pc" not in values:
        fields["clearcoat"] = 1.0
    if "clearcoat_roughness_texture" in fields and "Pcr" not in values:
        fields["clearcoat_roughness"] = 1.0
    rough, metal = _loaded(maps, _ROUGHNESS, load), _loaded(maps, _METALLIC, load)
    if (both := _all_in_one(maps, load)) is not None:
        fields |= both
    elif (held := rough or metal) is not None:
        pixels = _joined(rough and rough[0], metal and metal[0])
        made = Texture(pixels, color_space="linear", name="roughness and metal")
        fields["metallic_roughness_texture"] = made, held[1]
    if "metallic_roughness_texture" in fields:
        fields["roughness"] = _fraction(values.get("Pr", 1.0))
        has_metal = metal is not None or both is not None
        fields["metallic"] = _fraction(values.get("Pm", 1.0 if has_metal else 0.0))
    return fields


def _all_in_one(maps: dict[str, MapEntry], load: _Load) -> dict[str, Any] | None:
    """Return occlusion, roughness and metallic from the channels of one image."""
    held = _loaded(maps, ("map_ORM",), load)
    if held is None and (other := _loaded(maps, ("map_RMA",), load)) is not None:
        held = Texture(other[0].pixels[..., [2, 0, 1, 3]], wrap=other[0].wrap), other[1]
    if held is None:
        return None
    return {"metallic_roughness_texture": held, "occlusion_texture": held}


def _joined(rough: Texture | None, metal: Texture | None) -> np.ndarray:
    """Return roughness as green and metallic as blue, at the size of the larger image."""
    images = [texture.pixels for texture in (rough, metal) if texture is not None]
    height, width = max(image.shape[0] for image in images), max(image.shape[1] for image in images)
    pixels = np.full((height, width, 3), 255, np.uint8)
    for channel, texture in ((1, rough), (2, metal)):
        if texture is not None:
            image = texture.pixels
            rows = np.arange(height) * image.shape[0] // height
            columns = np.arange(width) * image.shape[1] // width
            pixels[..., channel] = image[rows[:, np.newaxis], columns, 0]
    return pixels


def _normal_fields(maps: dict[str, MapEntry], load: _Load) -> dict[str, Any]:
    """Return the normal map of any material, converted from heights if necessary."""
    held = _loaded(maps, _NORMALS, load)
    if held is not None:
        return {"normal_texture": held, "normal_scale": _strength(held[1])}
    held = _loaded(maps, _BUMPS, load)
    if held is None:
        return {}
    texture, entry = held
    if _holds_normals(texture.pixels):
        return {"normal_texture": held, "normal_scale": _strength(entry)}
    normals = normals_of_heights(texture.pixels[..., 0], texture.wrap == "repeat")
    name = f"{texture.name} as normals"
    made = Texture(normals, wrap=texture.wrap, color_space="linear", name=name)
    return {"normal_texture": (made, entry), "normal_scale": _strength(entry)}


def normals_of_heights(heights: np.ndarray, repeats: bool) -> np.ndarray:
    """Convert a height map to a normal map.

    Parameters
    ----------
    heights : (H, W) uint8
        255 is 1/64 of the image's width above 0.
    repeats : bool
        Whether the image tiles.

    Returns
    -------
    normals : (H, W, 3) uint8
    """
    height, width = heights.shape
    values = np.pad(heights.astype(np.float64) / 255, 1, "wrap" if repeats else "edge")
    across = (values[1:-1, 2:] - values[1:-1, :-2]) * (0.5 * _DEPTH * width)
    up = (values[:-2, 1:-1] - values[2:, 1:-1]) * (0.5 * _DEPTH * width)
    normals = np.stack([-across, -up, np.ones((height, width))], axis=-1)
    normals /= np.sqrt((normals**2).sum(axis=-1, keepdims=True))
    return np.floor(normals * 127.5 + 128).astype(np.uint8)


def _holds_normals(pixels: np.ndarray) -> bool:
    """Return whether an image is a normal map: bluish, with neutral red and green on average."""
    red, green, blue, _ = pixels.reshape(-1, 4).mean(axis=0).tolist()
    neutral = abs(red - 127.5) < _MOST_NEUTRAL and abs(green - 127.5) < _MOST_NEUTRAL
    return neutral and blue > max(red, green) + _MOST_NEUTRAL


def _loaded(
    maps: dict[str, MapEntry], keys: tuple[str, ...], load: _Load, is_data: bool = True
) -> tuple[Texture, MapEntry] | None:
    """Return the first of some maps that a material has: its image, and its options."""
    for key in keys:
        if key in maps and (texture := load(maps[key], is_data)) is not None:
            return texture, maps[key]
    return None


def _strength(entry: MapEntry) -> float:
    try:
        return float(entry["bm"][0])
    except (KeyError, IndexError, ValueError):
        return 1.0


def _fraction(value: float) -> float:
    return min(max(value, 0.0), 1.0)


def _placed(texture: Texture, own: _Place, base: _Place) -> Texture | PlacedTexture:
    """Return a texture with its own scale and offset, relative to the base colour's."""
    if own == base or not (base[0] and base[1]):
        return texture
    scale = own[0] / base[0], own[1] / base[1]
    offset = own[2] - scale[0] * base[2], own[3] - scale[1] * base[3]
    return PlacedTexture(texture, scale=scale, offset=(offset[0], 1 - scale[1] - offset[1]))
