"""Primitives of a glTF file: triangles, lines and points.

In: a primitive of a mesh. Out: a `Primitive`: its elements and vertex attributes, as a `Mesh` takes
them; None without positions. Unused vertices are dropped; damaged morph targets, joints and other
deformation data are left out with a warning.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, TypeAlias

import numpy as np

from ...._native import loaders as native
from ...reading.vertex_values import finite_uvs, usable_normals
from .gltf_accessors import GltfAccessors
from .gltf_draco import DRACO, GltfDraco
from .gltf_file import DamagedError, Entry, GltfFile, once
from .gltf_materials import GltfMaterials
from .gltf_sharing import SharedArrays

_POINTS, _LINES, _LOOP, _LINE_STRIP, _TRIANGLES, _STRIP, _FAN = range(7)
#: The extension handled here.
READ = ("KHR_mesh_quantization",)
# Each takes some kilobytes, and a fraction of a millisecond, however small its entry.
_MAX_PRIMITIVES = 10_000
# If elements use a smaller fraction of all vertices than this, sort their indices; otherwise mark
# each vertex.
_FEW = 4
_INFLUENCES = 4
_WIDTHS = (1, 2, 3, 4)  # of custom attributes
# A conversion of an array.
_Change: TypeAlias = Callable[[np.ndarray], np.ndarray]
# The rows of used vertices, and the elements renumbered to them.
_Compact: TypeAlias = tuple[slice | np.ndarray, np.ndarray]
_MORPHED = {"POSITION": "positions", "NORMAL": "normals", "TANGENT": "tangents"}


@dataclass
class Primitive:
    """One primitive of a mesh.

    Attributes
    ----------
    kind : {"faces", "lines", "points"}
    elements : (E, 3), (E, 2) or (E,) int32
        Vertex indices.
    arrays : dict of str to array
        The vertex attributes, by their names in `Mesh`.
    joints : (V, J) uint16 or None
    weights : (V, J) float32 or None
    morphs : list of dict of str to (V, 3) float32
        Each morph target's offsets of positions, normals, tangents.
    material : int or None
    uv_sets : tuple of int
        The file's UV sets that became ``uvs`` and ``uvs1``.
    scalars : dict of str to (V, N) number
        Custom attributes, if requested.
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
    """Reads the primitives of a file. Shared data is created once.

    Parameters
    ----------
    file : GltfFile
    accessors : GltfAccessors
    materials : GltfMaterials
    draco : GltfDraco
    scalars : bool
        Whether to read attributes whose names begin with ``_``.

    Attributes
    ----------
    lists : list of list of dict
        The primitives of each mesh.
    left_out : list of str
        Places of the primitives without positions.
    own : set of str
        Names of the file's custom attributes.
    """

    def __init__(
        self,
        file: GltfFile,
        accessors: GltfAccessors,
        materials: GltfMaterials,
        draco: GltfDraco,
        scalars: bool = False,
    ) -> None:
        self._file, self._accessors, self._materials = file, accessors, materials
        self._scalars = scalars
        self._draco = draco
        self._told: set[str] = set()
        self.lists = primitive_lists(file)
        entries = [entry for entries in self.lists for entry in entries]
        self._uses = Counter(map(_geometry_of, entries))
        self._shared = SharedArrays(map(_accessors_of, entries))
        self._read: dict[str, Primitive | DamagedError] = {}
        self._kept: set[int] = set()
        self.left_out: list[str] = []
        self.own: set[str] = set()

    def read(self, entry: Entry, where: str) -> Primitive | None:
        """Return a primitive; ``where`` is its place for errors.

        Raises
        ------
        DamagedError
        """
        if "POSITION" not in self._file.part(entry, "attributes", where):
            self.left_out.append(where)
            return None
        material, uv_sets = self._materials.number(entry, where), self._uv_sets(entry, where)
        geometry = _geometry_of(entry)
        kept = self._read if self._uses[geometry] > 1 else {}
        make = partial(self._made, entry, uv_sets, where)
        found = once(kept, f"{geometry} {uv_sets}", make)
        if kept is self._read:
            self._kept.add(id(found.arrays))
        return replace(found, material=material)

    def are_kept(self, primitives: list[Primitive]) -> bool:
        """Return whether all given primitives are cached, because others in the file equal them."""
        return all(id(primitive.arrays) in self._kept for primitive in primitives)

    def _made(self, entry: Entry, uv_sets: tuple[int, ...], where: str) -> Primitive:
        file = self._file
        attributes = file.part(entry, "attributes", where)
        mode = file.whole(entry, "mode", where, _TRIANGLES)
        if mode > _FAN:
            raise file.damaged(f"{where}.mode is {mode}")
        vertices = _Vertices(self._accessors, self._draco, self._shared, attributes, entry, where)
        if mode == _POINTS:
            elements = vertices.corners()
            vertices.rows = elements if vertices.is_indexed else slice(None)
            elements = np.arange(len(elements), dtype=np.int32)
        else:
            vertices.rows, elements = vertices.elements(mode)
        kind = "points" if mode == _POINTS else "lines" if mode < _TRIANGLES else "faces"
        primitive = Primitive(kind, elements, {}, uv_sets=uv_sets)
        self._add_arrays(primitive, vertices)
        influences = file.sound(f"{where}.JOINTS_0", self._influences, vertices, where)
        primitive.joints, primitive.weights = influences or (None, None)
        own = [name for name in attributes if name.startswith("_")]
        self.own.update(own)
        if self._scalars:
            width_of = {name: self._accessors.width(attributes[name], where) for name in own}
            usable = [name for name in own if width_of[name] in _WIDTHS]
            primitive.scalars = {name: vertices.numbers(name) for name in usable}
        primitive.morphs = self._morphs(vertices, entry, where)
        return primitive

    def _uv_sets(self, entry: Entry, where: str) -> tuple[int, ...]:
        """Return the two UV sets that the materials of a primitive use."""
        used = self._materials.uv_sets(entry, where)
        if used <= {0, 1}:
            return (0, 1)
        if len(used) > 2:
            self._tell("sets", f"{where}: of {len(used)} sets of texture coordinates two are drawn")
        return tuple(sorted(used))[:2]

    def _tell(self, kind: str, message: str) -> None:
        """Issue a warning once per file."""
        if kind not in self._told:
            self._told.add(kind)
            self._file.warnings.add(message)

    def _add_arrays(self, primitive: Primitive, vertices: _Vertices) -> None:
        arrays, named = primitive.arrays, vertices.attributes
        positions = arrays["positions"] = vertices.floats("POSITION", 3)
        faces = primitive.elements if primitive.kind == "faces" else np.zeros((0, 3), np.int32)
        normals = usable_normals(self._spare(vertices, "NORMAL", 3), positions, faces)
        if normals is not None:
            arrays["normals"] = normals
            tangents = self._spare(vertices, "TANGENT", 4)
            if tangents is not None and np.isfinite(tangents).all():
                arrays["tangents"] = tangents
            elif tangents is not None:
                self._tell("tangents", f"{vertices.where} has tangents that are not finite")
        for name, uv_set in zip(("uvs", "uvs1"), primitive.uv_sets, strict=False):
            uvs = self._spare(vertices, f"TEXCOORD_{uv_set}", 2, changed=_flipped)
            arrays.update({} if uvs is None else {name: uvs})
        colors = self._spare(vertices, "COLOR_0", 3, 4, changed=_with_alpha)
        arrays.update({} if colors is None else {"colors": colors})
        if "COLOR_1" in named:
            self._tell("colors", f"{vertices.where} has several colours a vertex: COLOR_0 is drawn")

    def _spare(
        self, vertices: _Vertices, name: str, *widths: int, changed: _Change | None = None
    ) -> np.ndarray | None:
        """Return an optional attribute; None if it is missing or damaged."""
        if name not in vertices.attributes:
            return None
        read = partial(vertices.floats, name, *widths, changed=changed)
        return self._file.sound(f"{vertices.where}.{name}", read)

    def _influences(self, vertices: _Vertices, where: str) -> tuple[np.ndarray, np.ndarray] | None:
        """Return joints and weights of all sets side by side; None if there are none."""
        joints: list[np.ndarray] = []
        weights = []
        while f"JOINTS_{len(joints)}" in vertices.attributes:
            name = f"WEIGHTS_{len(joints)}"
            if name not in vertices.attributes:
                raise self._file.damaged(f"{where} has joints without {name}")
            held = vertices.raw(f"JOINTS_{len(joints)}", _INFLUENCES)
            if held.dtype.kind != "u" or held.dtype.itemsize > 2:
                raise self._file.damaged(f"{where} has joints of a type that has none")
            joints.append(held.astype(np.uint16))
            weights.append(vertices.floats(name, _INFLUENCES))
        if not joints:
            return None
        usable = _usable(np.concatenate(weights, axis=1))
        # Files may contain any joint index where the weight is 0.
        return np.where(usable > 0, np.concatenate(joints, axis=1), 0), usable

    def _morphs(self, vertices: _Vertices, entry: Entry, where: str) -> list[dict[str, np.ndarray]]:
        """Return each morph target's offsets; a damaged target keeps its index and adds nothing."""
        file = self._file
        targets = file.sound(f"{where}.targets", file.entries, "targets", entry, f"{where}.") or []
        found = []
        for number, target in enumerate(targets):
            place = f"{where}.targets[{number}]"
            found.append(file.sound(place, self._morph, vertices, target, place) or {})
        return found

    def _morph(self, vertices: _Vertices, target: Entry, where: str) -> dict[str, np.ndarray]:
        """Return one target's offsets, only for attributes that the mesh itself has."""
        for name in target:
            if name not in _MORPHED:
                self._tell(name, f"{where}: what it adds to {name} is left out")
        deltas = {}
        for name, place in _MORPHED.items():
            if name in target and name in vertices.attributes:
                deltas[place] = vertices.deltas(target[name], f"{where} ({name})")
                if not np.isfinite(deltas[place]).all():
                    raise self._file.damaged(f"{where} adds what is not finite to {name}")
        return deltas


