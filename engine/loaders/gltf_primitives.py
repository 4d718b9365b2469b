"""Triangles, lines and points of a glTF file.

In: a primitive of a mesh. Out: a `Primitive`: its elements and what its vertices carry, as a `Mesh`
takes them; None for what has no positions. Vertices that nothing uses are left out.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .._native import loaders as native
from .gltf_accessors import GltfAccessors
from .gltf_draco import GltfDraco
from .gltf_file import GltfFile
from .gltf_materials import GltfMaterials
from .vertex_values import finite_uvs, usable_normals
from .warning_list import WarningList

_POINTS, _LINES, _LOOP, _LINE_STRIP, _TRIANGLES, _STRIP, _FAN = range(7)
#: The extensions that are read here.
READ = ("KHR_mesh_quantization",)
# Of so few of all vertices a list is sorted; of more each is marked.
_FEW = 4
_INFLUENCES = 4
_WIDTHS = (1, 2, 3, 4)  # of attributes of the file's own
_MORPHED = {"POSITION": "positions", "NORMAL": "normals", "TANGENT": "tangents"}


@dataclass
class Primitive:
    """One primitive.

    Attributes
    ----------
    kind : {"faces", "lines", "points"}
    elements : (E, 3), (E, 2) or (E,) int32
        Vertices.
    arrays : dict of str to array
        What the vertices carry, by the names that `Mesh` has for it.
    joints : (V, J) uint16 or None
    weights : (V, J) float32 or None
    morphs : list of dict of str to (V, 3) float32
        What each morph target adds to positions, normals, tangents.
    material : int or None
    uv_sets : tuple of int
        The sets of texture coordinates of the file that ``uvs`` and ``uvs1`` are.
    scalars : dict of str to (V, N) number
        Attributes of the file's own, if they are asked for.
    """

    kind: str
    elements: np.ndarray
    arrays: dict[str, np.ndarray]
    joints: np.ndarray | None = None
    weights: np.ndarray | None = None
    morphs: list[dict[str, np.ndarray]] = field(default_factory=list)
    material: int | None = None
    uv_sets: tuple[int, ...] = (0, 1)
    scalars: dict[str, np.ndarray] = field(default_factory=dict)


class GltfPrimitives:
    """Reads the primitives of a file.

    Parameters
    ----------
    file : GltfFile
    accessors : GltfAccessors
    materials : GltfMaterials
    draco : GltfDraco
    warnings : WarningList
    scalars : bool
        Whether to read attributes whose names begin with ``_``.

    Attributes
    ----------
    left_out : list of str
        Places of the primitives that have no positions.
    own : set of str
        Names of attributes that the file has for itself.
    """

    def __init__(
        self,
        file: GltfFile,
        accessors: GltfAccessors,
        materials: GltfMaterials,
        draco: GltfDraco,
        warnings: WarningList,
        scalars: bool = False,
    ) -> None:
        self._file, self._accessors, self._materials = file, accessors, materials
        self._scalars = scalars
        self._draco, self._warnings = draco, warnings
        self._told: set[str] = set()
        self.left_out: list[str] = []
        self.own: set[str] = set()

    def read(self, entry: dict, where: str) -> Primitive | None:
        """Return a primitive, which ``where`` names in errors."""
        file = self._file
        attributes = file.part(entry, "attributes", where)
        mode = file.whole(entry, "mode", where, _TRIANGLES)
        if mode > _FAN:
            raise file.error(f"damaged: {where}.mode is {mode}")
        targets = file.entries("targets", entry, f"{where}.")
        material = entry.get("material")
        uv_sets = self._uv_sets(entry, where)
        if "POSITION" not in attributes:
            self.left_out.append(where)
            return None
        vertices = _Vertices(self._accessors, self._draco, attributes, entry, where)
        elements = _elements(vertices.corners(), mode)
        if mode == _POINTS:
            vertices.rows = elements if vertices.is_indexed else slice(None)
            elements = np.arange(len(elements), dtype=np.int32)
        else:
            vertices.rows, elements = compact(elements, vertices.total)
        kind = "points" if mode == _POINTS else "lines" if mode < _TRIANGLES else "faces"
        primitive = Primitive(kind, elements, {}, material=material, uv_sets=uv_sets)
        self._add_arrays(primitive, vertices)
        self._add_influences(primitive, vertices, where)
        own = [name for name in attributes if name.startswith("_")]
        self.own.update(own)
        if self._scalars:
            width_of = {name: self._accessors.width(attributes[name], where) for name in own}
            usable = [name for name in own if width_of[name] in _WIDTHS]
            primitive.scalars = {name: vertices.numbers(name) for name in usable}
        primitive.morphs = [
            self._morph(vertices, target, f"{where}.targets[{number}]")
            for number, target in enumerate(targets)
        ]
        return primitive

    def _uv_sets(self, entry: dict, where: str) -> tuple[int, ...]:
        """The two sets of texture coordinates that the materials of a primitive use."""
        used = self._materials.uv_sets(entry, where)
        if used <= {0, 1}:
            return (0, 1)
        if len(used) > 2:
            self._tell("sets", f"{where}: of {len(used)} sets of texture coordinates two are drawn")
        return tuple(sorted(used))[:2]

    def _tell(self, kind: str, message: str) -> None:
        """Warn of something once a file."""
        if kind not in self._told:
            self._told.add(kind)
            self._warnings.add(message)

    def _add_arrays(self, primitive: Primitive, vertices: _Vertices) -> None:
        arrays, named = primitive.arrays, vertices.attributes
        positions = arrays["positions"] = vertices.floats("POSITION", 3)
        faces = primitive.elements if primitive.kind == "faces" else np.zeros((0, 3), np.int32)
        if "NORMAL" in named:
            normals = usable_normals(vertices.floats("NORMAL", 3), positions, faces)
            arrays.update({} if normals is None else {"normals": normals})
        if "TANGENT" in named and "normals" in arrays:
            tangents = vertices.floats("TANGENT", 4)
            if np.isfinite(tangents).all():
                arrays["tangents"] = tangents
            else:
                self._tell("tangents", f"{vertices.where} has tangents that are not finite")
        for name, uv_set in zip(("uvs", "uvs1"), primitive.uv_sets, strict=False):
            if f"TEXCOORD_{uv_set}" in named:
                uvs = finite_uvs(vertices.floats(f"TEXCOORD_{uv_set}", 2))
                np.subtract(np.float32(1), uvs[:, 1], out=uvs[:, 1])
                arrays[name] = uvs
        if "COLOR_0" in named:
            colors = np.nan_to_num(vertices.floats("COLOR_0", 3, 4)).clip(0, 1)
            opaque = np.ones((len(colors), 4 - colors.shape[1]), np.float32)
            arrays["colors"] = np.concatenate([colors, opaque], axis=1)
        if "COLOR_1" in named:
            self._tell("colors", f"{vertices.where} has several colours a vertex: COLOR_0 is drawn")

    def _add_influences(self, primitive: Primitive, vertices: _Vertices, where: str) -> None:
        """Joints and weights of all sets side by side."""
        joints, weights = [], []
        while f"JOINTS_{len(joints)}" in vertices.attributes:
            name = f"WEIGHTS_{len(joints)}"
            if name not in vertices.attributes:
                raise self._file.error(f"damaged: {where} has joints without {name}")
            held = vertices.raw(f"JOINTS_{len(joints)}", _INFLUENCES)
            if held.dtype.kind != "u" or held.dtype.itemsize > 2:
                raise self._file.error(f"damaged: {where} has joints of a type that has none")
            joints.append(held.astype(np.uint16))
            weights.append(vertices.floats(name, _INFLUENCES))
        if not joints:
            return
        primitive.weights = _usable(np.concatenate(weights, axis=1))
        # Files leave any number beside a weight of 0.
        primitive.joints = np.where(primitive.weights > 0, np.concatenate(joints, axis=1), 0)

    def _morph(self, vertices: _Vertices, target: dict, where: str) -> dict[str, np.ndarray]:
        """Another set of attributes, which count only where the mesh itself has them."""
        for name in target:
            if name not in _MORPHED:
                self._tell(name, f"{where}: what it adds to {name} is left out")
        deltas = {}
        for name, place in _MORPHED.items():
            if name in target and name in vertices.attributes:
                deltas[place] = vertices.deltas(target[name], f"{where} ({name})")
                if not np.isfinite(deltas[place]).all():
                    raise self._file.error(f"damaged: {where} adds what is not finite to {name}")
        return deltas


class _Vertices:
    """What the vertices of a primitive carry; ``rows`` are those that are asked for."""

    def __init__(self, accessors, draco, attributes: dict, entry: dict, where: str) -> None:
        self.attributes, self.where = attributes, where
        self._accessors, self._entry = accessors, entry
        self._unpacked = draco.unpacked(entry, where)
        self.rows = slice(None)
        self.total = len(self.raw("POSITION", 3))

    @property
    def is_indexed(self) -> bool:
        """Whether the elements name their vertices."""
        return "indices" in self._entry

    def corners(self) -> np.ndarray:
        """The vertices (C,) that the elements name one after the other."""
        if self._unpacked is not None and self._unpacked.corners is not None:
            corners = self._unpacked.corners
        elif not self.is_indexed:
            return np.arange(self.total, dtype=np.int32)
        else:
            corners = self._accessors.indices(self._entry["indices"], self.where)
        highest = int(corners.max()) if len(corners) else -1
        if highest >= self.total:
            raise self._accessors.file.error(
                f"damaged: {self.where} names vertex {highest}, there are {self.total}"
            )
        made = native.large_array(corners.shape, np.int32)
        made[:] = corners
        return made

    def raw(self, name: str, *widths: int) -> np.ndarray:
        """An attribute as it is stored."""
        values = self._stored(name, *widths)
        return values[self.rows]

    def _stored(self, name: str, *widths: int) -> np.ndarray:
        where = f"{self.where} ({name})"
        unpacked = None if self._unpacked is None else self._unpacked.arrays.get(name)
        if unpacked is not None:
            self._accessors.check(self.attributes[name], where, *widths)
            values = self._accessors.typed(unpacked, self.attributes[name])
        else:
            values = self._accessors.raw(self.attributes[name], where, *widths)
        self._check_count(values, name)
        return values

    def floats(self, name: str, *widths: int) -> np.ndarray:
        """An attribute as float32."""
        return self._accessors.as_floats(
            self._stored(name, *widths), self.attributes[name], self.rows
        )

    def numbers(self, name: str) -> np.ndarray:
        """An attribute of the file's own, integers as they are unless they stand for others."""
        values = self._stored(name, *_WIDTHS)
        return self._accessors.as_numbers(values, self.attributes[name], self.rows)

    def deltas(self, index: int, where: str) -> np.ndarray:
        """What a morph target adds to an attribute."""
        values = self._accessors.raw(index, where, 3)
        self._check_count(values, where)
        return self._accessors.as_floats(values, index, self.rows)

    def _check_count(self, values: np.ndarray, name: str) -> None:
        total = getattr(self, "total", len(values))
        if len(values) != total:
            raise self._accessors.file.error(
                f"damaged: {self.where} has {len(values)} {name} for {total} positions"
            )


