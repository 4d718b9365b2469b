"""A mesh as its node shows it: deformed by joints and morph targets.

In: a mesh; matrices and weights, which C takes. Out: its handle for drawing, its box and, on
request, a `Mesh` with the deformed vertices.
"""

from __future__ import annotations

import operator
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from ..._native import loaders as native_loaders
from ..._native.rasterizer import NativeMesh, NativePose, NativeRest, pose_meshes
from ..._native.scene_graph import OBJECT_BOX
from ..geometry.derived import arrays_of, derived
from ..geometry.mesh import Mesh
from ..geometry.movers import VERTEX_AXES
from ..geometry.native_meshes import make_native_mesh
from ..geometry.twins import put_arrays
from ..geometry.values import put_values

_MOST_COLUMNS = 8  # that C numbers in one call
_rests: WeakKeyDictionary[Mesh, tuple[dict[str, Any], NativeRest]] = WeakKeyDictionary()


class PosedMesh:
    """A mesh with a pose of joints and morph weights.

    Attributes
    ----------
    mesh : Mesh
        The mesh at rest.
    native : NativePose
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._made_of: dict[str, Any] = {}
        self._version = -1  # the mesh's version when its arrays were last checked
        self._now: tuple[NativeMesh, Mesh] | None = None
        self.renew()

    def renew(self) -> bool:
        """Rebuild the pose if the mesh's arrays have changed; return whether they have."""
        version = self.mesh.version
        if version == self._version:
            return False
        arrays = arrays_of(self.mesh)
        self._version = version
        if _same(arrays, self._made_of):
            return False
        self._made_of = arrays
        before = getattr(self, "native", None)
        self.native = NativePose(_rest_of(self.mesh, arrays), bool(before and before.face_normals))
        if before and before.has_edges:  # whoever drew them may not ask again
            self.native.want_edges(derived(self.mesh, "edges", arrays))
        return True

    @property
    def arrays(self) -> dict[str, Any]:
        """The mesh's arrays that the pose was made from."""
        return self._made_of

    def handle(self, face_normals: bool, edges: bool, threads: int) -> NativeMesh:
        """Return the handle to draw, with the derived arrays that a picture reads."""
        native = self.native
        if face_normals and not native.face_normals:
            native.want_face_normals()
        if native.current is None:
            pose_meshes([native], None, threads)
        if edges:
            native.want_edges(derived(self.mesh, "edges", self._made_of))
        return native.current

    def box(self) -> np.ndarray:
        """Return the box of the vertices as posed, (OBJECT_BOX,)."""
        box = np.empty(OBJECT_BOX)
        self.native.copy_box(box)
        return box

    def now(self) -> Mesh:
        """Return a mesh with the deformed vertices; the same object until they move."""
        current = self.native.current
        if current is None:
            pose_meshes([self.native], None, 1)
            current = self.native.current
        if self._now is None or self._now[0] is not current:
            self._now = current, self._copied()
        return self._now[1]

    def _copied(self) -> Mesh:
        positions = np.empty((len(self.mesh.positions), 3), np.float32)
        normals = np.empty_like(positions)
        tangents = self._made_of.get("tangents")
        tangents = None if tangents is None else np.empty_like(tangents)
        self.native.copy_vertices(positions, normals, tangents)
        copy = Mesh(positions, name=self.mesh.name)
        gone = dict.fromkeys(VERTEX_AXES)
        put_arrays(copy, {**self._made_of, **gone, "positions": copy.positions})
        copy.normals, copy.tangents = normals, tangents
        copy.materials = self.mesh.materials
        put_values(copy, self.mesh.values)
        return copy


def _same(some: dict[str, Any], others: dict[str, Any]) -> bool:
    return some.keys() == others.keys() and all(map(operator.is_, some.values(), others.values()))


def _rest_of(mesh: Mesh, arrays: dict[str, Any]) -> NativeRest:
    """Return the data of a mesh at rest, which all meshes posed from it share."""
    made_of, rest = _rests.get(mesh, ({}, None))
    if rest is None or not _same(arrays, made_of):
        native = make_native_mesh(arrays, 0, _movers_of(arrays))
        rest = NativeRest(
            native,
            derived(mesh, "normals", arrays),
            arrays.get("tangents"),
            arrays.get("joints"),
            arrays.get("weights"),
            arrays.get("morph_positions"),
            arrays.get("morph_normals"),
            arrays.get("morph_tangents"),
        )
        _rests[mesh] = arrays, rest
    return rest


def _movers_of(arrays: dict[str, Any]) -> np.ndarray:
    """Number the vertices such that vertices with the same joints and weights get one number."""
    count = len(arrays["positions"])
    rows = []
    if arrays.get("joints") is not None:
        rows += [arrays["joints"].astype(np.uint32), arrays["weights"].view(np.uint32)]
    if arrays.get("morph_positions") is not None:
        offsets = arrays["morph_positions"].transpose(1, 0, 2).reshape(count, -1)
        rows.append(np.ascontiguousarray(offsets).view(np.uint32))
    if not rows or count == 0:
        return np.zeros(count, np.int32)
    return _number_rows(np.hstack(rows))


def _number_rows(rows: np.ndarray) -> np.ndarray:
    """Number rows of uint32, equal rows alike; number the parts of wide rows first."""
    if rows.shape[1] <= _MOST_COLUMNS:
        return native_loaders.number_rows(np.ascontiguousarray(rows), False)[0]
    starts = range(0, rows.shape[1], _MOST_COLUMNS)
    parts = [_number_rows(rows[:, start : start + _MOST_COLUMNS]) for start in starts]
    return _number_rows(np.stack(parts, axis=1).astype(np.uint32))
