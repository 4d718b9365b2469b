"""The materials of a draw list, set anew when a material or texture changes.

In: materials of meshes. Out: materials of a `NativeDrawList`, and a `Watch` on them and their
textures.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ..._native.rasterizer import NativeDrawList
from ...base.dirty_tracking import Watch
from ...choices import ColorSpace
from ...model.materials.material import Material, placed_textures_of
from ...model.materials.textures import Texture
from .native_materials import set_material


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
    """

    def __init__(self, native: NativeDrawList, color_space: ColorSpace, watch: Watch) -> None:
        self._native, self._color_space, self._watch = native, color_space, watch
        self.untextured: frozenset[Material] = frozenset()
        # For each material its places, their owners, and whether both sides are forced to show.
        self._places: dict[Material, list[tuple[int, int, bool]]] = {}
        # For each material, the normals it needs and whether it is opaque.
        self._traits: dict[Material, tuple[bool, bool]] = {}
        self._textured: dict[Material, set[Texture]] = {}
        self._users: dict[Texture, set[Material]] = {}
        # The start of each list of materials, by their IDs and whether both sides are forced to
        # show.
        self._bases: dict[tuple[tuple[int, ...], bool], int] = {}

    def base_of(self, materials: list[Material], both: bool) -> int:
        """Return the number of the first of a mesh's materials; list them if necessary.

        Parameters
        ----------
        materials : list of Material
        both : bool
            Whether both sides show regardless of the materials.
        """
        key = tuple(map(id, materials)), both
        if key not in self._bases:
            base = self._native.material_count
            for number, material in enumerate(materials):
                self._places.setdefault(material, []).append((base + number, number, both))
                self._set(base + number, material, number, both)
            self._bases[key] = base
        return self._bases[key]

    def is_listed_otherwise(self, material: Material) -> bool:
        """Return whether a material changed so much that meshes with it must be listed anew."""
        return self._traits[material] != _traits_of(material)

    def renew(self, changed: Iterable[Any]) -> None:
        """Update the materials that changed or whose textures changed."""
        changed = list(changed)
        materials = {thing for thing in changed if isinstance(thing, Material)}
        for material in materials.union(*(self._users.get(thing, ()) for thing in changed)):
            for index, number, both in self._places[material]:
                self._set(index, material, number, both)

    def _set(self, index: int, material: Material, number: int, both: bool) -> None:
        self._watch.add(material)
        self._traits[material] = _traits_of(material)
        placed = {} if material in self.untextured else placed_textures_of(material)
        self._note_textures(material, {use.texture for use in placed.values()})
        two_sided = both or material.two_sided
        set_material(self._native, index, number, material, placed, self._color_space, two_sided)

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