def compact(elements: np.ndarray, total: int):
    """The rows of the vertices in use, and the elements with the numbers that these get."""
    if elements.size * _FEW < total:
        rows, flat = np.unique(elements, return_inverse=True)
        return rows, flat.reshape(elements.shape).astype(np.int32)
    used = native.used_or_all(np.ascontiguousarray(elements).ravel(), total)
    if used is None:
        return slice(None), elements
    number = np.cumsum(used, dtype=np.int32) - np.int32(1)
    return np.flatnonzero(used), number[elements]


def _usable(weights: np.ndarray) -> np.ndarray:
    """Weights of which each row has one; the first joint moves what none does."""
    weights = np.where(np.isfinite(weights) & (weights > 0), weights, np.float32(0))
    weights[~weights.any(axis=1), 0] = 1
    return weights


def _elements(corners: np.ndarray, mode: int) -> np.ndarray:
    """Triangles, segments or points; corners that are too few for a last one are left out."""
    if mode == _POINTS:
        return corners
    if mode < _TRIANGLES:
        return _segments(corners, mode)
    if mode == _TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if len(corners) < 3:
        return np.zeros((0, 3), np.int32)
    first = np.arange(len(corners) - 2)
    if mode == _FAN:
        return corners[np.stack([first + 1, first + 2, np.zeros_like(first)], axis=1)]
    odd = first % 2
    return corners[np.stack([first, first + 1 + odd, first + 2 - odd], axis=1)]


def _segments(corners: np.ndarray, mode: int) -> np.ndarray:
    """Segments (L, 2)."""
    if mode == _LINES:
        return corners[: len(corners) // 2 * 2].reshape(-1, 2)
    ends = np.roll(corners, -1)
    segments = np.stack([corners, ends], axis=1)
    return segments if mode == _LOOP else segments[:-1]
