"""Materials as the core takes them: constants precomputed in float64, textures by slot.

In: a `Material` with its textures. Out: one material of a `NativeDrawList`.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from typing import Any

from ..._native.rasterizer import ALPHA_MODES, PHYSICAL_NUMBERS, NativeDrawList, NativeTexture
from ...base import linalg
from ...base.side_by_side import side_by_side
from ...choices import ColorSpace
from ...model.materials.display_colors import shading_color
from ...model.materials.material import PARAMETERS, Material, placed_textures_of
from ...model.materials.parameters import TextureSlot
from ...model.materials.textures import PlacedTexture
from .native_handles import is_new, native_texture

_SMALLEST_SHININESS = 1e-3  # the core requires an exponent above 0; this one looks like 0
_LEAST_LEFT = 2.0**-126  # of transmitted light: its logarithm is finite
_LARGE = 512 * 512  # pixels: above this, making the mip levels takes longer than starting a thread
# The numbers and colours that the core takes unchanged under the same name.
_SAME = [name for name in PHYSICAL_NUMBERS if name in PARAMETERS]
_SAME_NUMBERS = [name for name in _SAME if PARAMETERS[name].kind.width == 1]
_SAME_COLORS = [name for name in _SAME if PARAMETERS[name].kind.width == 3]


def set_material(
    native: NativeDrawList,
    index: int,
    id: int,
    material: Material,
    textures: dict[str, PlacedTexture],
    color_space: ColorSpace,
    two_sided: bool,
) -> None:
    """Set a material of a native draw list, or append one.

    Parameters
    ----------
    native : NativeDrawList
    index : int
        Its number in the list.
    id : int
        Its value in the output ``material_id``.
    material : Material
    textures : dict of str to PlacedTexture
        The material's textures, by slot.
    color_space : {"srgb", "linear"}
        How 8-bit colours are decoded.
    two_sided : bool
        Whether both sides of its faces show, whatever the option ``cull``.
    """
    strength = material.emissive_strength if material.is_physical else 1.0
    emissive = shading_color(material.emissive, color_space)
    numbers = {
        "color": shading_color(material.rgb, color_space),
        "specular": shading_color(material.specular, color_space),
        "shininess": max(material.shininess, _SMALLEST_SHININESS),
        "emissive": tuple(component * strength for component in emissive),
        "id": id,
        "two_sided": two_sided,
        "flat": material.flat_shading,
        "is_unlit": material.unlit,
        "normal_scale": material.normal_scale,
        "alpha": material.alpha,
        "alpha_mode": ALPHA_MODES[material.alpha_mode],
        "alpha_cutoff": material.alpha_cutoff,
    }
    physical = _physical(material, color_space) if material.is_physical else None
    uses = {slot: _use(slot, placed, color_space) for slot, placed in textures.items()}
    native.set_material(index, numbers, physical, uses)


def make_textures(materials: Iterable[Material], color_space: ColorSpace, threads: int) -> None:
    """Create the first handles of large textures in parallel.

    Parameters
    ----------
    materials : iterable of Material
    color_space : {"srgb", "linear"}
        How 8-bit colours are decoded.
    threads : int
        The most handles to create at once; 0: the number of CPUs.
    """
    wanted = dict.fromkeys(
        (placed.texture, _space(slot, color_space))
        for material in materials
        for slot, placed in placed_textures_of(material).items()
        if is_new(placed.texture) and placed.texture.width * placed.texture.height >= _LARGE
    )
    count = min(len(wanted), threads or os.cpu_count() or 1)
    if count > 1:
        side_by_side(lambda one: native_texture(*one), list(wanted), count)


def _space(slot: str, color_space: ColorSpace) -> ColorSpace:
    row = PARAMETERS[slot]
    return color_space if isinstance(row, TextureSlot) and row.is_color else "linear"


def _use(
    slot: str, placed: PlacedTexture, color_space: ColorSpace
) -> tuple[NativeTexture, int, list[float] | None]:
    """Return a slot's texture: its handle, UV set and transform."""
    handle = native_texture(placed.texture, _space(slot, color_space))
    return handle, placed.uv_set, placed.matrix.ravel().tolist() if placed.is_moved else None


def _physical(material: Material, color_space: ColorSpace) -> dict[str, Any]:
    """Return the numbers of a physically based material."""
    root = (1.0 - material.ior) / (1.0 + material.ior)
    tint = shading_color(material.specular_color, color_space)
    left = shading_color(material.attenuation_color, color_space)
    depth, turn = material.attenuation_distance, material.anisotropy_rotation
    held = vars(material)
    return {
        **{name: held[name] for name in _SAME_NUMBERS},
        **{name: shading_color(held[name], color_space) for name in _SAME_COLORS},
        "metallic": 1.0 if material.metallic is None else material.metallic,
        "roughness": 1.0 if material.roughness is None else material.roughness,
        "reflectance": tuple(root * root * component for component in tint),
        "absorption": tuple(_absorption(component, depth) for component in left),
        "anisotropy_turn": (linalg.cos(turn), linalg.sin(turn)),
        "iridescence_thickness": (
            material.iridescence_thickness_minimum,
            material.iridescence_thickness_maximum,
        ),
    }


def _absorption(left: float, depth: float) -> float:
    """Return log2 of the light left after one unit, if ``left`` remains after ``depth``."""
    return min(0.0, math.log2(max(left, _LEAST_LEFT)) / depth)
