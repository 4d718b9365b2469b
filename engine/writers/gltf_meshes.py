"""Meshes of a glTF file that is written.

In: `MeshRecord` objects. Out: their numbers, and the list of the JSON: a primitive for the faces of
each material, one for lines, one for points.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..geometry.mesh import Mesh
from ..loaders.documents import MeshRecord
from ..materials.colors import srgb_to_linear_table
from .gltf_arrays import GltfArrays
from .gltf_materials import GltfMaterialList

_POINTS, _LINES = 0, 1
_VARIANTS = "KHR_materials_variants"
_INFLUENCES = 4
_MORPHED = {"positions": "POSITION", "normals": "NORMAL", "tangents": "TANGENT"}


class GltfMeshList:
    """The meshes of a file.

    Parameters
    ----------
    arrays : GltfArrays
    materials : GltfMaterialList

    Attributes
    ----------
    meshes : list of dict
        As the JSON has them.
    has_variants : bool
    """

    def __init__(self, arrays: GltfArrays, materials: GltfMaterialList) -> None:
        self._arrays, self._materials = arrays, materials
        self.meshes: list[dict[str, Any]] = []
        self.has_variants = False

    def add(self, record: MeshRecord) -> int:
        """Return the number of a new mesh."""
        entry: dict[str, Any] = {"name": record.name} if record.name else {}
        entry["primitives"] = [
            primitive for part in record.parts for primitive in self._primitives(part)
        ]
        if any(record.morph_weights):
            entry["weights"] = list(record.morph_weights)
        extras = record.extras
        names = [target.name for target in record.mesh.morph_targets]
        if any(names):
            extras = {**(extras if isinstance(extras, dict) else {}), "targetNames": names}
        if extras is not None:
            entry["extras"] = extras
        self.meshes.append(entry)
        return len(self.meshes) - 1

    def _primitives(self, part: MeshRecord):
        mesh = part.mesh.with_creases()
        numbers = np.unique(mesh.material_ids) if len(mesh.materials) > 1 else [0]
        for number in numbers if len(mesh.faces) else ():
            is_all = len(numbers) == 1
            faces = mesh.faces if is_all else mesh.faces[mesh.material_ids == number]
            material = mesh.materials[number]
            entry = self._primitive(mesh, faces, whole=is_all, flat=material.flat_shading)
            yield self._dressed(entry, part, int(number))
        if len(mesh.lines):
            entry = self._primitive(mesh, mesh.lines, whole=not len(mesh.faces))
            yield self._dressed({**entry, "mode": _LINES}, part, 0)
        if len(mesh.points):
            yield self._dressed(self._points(mesh), part, 0)

    def _points(self, mesh: Mesh) -> dict[str, Any]:
        whole = np.array_equal(mesh.points, np.arange(len(mesh.positions)))
        rows = slice(None) if whole else mesh.points
        entry = {"attributes": self._attributes(mesh, rows, flat=False), "mode": _POINTS}
        return {**entry, **self._targets(mesh, rows)}

    def _primitive(
        self, mesh: Mesh, elements: np.ndarray, *, whole: bool, flat: bool = False
    ) -> dict[str, Any]:
        """Faces or lines of one material, with the vertices that they need."""
        rows = slice(None)
        if not whole:
            rows, flat_elements = np.unique(elements, return_inverse=True)
            elements = flat_elements.reshape(elements.shape)
        entry: dict[str, Any] = {"attributes": self._attributes(mesh, rows, flat=flat)}
        entry["indices"] = self._arrays.indices(elements)
        return {**entry, **self._targets(mesh, rows)}

    def _dressed(self, entry: dict[str, Any], part: MeshRecord, number: int) -> dict[str, Any]:
        """A primitive with its material, and those that variants have for it."""
        material = self._materials.number(part.mesh.materials[number])
        if material is not None:
            entry["material"] = material
        by_material: dict[int, list[int]] = {}
        for variant, materials in part.variants.items():
            if number < len(materials):
                other = self._materials.number(materials[number])
                if other is not None:
                    by_material.setdefault(other, []).append(variant)
        if by_material:
            self.has_variants = True
            mappings = [{"material": m, "variants": v} for m, v in by_material.items()]
            entry["extensions"] = {_VARIANTS: {"mappings": mappings}}
        return entry

    def _attributes(self, mesh: Mesh, rows, *, flat: bool) -> dict[str, int]:
        whole = isinstance(rows, slice)
        arrays = {"POSITION": mesh.positions}
        # Faces without normals are flat; there is no other word for it.
        if not flat and (mesh.has_normals or len(mesh.faces)):
            arrays["NORMAL"] = mesh.normals
        if mesh.tangents is not None and not flat:
            arrays["TANGENT"] = mesh.tangents
        for number, uvs in enumerate((mesh.uvs, mesh.uvs1)):
            if uvs is not None:
                arrays[f"TEXCOORD_{number}"] = uvs
        if mesh.colors is not None:
            arrays["COLOR_0"] = mesh.colors
        found = {
            name: self._arrays.vertices(_as_stored(array[rows], name), name, key=array)
            if whole
            else self._arrays.vertices(_as_stored(array[rows], name), name)
            for name, array in arrays.items()
        }
        return {**found, **self._influences(mesh, rows)}

    def _influences(self, mesh: Mesh, rows) -> dict[str, int]:
        found: dict[str, int] = {}
        if mesh.joints is None:
            return found
        joints, weights = mesh.joints[rows], mesh.weights[rows]
        lacking = -joints.shape[1] % _INFLUENCES
        joints = np.pad(joints, ((0, 0), (0, lacking)))
        weights = np.pad(weights, ((0, 0), (0, lacking)))
        for number in range(joints.shape[1] // _INFLUENCES):
            columns = slice(number * _INFLUENCES, (number + 1) * _INFLUENCES)
            for name, array in (("JOINTS", joints), ("WEIGHTS", weights)):
                content = np.ascontiguousarray(array[:, columns])
                found[f"{name}_{number}"] = self._arrays.vertices(content, name)
        return found

    def _targets(self, mesh: Mesh, rows) -> dict[str, list[dict[str, int]]]:
        """What morph targets add: all primitives of a mesh have as many."""
        if not mesh.morph_targets:
            return {}
        return {"targets": [self._target(target, rows) for target in mesh.morph_targets]}

    def _target(self, target, rows) -> dict[str, int]:
        held = {name: getattr(target, field) for field, name in _MORPHED.items()}
        return {
            name: self._arrays.vertices(array[rows], name)
            for name, array in held.items()
            if array is not None
        }


def _as_stored(array: np.ndarray, name: str) -> np.ndarray:
    """An attribute as files have it: v from the top down, colours linear."""
    if name.startswith("TEXCOORD"):
        stored = array.copy()
        np.subtract(np.float32(1), array[:, 1], out=stored[:, 1])
        return stored
    if array.dtype == np.uint8:
        linear = srgb_to_linear_table()[array]
        linear[:, 3] = array[:, 3].astype(np.float64) / 255
        return linear
    return array