def primitive_lists(file: GltfFile) -> list[list[Entry]]:
    """Return the primitives of each mesh; none, with a warning, if the list is invalid.

    Raises
    ------
    FileFormatError
        There are too many.
    """
    lists = [
        _primitives_of(file, entry, f"meshes[{index}]")
        for index, entry in enumerate(file.entries("meshes"))
    ]
    if sum(map(len, lists)) > _MAX_PRIMITIVES:
        raise file.error(f"more than {_MAX_PRIMITIVES} primitives")
    return lists


def _primitives_of(file: GltfFile, entry: Entry, where: str) -> list[Entry]:
    try:
        if "primitives" not in entry:
            raise file.damaged(f"{where} has no primitives")
        return file.entries("primitives", entry, f"{where}.")
    except DamagedError as error:
        file.lose(where, error)
        return []


class _Vertices:
    """The attributes of a primitive's vertices; ``rows`` selects vertices."""

    def __init__(
        self,
        accessors: GltfAccessors,
        draco: GltfDraco,
        shared: SharedArrays,
        attributes: Entry,
        entry: Entry,
        where: str,
    ) -> None:
        self.attributes, self.where = attributes, where
        self._accessors, self._shared, self._entry = accessors, shared, entry
        self._unpacked = draco.unpacked(entry, where)
        self.rows: slice | np.ndarray = slice(None)
        self.total = len(self.raw("POSITION", 3))

    @property
    def is_indexed(self) -> bool:
        """Whether the primitive has indices."""
        return "indices" in self._entry

    def corners(self) -> np.ndarray:
        """Return the vertices (C,) in element order."""
        if self._unpacked is not None and self._unpacked.corners is not None:
            corners = self._unpacked.corners
        elif not self.is_indexed:
            return np.arange(self.total, dtype=np.int32)
        else:
            corners = self._accessors.indices(self._entry["indices"], self.where)
        highest = int(corners.max()) if len(corners) else -1
        if highest >= self.total:
            raise self._accessors.file.damaged(
                f"{self.where} names vertex {highest}, there are {self.total}"
            )
        made = native.large_array(corners.shape, np.int32)
        made[:] = corners
        return made

    def elements(self, mode: int) -> _Compact:
        """Return the rows of used vertices, and triangles or segments renumbered to them."""

        def make() -> _Compact:
            return compact(_elements(self.corners(), mode), self.total)

        if self._unpacked is not None:
            return make()
        return self._shared.get("elements", self._entry.get("indices"), make, mode, self.total)

    def raw(self, name: str, *widths: int) -> np.ndarray:
        """Return an attribute as stored."""
        values = self._stored(name, *widths)
        return values[self.rows]

    def _stored(self, name: str, *widths: int) -> np.ndarray:
        where = f"{self.where} ({name})"
        unpacked = None if self._unpacked is None else self._unpacked.arrays.get(name)
        if unpacked is not None:
            index = self._accessors.check(self.attributes[name], where, *widths)
            values = self._accessors.typed(unpacked, index)
        else:
            values = self._accessors.raw(self.attributes[name], where, *widths)
        self._check_count(values, name)
        return values

    def floats(self, name: str, *widths: int, changed: _Change | None = None) -> np.ndarray:
        """Return an attribute as float32; primitives with the same data share one array.

        Parameters
        ----------
        name : str
        *widths : int
        changed : callable, optional
            A conversion of a new array.
        """

        def make() -> np.ndarray:
            values = self._accessors.as_floats(
                self._stored(name, *widths), self.attributes[name], self.rows
            )
            return values if changed is None else changed(values)

        return self._once(changed, self.attributes[name], make)

    def numbers(self, name: str) -> np.ndarray:
        """Return a custom attribute; integers stay integers unless normalised."""
        values = self._stored(name, *_WIDTHS)
        return self._accessors.as_numbers(values, self.attributes[name], self.rows)

    def deltas(self, index: int, where: str) -> np.ndarray:
        """Return a morph target's offsets of an attribute."""

        def make() -> np.ndarray:
            values = self._accessors.raw(index, where, 3)
            self._check_count(values, where)
            return self._accessors.as_floats(values, index, self.rows)

        return self._once("deltas", index, make)

    def _once(self, role: Hashable, index: Any, make: Callable[[], np.ndarray]) -> np.ndarray:
        if self._unpacked is not None or not isinstance(self.rows, slice):
            return make()
        return self._shared.get(role, index, make, self.total)

    def _check_count(self, values: np.ndarray, name: str) -> None:
        total = getattr(self, "total", len(values))
        if len(values) != total:
            raise self._accessors.file.damaged(
                f"{self.where} has {len(values)} {name} for {total} positions"
            )


