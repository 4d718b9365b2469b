"""The materials of a draw list, set anew when a material or texture changes.

In: materials of meshes. Out: materials of a `NativeDrawList`, whose constants are computed once in
float64, and a `Watch` that looks at them and at their textures.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from ..._native.rasterizer import ALPHA_MODES, PHYSICAL_NUMBERS, NativeDrawList, NativeTexture
from ...base import linalg
from ...base.dirty_tracking import Watch
from ...base.side_by_side import side_by_side
from ...base.system import usable_processors
from ...choices import ColorSpace
from ...model.materials.display_colors import shading_color
from ...model.materials.material import (
    PARAMETERS,
    Finish,
    Material,
    placed_textures_of,
    said_of_physical_ones,
)
from ...model.materials.parameters import TextureSlot
from ...model.materials.textures import PlacedTexture, Reading, Texture
from .._told import Told
from .native_handles import Content, is_new, native_texture

_SMALLEST_SHININESS = 1e-3  # the core wants an exponent above 0; this one shows as 0 would
_LEAST_LEFT = 2.0**-126  # of light that is absorbed: its logarithm is finite
_MOST_ABSORBED = 2.0**100  # in doublings a unit: finite, so that a depth of 0 absorbs nothing
_LARGE = 512 * 512  # pixels of a texture whose levels take as long as starting a thread, and longer
# Parameters with the same name in the core have the same number, or the same colour, there.
_SAME = [name for name in PHYSICAL_NUMBERS if name in PARAMETERS]
_SAME_NUMBERS = [name for name in _SAME if PARAMETERS[name].kind.width == 1]
_SAME_COLORS = [name for name in _SAME if PARAMETERS[name].kind.width == 3]


class _Use(NamedTuple):
    """How a mesh uses a material: its number there, and as in `MaterialList.base_of`."""

    number: int
    both: bool
    tinted: bool


class MaterialList:
    """The materials of one native draw list, initially none.

    Parameters
    ----------
    native : NativeDrawList
    color_space : {"srgb", "linear"}
        How 8-bit colours are decoded.
    watch : Watch

    Attributes
    ----------
    untextured : frozenset of Material
        Materials set without their textures.
    mirrors : set of Material
        The listed materials that mirror.
    reading, finish : callable or None
        As in `SceneData`.
    told : Told
        What was warned of.
    """

    def __init__(
        self, native: NativeDrawList, color_space: ColorSpace, watch: Watch, told: Told
    ) -> None:
        self._native, self._color_space, self._watch, self.told = native, color_space, watch, told
        self.untextured: frozenset[Material] = frozenset()
        self.mirrors: set[Material] = set()
        self.reading: Reading | None = None
        self.finish: Finish | None = None
        # For each material its places, and its uses there.
        self._places: dict[Material, list[tuple[int, _Use]]] = {}
        # For each material, the normals it needs and whether it is opaque.
        self._traits: dict[Material, tuple[bool, bool]] = {}
        self._textured: dict[Material, set[Texture]] = {}
        self._users: dict[Texture, set[Material]] = {}
        # The start of each list of materials, by their IDs and how they are used.
        self._bases: dict[tuple[tuple[int, ...], bool, bool], int] = {}

    def base_of(self, materials: list[Material], both: bool, tinted: bool) -> int:
        """Return the number of the first of a mesh's materials; list them if necessary.

        Parameters
        ----------
        materials : list of Material
        both : bool
            Whether both sides show regardless of the materials.
        tinted : bool
            As for the `finish` of `SceneData`.
        """
        key = tuple(map(id, materials)), both, tinted
        if key not in self._bases:
            base = self._native.material_count
            for number, material in enumerate(materials):
                use = _Use(number, both, tinted)
                self._places.setdefault(material, []).append((base + number, use))
                self._set(base + number, material, use)
            self._bases[key] = base
        return self._bases[key]

    def make_textures(self, materials: Iterable[Material], threads: int) -> None:
        """Make the first handles of large textures side by side, before materials ask one by one.

        Parameters
        ----------
        materials : iterable of Material
        threads : int
            How many may be made at once; 0: as many as there are CPUs.
        """
        wanted = dict.fromkeys(
            (placed.texture, _content(slot, self._color_space), self.reading)
            for material in materials
            if material not in self.untextured
            for slot, placed in placed_textures_of(material).items()
            if is_new(placed.texture) and placed.texture.width * placed.texture.height >= _LARGE
        )
        if len(wanted) > 1 and (count := threads or usable_processors()) > 1:
            side_by_side(lambda one: native_texture(*one), list(wanted), count)

    def is_listed_otherwise(self, material: Material) -> bool:
        """Return whether a material changed so much that meshes with it must be listed anew."""
        return self._traits[material] != _traits_of(material)

    def renew(self, changed: Iterable[Any]) -> None:
        """Update the materials that changed or whose textures changed."""
        changed = list(changed)
        materials = {thing for thing in changed if isinstance(thing, Material)}
        for material in materials.union(*(self._users.get(thing, ()) for thing in changed)):
            for index, use in self._places[material]:
                self._set(index, material, use)

    def _set(self, index: int, material: Material, use: _Use) -> None:
        self._watch.add(material)
        self._traits[material] = _traits_of(material)
        (self.mirrors.add if material.mirror > 0 else self.mirrors.discard)(material)
        placed = {} if material in self.untextured else placed_textures_of(material)
        self._note_textures(material, {one.texture for one in placed.values()})
        space = self._color_space
        shown = material if self.finish is None else self.finish(material, use.tinted)
        sides = {"id": use.number, "two_sided": use.both or material.two_sided}
        physical = _physical(shown, space) if shown.is_physical else None
        if physical is None and not shown.unlit:
            self._warn_of_unused(material)
        textures = {slot: self._texture(slot, one) for slot, one in placed.items()}
        self._native.set_material(index, _numbers(shown, space) | sides, physical, textures)

    def _warn_of_unused(self, material: Material) -> None:
        """Warn once of what a material says and shows only if it is physically based."""
        if said := said_of_physical_ones(material):
            self.told.warn(
                material,
                f"{', '.join(said)} of {material!r} is not drawn: it is not physically based; "
                "give metallic, 0 for glass and cloth, or roughness",
                kind="not physically based",
            )

    def _texture(
        self, slot: str, placed: PlacedTexture
    ) -> tuple[NativeTexture, int, list[float] | None]:
        """A texture of a slot: its handle, its set of coordinates, and the matrix of these."""
        content = _content(slot, self._color_space)
        handle = native_texture(placed.texture, content, self.reading)
        return handle, placed.uv_set, placed.matrix.ravel().tolist() if placed.is_moved else None

    def _note_textures(self, material: Material, textures: set[Texture]) -> None:
        """Watch the textures of a material, and stop watching those that no material uses now."""
        for gone in self._textured.pop(material, set()) - textures:
            self._users[gone].discard(material)
            if not self._users[gone]:
                del self._users[gone]
                self._watch.remove(gone)
        for texture in textures:
            self._watch.add(texture)
            self._users.setdefault(texture, set()).add(material)
        if textures:
            self._textured[material] = textures


def _traits_of(material: Material) -> tuple[bool, bool]:
    """Return the traits of a material that decide how its meshes are listed."""
    return material.flat_shading, material.alpha_mode == "opaque"


def _numbers(material: Material, color_space: ColorSpace) -> dict[str, Any]:
    """The numbers of any material."""
    strength = material.emissive_strength if material.is_physical else 1.0
    emissive = shading_color(material.emissive, color_space)
    return {
        "color": shading_color(material.rgb, color_space),
        "specular": shading_color(material.specular, color_space),
        "shininess": max(material.shininess, _SMALLEST_SHININESS),
        "emissive": tuple(component * strength for component in emissive),
        "flat": material.flat_shading,
        "is_unlit": material.unlit,
        "normal_scale": material.normal_scale,
        "alpha": material.alpha,
        "alpha_mode": ALPHA_MODES[material.alpha_mode],
        "alpha_cutoff": material.alpha_cutoff,
        "mirror": material.mirror,
    }


def _physical(material: Material, color_space: ColorSpace) -> dict[str, Any]:
    """The numbers of a physically based material."""
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
        "ior": max(material.ior, 1.0),
        "reflectance": tuple(root * root * component for component in tint),
        "absorption": tuple(_absorption(component, depth) for component in left),
        "anisotropy_turn": (linalg.cos(turn), linalg.sin(turn)),
        "iridescence_thickness": (
            material.iridescence_thickness_minimum,
            material.iridescence_thickness_maximum,
        ),
    }


def _absorption(left: float, depth: float) -> float:
    """Return log2 of the share of light left after a unit, if ``left`` is there after ``depth``."""
    return min(0.0, max(math.log2(max(left, _LEAST_LEFT)) / depth, -_MOST_ABSORBED))


def _content(slot: str, color_space: ColorSpace) -> Content:
    row = PARAMETERS[slot]
    if not isinstance(row, TextureSlot):
        return "linear"
    if row.is_normals:
        return "normals"
    return color_space if row.is_color else "linear"
