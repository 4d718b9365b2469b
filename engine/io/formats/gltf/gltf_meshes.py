"""The meshes of a glTF file.

In: a `GltfFile` and the reader of its primitives. Out: a `MeshRecord` each. Primitives of a mesh
with the same attributes become one `Mesh`, with a material each; others become further parts of the
record. Meshes of the same primitives share their arrays. A primitive that is damaged is left out
with a warning.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any, TypeAlias

import numpy as np

from ...._native.loaders import frozen
from ....model.geometry.creases import SMOOTH
from ....model.geometry.mesh import Mesh
from ....model.geometry.morph_targets import MorphTarget
from ....model.geometry.native_meshes import find_tangents_when_drawn
from ....model.geometry.twins import twin_of
from ....model.geometry.values import Values, joined_rows, put_values
from ....model.materials.linear_colors import floats_are_linear
from ....model.materials.material import Material
from ....model.materials.textures import PlacedTexture
from ...reading.smoothing import join_seams
from ...reading.text import shown
from ...scenes.document_trees import MeshRecord
from .gltf_buffers import GltfBuffers
from .gltf_file import DamagedError, Entry, GltfFile
from .gltf_materials import GltfMaterials
from .gltf_primitives import GltfPrimitives, Primitive

# For deformable meshes with up to this many faces, tangents are computed at loading.
MOST_BENDING = 1 << 17
_MORPHS = ("positions", "normals", "tangents")
_NO_MATERIAL = Material()

# A primitive, its JSON entry, and its place there.
_Member: TypeAlias = tuple[Primitive, Entry, str]
# The material of a primitive, and those of its variants.
_Chosen: TypeAlias = tuple[Material, dict[int, Material]]


class GltfMeshes:
    """Reads the meshes of a file.

    Parameters
    ----------
    file : GltfFile
    buffers : GltfBuffers
    primitives : GltfPrimitives
    materials : GltfMaterials
    """

    def __init__(
        self,
        file: GltfFile,
        buffers: GltfBuffers,
        primitives: GltfPrimitives,
        materials: GltfMaterials,
    ) -> None:
        self._file, self._buffers = file, buffers
        self._primitives, self._materials = primitives, materials
        self._parts: dict[tuple[object, ...], Mesh] = {}  # for cached primitives
        self._variant_materials = 0

    def all(self) -> tuple[MeshRecord, ...]:
        """Return the meshes.

        Raises
        ------
        FileFormatError
        """
        entries = zip(self._file.entries("meshes"), self._primitives.lists, strict=True)
        return tuple(
            self._mesh(entry, primitives, f"meshes[{index}]")
            for index, (entry, primitives) in enumerate(entries)
        )

    def _mesh(self, entry: Entry, primitives: list[Entry], where: str) -> MeshRecord:
        file, name = self._file, self._file.name(entry, where)
        groups: dict[tuple[object, ...], list[_Member]] = {}
        for number, primitive in enumerate(primitives):
            place = f"{where}.primitives[{number}]"
            try:
                read = self._primitives.read(primitive, place)
            except DamagedError as error:
                file.lose(place, error)
                continue
            if read is not None:
                groups.setdefault(_kind_of(read), []).append((read, primitive, place))
        if not groups:
            return MeshRecord(name, Mesh([], name=name), extras=entry.get("extras"))
        counts = {len(read.morphs) for members in groups.values() for read, _, _ in members}
        count = max(counts)
        if len(counts) > 1:
            file.warnings.add(
                f"the primitives of {where} have unequal morph targets: each moves by its own"
            )
        names = _target_names(entry.get("extras"), count)
        first, *rest = (self._part(name, members, names) for members in groups.values())
        weights = file.sound(f"{where}.weights", self._weights, entry, count, where)
        weights = (0.0,) * count if weights is None else weights
        return replace(first, morph_weights=weights, rest=tuple(rest), extras=entry.get("extras"))

    def _weights(self, entry: Entry, count: int, where: str) -> tuple[float, ...] | None:
        weights = self._file.number_list(entry, "weights", where)
        if weights is not None and len(weights) != count:
            raise self._file.damaged(f"{where} has {len(weights)} weights, {count} targets")
        return weights

    def _part(self, name: str, members: list[_Member], target_names: list[str]) -> MeshRecord:
        """Return primitives with the same attributes as one mesh."""
        primitives = [primitive for primitive, _, _ in members]
        kind = primitives[0].kind
        flat = kind == "faces" and "normals" not in primitives[0].arrays
        chosen = [self._chosen(*member, flat=flat) for member in members]
        uv_set = None if kind != "faces" or flat else _tangent_set_of(chosen)
        # The arrays stay alive as long as the primitives are cached.
        key = (*(id(primitive.arrays) for primitive in primitives), *target_names, uv_set)
        if self._primitives.are_kept(primitives):
            if key not in self._parts:
                self._parts[key] = self._made(primitives, target_names, uv_set)
            mesh = self._parts[key]
        else:
            mesh = self._made(primitives, target_names, uv_set)
        materials = [usual for usual, _ in (chosen if kind == "faces" else chosen[:1])]
        mesh = twin_of(mesh, materials, name)
        return MeshRecord(name, mesh, variants=self._variants(chosen, name))

    def _made(
        self, primitives: list[Primitive], target_names: list[str], uv_set: int | None
    ) -> Mesh:
        """Return a mesh of several primitives, with provisional materials."""
        counts = [len(primitive.arrays["positions"]) for primitive in primitives]
        starts = np.cumsum([0, *counts])[:-1]
        arrays = {
            key: self._joined([p.arrays[key] for p in primitives]) for key in primitives[0].arrays
        }
        kind = primitives[0].kind
        flat = kind == "faces" and "normals" not in arrays
        elements = [
            primitive.elements + np.int32(start) if start else primitive.elements
            for primitive, start in zip(primitives, starts, strict=True)
        ]
        ids = None
        if kind == "faces" and len(primitives) > 1:
            sizes = [len(part) for part in elements]
            self._buffers.count(sum(sizes))
            ids = np.repeat(np.arange(len(primitives), dtype=np.int32), sizes)
        with floats_are_linear():
            mesh = Mesh(
                arrays.pop("positions"),
                **{kind: self._joined(elements)},
                materials=[_NO_MATERIAL] * len(primitives),
                material_ids=ids,
                crease_angle=SMOOTH,
                name="",
                **arrays,
            )
        put_values(mesh, self._values_of(primitives))
        if flat:
            join_seams(mesh)
        joints = [p.joints for p in primitives if p.joints is not None]
        weights = [p.weights for p in primitives if p.weights is not None]
        if joints:
            mesh.set_influences(self._joined(joints), self._joined(weights))
        if target_names:
            mesh.morph_targets = self._morphs(primitives, counts, target_names)
        if kind == "faces" and "normals" in arrays and "tangents" not in arrays:
            mesh = self._with_tangents(mesh, uv_set)
        return mesh

    def _values_of(self, primitives: list[Primitive]) -> dict[str, Values]:
        """Return the custom numbers of joined primitives; NaN where one has none."""
        values = {}
        for name in dict.fromkeys(name for p in primitives for name in p.values):
            lacking = (np.zeros((len(p.arrays["positions"]), 0), np.float32) for p in primitives)
            parts = [p.values.get(name, none) for p, none in zip(primitives, lacking, strict=True)]
            self._buffers.count(sum(part.size for part in parts) if len(parts) > 1 else 0)
            values[name] = Values(frozen(joined_rows(parts)), "vertices")
        return values

    def _variants(self, chosen: list[_Chosen], name: str) -> dict[int, tuple[Material, ...]]:
        """Return the materials of each variant; none, with a warning, if there are too many."""
        named: dict[int, dict[int, Material]] = {}  # for each variant, the materials by primitive
        for number, (_, others) in enumerate(chosen):
            for variant, material in others.items():
                named.setdefault(variant, {})[number] = material
        self._variant_materials += len(named) * len(chosen)
        if self._variant_materials > self._buffers.limit:
            self._file.warnings.add(
                f"mesh {shown(name)}: {len(named)} variants of {len(chosen)} primitives are more "
                "than such a file may have: left out"
            )
            return {}
        usual_ones = [usual for usual, _ in chosen]
        found = {}
        for variant in sorted(named):
            materials = list(usual_ones)
            for number, material in named[variant].items():
                materials[number] = material
            found[variant] = tuple(materials)
        return found

    def _with_tangents(self, mesh: Mesh, uv_set: int | None) -> Mesh:
        """Return a mesh whose tangents are computed at drawing, or now if it is deformable."""
        if uv_set is None or (mesh.uvs1 if uv_set else mesh.uvs) is None:
            return mesh
        if mesh.joints is None and not mesh.morph_targets:
            find_tangents_when_drawn(mesh, uv_set)
            return mesh
        if len(mesh.faces) > MOST_BENDING:
            return mesh
        self._buffers.count(4 * len(mesh.positions))
        return mesh.with_tangents(uv_set)

    def _chosen(self, primitive: Primitive, entry: Entry, where: str, *, flat: bool) -> _Chosen:
        get = partial(self._materials.get, where=where, flat=flat, uv_sets=primitive.uv_sets)
        usual = get(primitive.material)
        others = {
            variant: get(material)
            for material, variants in self._materials.variants(entry, where)
            for variant in variants
        }
        return usual, others

    def _morphs(
        self, primitives: list[Primitive], counts: list[int], names: list[str]
    ) -> list[MorphTarget]:
        """Return the morph targets of joined primitives; missing offsets are 0."""
        found = []
        # A primitive with fewer targets is not moved by the missing ones.
        held = ([*p.morphs, *({},) * (len(names) - len(p.morphs))] for p in primitives)
        for name, *targets in zip(names, *held, strict=True):
            deltas = {}
            for key in _MORPHS:
                parts = [target.get(key) for target in targets]
                if any(part is not None for part in parts):
                    deltas[key] = self._joined(
                        [
                            np.zeros((count, 3), np.float32) if part is None else part
                            for part, count in zip(parts, counts, strict=True)
                        ]
                    )
            if not deltas:  # a target without effect still has its weight
                deltas["positions"] = np.zeros((sum(counts), 3), np.float32)
            found.append(MorphTarget(**deltas, name=name))
        return found

    def _joined(self, parts: list[np.ndarray]) -> np.ndarray:
        if len(parts) == 1:
            return frozen(parts[0])
        self._buffers.count(sum(part.size for part in parts))
        return frozen(np.concatenate(parts))


def _kind_of(primitive: Primitive) -> tuple[object, ...]:
    """Return the properties that all primitives of one mesh must share."""
    joints = 0 if primitive.joints is None else primitive.joints.shape[1]
    material = None if primitive.kind == "faces" else primitive.material
    # Different UV sets need different materials, even if only one set is drawn.
    return primitive.kind, tuple(primitive.arrays), joints, material


def tangent_set(material: Material) -> int | None:
    """Return the UV set that needs tangents; None if none does, or if it is rotated."""
    maps = material.normal_texture, material.clearcoat_normal_texture, material.anisotropy_texture
    found = next((texture for texture in maps if texture is not None), None)
    if isinstance(found, PlacedTexture):
        return None if found.is_moved else found.uv_set
    return 0 if found is not None or material.anisotropy else None


def _tangent_set_of(chosen: list[_Chosen]) -> int | None:
    """Return the UV set for which any material of a mesh needs tangents."""
    materials = [usual for usual, _ in chosen]
    materials += [material for _, others in chosen for material in others.values()]
    return next((found for m in materials if (found := tangent_set(m)) is not None), None)


def _target_names(extras: Any, count: int) -> list[str]:
    names = extras.get("targetNames") if isinstance(extras, dict) else None
    names = [str(name) for name in names[:count]] if isinstance(names, list) else []
    return names + [""] * (count - len(names))
