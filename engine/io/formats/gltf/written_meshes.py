"""The meshes of a written glTF file.

In: `MeshRecord` objects. Out: their numbers, and the list of the JSON: a primitive for the faces of
each material, one for lines, one for points.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ....model.geometry.mesh import Mesh
from ....model.geometry.movers import shares
from ....model.geometry.normals import vertex_normals
from ....model.materials.colors import linear_rows
from ...reading.vertex_values import usable_normals
from ...scenes.document_trees import MeshRecord
from ...writing.written_scene import materials_of_faces
from .gltf_meshes import MOST_BENDING, tangent_set
from .gltf_primitives import compact
from .written_arrays import GltfArrays
from .written_materials import GltfMaterialList
from .written_values import WrittenValues, written_values

_POINTS, _LINES = 0, 1
_VARIANTS = "KHR_materials_variants"
_INFLUENCES = 4
_MOST_ROUNDS = 8
_ANY_NORMAL = np.array((0, 0, 1), np.float32)  # for faces without an area
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
        The list in the JSON.
    lost : list of str
        The numbers of meshes that are not written.
    """

    def __init__(self, arrays: GltfArrays, materials: GltfMaterialList) -> None:
        self._arrays, self._materials = arrays, materials
        self.meshes: list[dict[str, Any]] = []
        self.lost: list[str] = []
        self._values = Mesh([]), WrittenValues({}, [])  # of the latest mesh

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

    def _primitives(self, part: MeshRecord) -> Any:
        mesh = _with_tangents(part.mesh.with_creases())
        numbers = materials_of_faces(mesh)
        for number in numbers:
            faces = mesh.faces[mesh.material_ids == number] if len(numbers) > 1 else mesh.faces
            entry = self._primitive(mesh, faces, flat=mesh.materials[number].flat_shading)
            yield self._dressed(entry, part, number)
        if len(mesh.lines):
            entry = self._primitive(mesh, mesh.lines, flat=False)
            yield self._dressed({**entry, "mode": _LINES}, part, 0)
        if len(mesh.points):
            yield self._dressed(self._points(mesh), part, 0)

    def _points(self, mesh: Mesh) -> dict[str, Any]:
        whole = np.array_equal(mesh.points, np.arange(len(mesh.positions)))
        rows = slice(None) if whole else mesh.points
        entry = self._vertices(mesh, rows, mesh.faces[:0], flat=False)
        entry["attributes"] |= self._numbers(mesh, slice(None), "points")
        return {**entry, "mode": _POINTS}

    def _primitive(self, mesh: Mesh, elements: np.ndarray, *, flat: bool) -> dict[str, Any]:
        """Return a primitive: faces or lines of one material, with their vertices."""
        rows, elements = compact(elements, len(mesh.positions))
        entry = self._vertices(mesh, rows, elements[:, :3], flat=flat)
        return {**entry, "indices": self._arrays.indices(elements)}

    def _dressed(self, entry: dict[str, Any], part: MeshRecord, number: int) -> dict[str, Any]:
        """Return a primitive with its material, and those of variants."""
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
            mappings = [{"material": m, "variants": v} for m, v in by_material.items()]
            entry["extensions"] = {_VARIANTS: {"mappings": mappings}}
        return entry

    def _vertices(self, mesh: Mesh, rows: Any, faces: np.ndarray, *, flat: bool) -> dict[str, Any]:
        """Return the attributes of some vertices that readers use."""
        arrays = {"POSITION": mesh.positions[rows]}
        # Faces without normals are flat: glTF has no other way to say so.
        if not flat and (mesh.has_normals or len(mesh.faces)):
            faces = faces if faces.shape[1] == 3 else mesh.faces[:0]
            normals = _usable(mesh.normals[rows], arrays["POSITION"], faces)
            arrays |= {} if normals is None else {"NORMAL": normals}
        if mesh.tangents is not None and "NORMAL" in arrays:
            arrays["TANGENT"] = mesh.tangents[rows]
        for number, uvs in enumerate((mesh.uvs, mesh.uvs1)):
            if uvs is not None:
                arrays[f"TEXCOORD_{number}"] = uvs[rows]
        if mesh.colors is not None:
            arrays["COLOR_0"] = mesh.colors[rows]
        found = {
            name: self._arrays.vertices(_as_stored(array, name), name)
            for name, array in arrays.items()
        }
        found |= self._numbers(mesh, rows, "vertices")
        entry: dict[str, Any] = {"attributes": {**found, **self._influences(mesh, rows)}}
        if mesh.morph_targets:  # all primitives of a mesh must have the same number
            entry["targets"] = [self._target(target, rows, found) for target in mesh.morph_targets]
        return entry

    def _numbers(self, mesh: Mesh, rows: Any, on: str) -> dict[str, int]:
        """Return the custom attributes for the numbers of some vertices or points."""
        if self._values[0] is not mesh:
            self._values = mesh, written_values(mesh)
            self.lost += self._values[1].lost
        return {
            name: self._arrays.numbers(array[rows], name)
            for name, (array, place) in self._values[1].attributes.items()
            if place == on
        }

    def _influences(self, mesh: Mesh, rows: Any) -> dict[str, int]:
        found: dict[str, int] = {}
        if mesh.joints is None or mesh.weights is None:
            return found
        weights = _settled(mesh.weights[rows])
        joints = np.where(weights > 0, mesh.joints[rows], np.uint16(0))
        lacking = -joints.shape[1] % _INFLUENCES
        joints = np.pad(joints, ((0, 0), (0, lacking)))
        weights = np.pad(weights, ((0, 0), (0, lacking)))
        for number in range(joints.shape[1] // _INFLUENCES):
            columns = slice(number * _INFLUENCES, (number + 1) * _INFLUENCES)
            for name, array in (("JOINTS", joints), ("WEIGHTS", weights)):
                content = np.ascontiguousarray(array[:, columns])
                found[f"{name}_{number}"] = self._arrays.vertices(content, name)
        return found

    def _target(self, target: Any, rows: Any, attributes: dict[str, int]) -> dict[str, int]:
        """Return a target's offsets of the existing attributes."""
        held = {
            name: getattr(target, field) for field, name in _MORPHED.items() if name in attributes
        }
        added = {name: array[rows] for name, array in held.items() if array is not None}
        if not added:  # a target without effect still has its weight
            added["POSITION"] = np.zeros((len(target), 3), np.float32)[rows]
        return {name: self._arrays.vertices(array, name) for name, array in added.items()}


def _settled(weights: np.ndarray) -> np.ndarray:
    """Return weights that do not change when readers normalise them again."""
    for _ in range(_MOST_ROUNDS):
        read = shares(weights.astype(np.float64))
        if np.array_equal(read, weights):
            break
        weights = read
    return weights


def _with_tangents(mesh: Mesh) -> Mesh:
    """Return a deformable mesh with the tangents readers would compute; others unchanged."""
    bends = mesh.joints is not None or bool(mesh.morph_targets)
    if not bends or mesh.tangents is not None or not 0 < len(mesh.faces) <= MOST_BENDING:
        return mesh
    used = [mesh.materials[number] for number in materials_of_faces(mesh)]
    smooth = [material for material in used if not material.flat_shading]
    uv_set = next((found for m in smooth if (found := tangent_set(m)) is not None), None)
    if uv_set is None or (mesh.uvs1 if uv_set else mesh.uvs) is None:
        return mesh
    return mesh.with_tangents(uv_set)


def _usable(normals: np.ndarray, positions: np.ndarray, faces: np.ndarray) -> np.ndarray | None:
    """Return valid normals; faces always get some, because they would be flat otherwise."""
    given = usable_normals(normals, positions, faces)
    if given is not None or not len(faces):
        return given
    found = usable_normals(vertex_normals(positions, faces), positions, faces)
    return np.tile(_ANY_NORMAL, (len(positions), 1)) if found is None else found


def _as_stored(array: np.ndarray, name: str) -> np.ndarray:
    """Return an attribute as stored in files: v from the top down, colours linear."""
    if name.startswith("TEXCOORD"):
        stored = array.copy()
        np.subtract(np.float32(1), array[:, 1], out=stored[:, 1])
        return stored
    if array.dtype == np.uint8:
        return linear_rows(array)
    return np.nan_to_num(array).clip(0, 1) if name == "COLOR_0" else array