def _geometry_of(entry: Entry) -> str:
    """Return a primitive's key without materials; equal keys share arrays."""
    extensions = entry.get("extensions")
    packing = extensions.get(DRACO) if isinstance(extensions, dict) else None
    keys = ("attributes", "indices", "mode", "targets")
    return repr([*map(entry.get, keys), packing])


def _accessors_of(entry: Entry) -> list[float]:
    """Return the accessors of a primitive; invalid indices are left out."""
    targets = entry.get("targets")
    parts = [entry.get("attributes"), *(targets if isinstance(targets, list) else [])]
    named = [index for part in parts if isinstance(part, dict) for index in part.values()]
    return [index for index in (*named, entry.get("indices")) if isinstance(index, (int, float))]


def compact(elements: np.ndarray, total: int) -> _Compact:
    """Return the rows of used vertices, and the elements renumbered to them."""
    if elements.size * _FEW < total:
        rows, flat = np.unique(elements, return_inverse=True)
        return rows, flat.reshape(elements.shape).astype(np.int32)
    used = native.used_or_all(np.ascontiguousarray(elements).ravel(), total)
    if used is None:
        return slice(None), elements
    number = np.cumsum(used, dtype=np.int32) - np.int32(1)
    return np.flatnonzero(used), number[elements]


