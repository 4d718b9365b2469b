"""The meshes of a 3MF file.

In: objects and property groups from the XML. Out: a `Mesh` for each object, with a material for
each base material and texture used, and colours and texture coordinates of corners.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ....errors import FileAccessError, FileFormatError
from ....model.geometry.mesh import Mesh
from ....model.materials.material import Material
from ....model.materials.textures import Texture
from ...reading.far_coordinates import moved_near
from ...reading.indexed_mesh import IndexedGeometry, build_indexed_mesh
from ...reading.reader_registry import find_reader
from ...reading.sources import Source
from ...reading.text import shown
from ...reading.vertex_values import finite_uvs
from ...reading.warning_list import WarningList
from ...reading.zip_archives import ZipArchive
from .threemf_model import ModelPart, ObjectRecord
from .threemf_properties import WHITE, Color, PropertyGroup

# The first of a triangle's layers with one of these kinds is shown.
_LAYERS = ("texture", "color", "base")


@dataclass
class _Corners:
    """The attributes of a mesh's corners, filled triangle by triangle."""

    materials: np.ndarray
    colors: np.ndarray | None = None
    uvs: np.ndarray | None = None


class _NoLookError(Exception):
    """Triangles cannot get their declared appearance; the text says why."""


class MeshBuilder:
    """Builds the meshes of one part.

    Parameters
    ----------
    part : ModelPart
    archive : ZipArchive
        The archive that contains images.
    source : Source
    warnings : WarningList
    """

    def __init__(
        self, part: ModelPart, archive: ZipArchive, source: Source, warnings: WarningList
    ) -> None:
        self._part, self._archive, self._source = part, archive, source
        self._warnings = warnings
        self._textures: dict[int, Texture | None] = {}
        self._materials: dict[tuple[object, ...], Material] = {}

    def mesh(self, record: ObjectRecord, near: bool) -> tuple[Mesh, np.ndarray | None]:
        """Return the mesh of an object, and the pose that undoes a move of its coordinates.

        Parameters
        ----------
        record : ObjectRecord
        near : bool
            Move coordinates far from the origin near it.
        """
        positions = np.array(record.positions, np.float64).reshape(-1, 3)
        corners = np.array(record.corners, np.int32).reshape(-1, 3)
        back = None
        if near:
            positions, back = moved_near(positions)
        geometry = IndexedGeometry(positions, corners, crease_angle=self._source.crease_angle)
        if record.beams:
            geometry.lines = np.array(record.beams, np.int32).reshape(-1, 2)
        materials = [Material()]
        found = self._corners(record, len(corners), materials)
        if found is not None:
            geometry.corner_colors = found.colors
            if found.uvs is not None:
                geometry.corner_uvs = finite_uvs(found.uvs.reshape(-1, 2)).reshape(-1, 3, 2)
        mesh = build_indexed_mesh(geometry, record.name)
        mesh.materials = materials
        if found is not None:
            used, mesh.material_ids = np.unique(found.materials, return_inverse=True)
            mesh.materials = [materials[number] for number in used.tolist()]
        return mesh, back

    def _corners(
        self, record: ObjectRecord, count: int, materials: list[Material]
    ) -> _Corners | None:
        """Return the attributes of an object's triangles; None if there are none."""
        if record.group < 0 and not record.properties:
            return None
        found = _Corners(np.zeros(count, np.int32))
        numbers: dict[int, int] = {}
        usual = (record.group, record.index, record.index, record.index)
        if record.group >= 0:
            self._give(found, slice(None), usual, materials, numbers)
        for triangle, said in record.properties.items():
            if said[0] >= 0:
                self._give(found, triangle, said, materials, numbers)
        return found

    def _give(
        self,
        found: _Corners,
        triangles: int | slice,
        said: tuple[int, int, int, int],
        materials: list[Material],
        numbers: dict[int, int],
    ) -> None:
        """Assign a property to one triangle, or all: a group and an entry for each corner."""
        group, *indices = said
        try:
            kind, entries, material = self._resolved(group, tuple(indices))
        except _NoLookError as problem:
            self._warnings.add_once(f"{problem}; triangles are drawn without it")
            return
        number = numbers.setdefault(id(material), len(materials))
        if number == len(materials):
            materials.append(material)
        found.materials[triangles] = number
        count = len(found.materials)
        if kind == "color":
            if found.colors is None:
                found.colors = np.full((count, 3, 4), 255, np.uint8)
            found.colors[triangles] = entries
        elif found.colors is not None:
            found.colors[triangles] = WHITE
        if kind == "texture":
            if found.uvs is None:
                found.uvs = np.zeros((count, 3, 2))
            found.uvs[triangles] = entries

    def _resolved(self, number: int, indices: tuple[int, ...]) -> tuple[str, list[Any], Material]:
        """Return the kind of a property, its entries at three corners, and the material."""
        group = self._group(number)
        if group.kind == "multi":
            number, indices = self._layer(group, self._entries(group, number, indices))
            group = self._group(number)
        entries = self._entries(group, number, indices)
        if group.kind == "texture":
            return "texture", entries, self._textured(group)
        if group.kind == "color":
            is_clear = any(color[3] < 255 for color in entries)
            return "color", entries, self._material(WHITE, is_clear=is_clear)
        if group.kind != "base":
            raise _NoLookError(f"resource {number} is no property group")
        return "base", entries, self._base(group, indices[0])

    def _group(self, number: int) -> PropertyGroup:
        group = self._part.groups.get(number)
        if group is None:
            raise _NoLookError(f"there is no property group {number}")
        return group

    def _entries(self, group: PropertyGroup, number: int, indices: tuple[int, ...]) -> list[Any]:
        if max(indices) >= len(group.entries):
            raise _NoLookError(f"a property of group {number} beyond its {len(group.entries)}")
        return [group.entries[index] for index in indices]

    def _layer(
        self, group: PropertyGroup, corners: list[tuple[int, ...]]
    ) -> tuple[int, tuple[int, ...]]:
        """Return the visible layer of several and its indices, by preference of kind."""
        layers = [self._part.groups.get(number) for number in group.layers]
        kinds = ["" if layer is None else layer.kind for layer in layers]
        shown_kind = next((kind for kind in _LAYERS if kind in kinds), None)
        if shown_kind is None:
            raise _NoLookError("multi-properties of no properties")
        if len(layers) > 1:
            self._warnings.add_once(
                f"of properties in several layers the {shown_kind} is drawn alone"
            )
        place = kinds.index(shown_kind)
        indices = tuple(entry[place] if place < len(entry) else 0 for entry in corners)
        return group.layers[place], indices

    def _base(self, group: PropertyGroup, index: int) -> Material:
        display = self._part.groups.get(group.display)
        surface = None
        if display is not None and display.kind == "display" and index < len(display.entries):
            surface = display.entries[index]
        color = group.entries[index]
        return self._material(color, group.names[index], surface, is_clear=color[3] < 255)

    def _material(
        self,
        color: Color,
        name: str = "",
        surface: tuple[float, float] | None = None,
        *,
        is_clear: bool,
    ) -> Material:
        """Return a material without a texture, cached."""
        key = color, name, surface, is_clear
        if key not in self._materials:
            metallic, roughness = (None, None) if surface is None else surface
            self._materials[key] = Material(
                color=color,
                name=name,
                metallic=metallic,
                roughness=roughness,
                alpha_mode="blend" if is_clear else "opaque",
            )
        return self._materials[key]

    def _textured(self, group: PropertyGroup) -> Material:
        key = ("texture", group.texture)
        if key not in self._materials:
            texture = self._texture(group.texture)
            is_clear = texture is not None and bool((texture.pixels[..., 3] < 255).any())
            self._materials[key] = Material(
                texture=texture, alpha_mode="blend" if is_clear else "opaque"
            )
        return self._materials[key]

    def _texture(self, number: int) -> Texture | None:
        """Return the texture of an image; an unreadable one is left out with a warning."""
        group = self._part.groups.get(number)
        image = None if group is None else group.image
        if image is None:
            self._warnings.add_once(f"resource {number} is no texture; left out")
            return None
        try:
            source = Source(image.path, self._archive.read(image.path))
            pixels = find_reader(source, "image").read(source)
        except (FileAccessError, FileFormatError) as error:
            self._warnings.add(f"texture {shown(image.path)} is left out: {error.message}")
            return None
        name = image.path.rpartition("/")[2]
        return Texture(pixels, wrap=image.wrap, filter=image.filter, name=name)