def _flipped(values: np.ndarray) -> np.ndarray:
    """Return texture coordinates with their origin at the bottom left."""
    uvs = finite_uvs(values)
    np.subtract(np.float32(1), uvs[:, 1], out=uvs[:, 1])
    return uvs


def _with_alpha(values: np.ndarray) -> np.ndarray:
    """Return colours with alpha, (V, 4)."""
    colors = np.nan_to_num(values).clip(0, 1)
    opaque = np.ones((len(colors), 4 - colors.shape[1]), np.float32)
    return np.concatenate([colors, opaque], axis=1)


def _usable(weights: np.ndarray) -> np.ndarray:
    """Return weights; vertices whose weights are all 0 follow their first joint."""
    weights = np.where(np.isfinite(weights) & (weights > 0), weights, np.float32(0))
    weights[~weights.any(axis=1), 0] = 1
    return weights


def _elements(corners: np.ndarray, mode: int) -> np.ndarray:
    """Return triangles, segments or points; an incomplete last element is dropped."""
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
    """Return segments (L, 2)."""
    if mode == _LINES:
        return corners[: len(corners) // 2 * 2].reshape(-1, 2)
    ends = np.roll(corners, -1)
    segments = np.stack([corners, ends], axis=1)
    return segments if mode == _LOOP else segments[:-1]
