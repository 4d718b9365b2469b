"""Geometry: vertices, triangles, lines and points, with the materials they are drawn with.

A `Mesh` checks what it is given once, keeps it as read-only C-contiguous arrays of fixed types, and
derives normals, edges and polygons on demand. Nothing ever holds an index out of range. Every
assignment raises ``version``, which tells the renderer to renew what it made of the mesh.
Conventions: object space, right-handed, counter-clockwise faces are seen from their front, texture
coordinates have their origin at the bottom left.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, BinaryIO, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import exchange, frozen
from ...base.calls import checks_types
from ...base.checked_containers import CheckedList
from ...base.dirty_tracking import renew
from ...base.numbers import shown
from ...base.validation import Closed, own, text
from ...errors import InvalidArgumentError
from ..materials.material import Material
from . import movers as _movers
from ._arrays import (
    ArrayAttribute,
    check_colors,
    check_flags3,
    check_groups,
    check_indices,
    check_pairs,
    check_positions,
    check_triples,
    check_vectors2,
    check_vectors3,
    check_vectors4,
    require_range,
)
from ._fitting import check_fit
from .creases import SMOOTH, check_crease_angle, mesh_with_creases
from .derived import derived
from .groups import put_groups
from .morph_targets import MorphTarget
from .vertex_attributes import VertexAttribute

_Floats: TypeAlias = ArrayAttribute[ArrayLike, NDArray[np.float32]]
_Integers: TypeAlias = ArrayAttribute[ArrayLike, NDArray[np.int32]]
_OptionalFloats: TypeAlias = ArrayAttribute[ArrayLike | None, NDArray[np.float32] | None]
_OptionalIntegers: TypeAlias = ArrayAttribute[ArrayLike | None, NDArray[np.int32] | None]
_OptionalFlags: TypeAlias = ArrayAttribute[ArrayLike | None, NDArray[np.bool_] | None]
_VertexFloats: TypeAlias = VertexAttribute[ArrayLike | None, NDArray[np.float32] | None]
_VertexColors: TypeAlias = VertexAttribute[
    ArrayLike | None, NDArray[np.uint8] | NDArray[np.float32] | None
]


class Mesh(Closed):
    """Triangles, lines and points over one list of vertices.

    Parameters
    ----------
    positions : (V, 3) float
        Vertices in object space. Not-finite ones are allowed, with a warning; what uses them is not
        drawn.
    faces : (F, 3) int, optional
        Vertex indices of the triangles.
    normals : (V, 3) float, optional
        Vertex normals; without them they are computed.
    uvs : (V, 2) float, optional
        Texture coordinates, (0, 0) at the image's bottom left.
    uvs1 : (V, 2) float, optional
        A second set of them, for the textures that name it.
    tangents : (V, 4) float, optional
        Which way is right in the image of normal maps, and 1 or -1: up is this times
        ``cross(normal, tangent)``.
    colors : (V, 3) or (V, 4) int or float, optional
        Vertex colours: integers 0..255 are sRGB, floats are linear light; integers that are all 0
        or 1 mean 0.0 and 1.0, unless they are ``uint8``. Alpha is opaque if left out.
    materials : list of Material, optional
        One default material if left out.
    material_ids : (F,) int, optional
        The material of each face; all zero if left out.
    lines : (L, 2) int, optional
        Vertex indices of line segments.
    points : (P,) int, optional
        Vertex indices of points.
    edge_visible : (F, 3) bool, optional
        Whether the edge from vertex k to vertex (k + 1) % 3 of a face is one of the model's edges;
        False for the diagonals of polygons. All are if left out.
    position_ids : (V,) int, optional
        Vertices with the same number are one point of the surface that was split for another
        attribute, such as a texture seam. Computed normals and the edges respect it.
    joints : (V, N) int, optional
        The joints that move a vertex, as numbers in the `Skin` of the node that shows the mesh.
    weights : (V, N) float, optional
        How much each of them does: not negative; of each vertex one is not 0. They are kept as
        shares of their sum.
    morph_targets : iterable of MorphTarget, optional
        What nodes may add to the vertices, each times a weight of ``node.morph_weights``.
    crease_angle : float
        Radians, 0 to pi: where normals are computed, an edge whose triangles meet at more than this
        is drawn sharp. Pi, the usual value, makes all smooth; loaders take 35 degrees. It is of no
        effect on meshes with joints or morph targets, which are smooth.
    name : str

    Attributes
    ----------
    positions, faces, normals, uvs, uvs1, tangents, colors, material_ids, lines, points
    edge_visible, position_ids
        As above, read-only: float32, int32, uint8 or bool. Assigning replaces one; arrays that go
        together must keep matching lengths.
    joints : (V, N) uint16 or None
    weights : (V, N) float32 or None
        Read-only; `set_influences` replaces both.
    morph_targets : tuple of MorphTarget
    crease_angle : float
    materials : list of Material
    groups : dict of str to (N,) int32
        Face indices of named parts; none once the number of faces changes.
    warnings : list of str
        What the loader left out or replaced.
    version : int

    Raises
    ------
    InvalidArgumentError
        A wrong shape or type, lengths that do not match, an index out of range.
    """

    name: str
    version: int
    warnings: list[str]
    positions: _Floats = ArrayAttribute(check_positions)
    faces: _Integers = ArrayAttribute(check_triples)
    uvs: _VertexFloats = VertexAttribute(check_vectors2, fill=0)
    uvs1: _VertexFloats = VertexAttribute(check_vectors2, fill=0)
    tangents: _VertexFloats = VertexAttribute(check_vectors4, fill=0)
    colors: _VertexColors = VertexAttribute(check_colors, fill=1)
    material_ids: _Integers = ArrayAttribute(check_indices)
    lines: _Integers = ArrayAttribute(check_pairs)
    points: _Integers = ArrayAttribute(check_indices)
    edge_visible: _OptionalFlags = ArrayAttribute(check_flags3, optional=True)
    position_ids: _OptionalIntegers = ArrayAttribute(check_indices, optional=True)
    _given_normals: _OptionalFloats = ArrayAttribute(check_vectors3, optional=True)
    _crease_angle: float = SMOOTH
    _origin: Any = None  # see origins.py
    _morph_targets: tuple[MorphTarget, ...] = ()
    _groups: dict[str, NDArray[np.int32]]
    _FORGOTTEN = ("_derived", "_origin")
    # The set of coordinates by which tangents are found when it is drawn without any, or None.
    _tangent_uv_set: int | None = None

    def __init__(
        self,
        positions: ArrayLike,
        faces: ArrayLike | None = None,
        *,
        normals: ArrayLike | None = None,
        uvs: ArrayLike | None = None,
        uvs1: ArrayLike | None = None,
        tangents: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        materials: Iterable[Material] | None = None,
        material_ids: ArrayLike | None = None,
        lines: ArrayLike | None = None,
        points: ArrayLike | None = None,
        edge_visible: ArrayLike | None = None,
        position_ids: ArrayLike | None = None,
        joints: ArrayLike | None = None,
        weights: ArrayLike | None = None,
        morph_targets: Iterable[MorphTarget] | None = None,
        crease_angle: float = SMOOTH,
        name: str = "",
    ) -> None:
        self.name = text(name, "name")
        put_groups(self, {})
        self._scalars: dict[str, NDArray[np.number]] = {}
        self.warnings = []
        self._arrays: dict[str, np.ndarray | None] = dict.fromkeys(_movers.VERTEX_AXES)
        self._morph_targets = ()
        # With what each was computed from.
        self._derived: dict[str, tuple[list[Any], np.ndarray]] = {}
        self._materials = CheckedList(self, _take_materials, _check_materials(materials))
        self._crease_angle = check_crease_angle(crease_angle)
        self.positions = positions
        self.faces = () if faces is None else faces
        self.lines = () if lines is None else lines
        self.points = () if points is None else points
        if material_ids is not None:
            self.material_ids = material_ids
        self._given_normals = normals
        self.uvs = uvs
        self.uvs1 = uvs1
        self.tangents = tangents
        self.colors = colors
        self.edge_visible = edge_visible
        self.position_ids = position_ids
        if joints is not None or weights is not None:
            self.set_influences(joints, weights)
        if morph_targets is not None:
            self.morph_targets = morph_targets

    @property
    def joints(self) -> NDArray[np.uint16] | None:
        """(V, N) uint16, or None."""
        return self._arrays.get("joints")

    @property
    def weights(self) -> NDArray[np.float32] | None:
        """(V, N) float32, whose rows sum to 1, or None."""
        return self._arrays.get("weights")

    def set_influences(self, joints: ArrayLike | None, weights: ArrayLike | None) -> None:
        """Say which joints move each vertex, and how much; None takes both away.

        Parameters
        ----------
        joints : (V, N) int
        weights : (V, N) float
            As in the constructor.

        Raises
        ------
        InvalidArgumentError
            Shapes do not match, a joint is no number below 65536, a weight is negative or not
            finite, or a vertex has none.
        """
        self._put(_movers.check_influences(joints, weights, len(self.positions)))

    @property
    def morph_targets(self) -> tuple[MorphTarget, ...]:
        """What may be added to the vertices, in the order of the weights; assign at any time."""
        return self._morph_targets

    @morph_targets.setter
    def morph_targets(self, value: Iterable[MorphTarget]) -> None:
        targets = _movers.check_targets(value, len(self.positions))
        stacks = _movers.stacked(targets, len(self.positions))
        self._morph_targets = targets
        self._put(stacks)

    @property
    def normals(self) -> NDArray[np.float32]:
        """Vertex normals (V, 3) float32: the given ones, or angle-weighted ones, computed once.

        Computed ones are smooth over all creases: `with_creases` has those that are drawn.
        """
        return derived(self, "normals")

    @normals.setter
    def normals(self, value: ArrayLike | None) -> None:
        self._given_normals = value

    @property
    def has_normals(self) -> bool:
        """Whether normals were given; False means that they are computed."""
        return self._given_normals is not None

    @property
    def crease_angle(self) -> float:
        """Radians; where normals are computed, edges sharper than this are drawn sharp."""
        return self._crease_angle

    @crease_angle.setter
    def crease_angle(self, value: float) -> None:
        self._crease_angle = check_crease_angle(value)
        self._changed()

    @property
    def face_normals(self) -> NDArray[np.float32]:
        """One unit normal per face, (F, 3) float32, the same for all triangles of a polygon."""
        return derived(self, "face_normals")

    @property
    def polygons(self) -> NDArray[np.int32]:
        """The polygon that each face is part of, (F,) int32 from 0 on, never decreasing.

        Triangles that stand one after the other and share an edge hidden in both are one polygon.
        """
        return derived(self, "polygons")

    def edges(self) -> NDArray[np.int32]:
        """Return the visible edges of the faces, each once: (E, 2) int32 vertex indices.

        An edge counts as visible if it is visible in any face. They stand in the order of their
        first appearance; vertices with the same position id count as one.
        """
        return derived(self, "edges")

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Smallest and largest finite coordinates, (2, 3) float64; zeros if there are none."""
        return derived(self, "bounds")

    @property
    def materials(self) -> list[Material]:
        """The materials that ``material_ids`` refer to; at least one.

        The list may be changed in place, but never so that a face has no material left: give
        ``material_ids`` others first.
        """
        return self._materials

    @materials.setter
    def materials(self, value: Iterable[Material] | None) -> None:
        materials = _check_materials(value)
        _require_used(self, len(materials))
        self._materials = CheckedList(self, _take_materials, materials)
        renew(self)

    @property
    def groups(self) -> dict[str, NDArray[np.int32]]:
        """Face indices of named parts, each (N,) int32."""
        return self._groups

    @groups.setter
    def groups(self, value: Mapping[str, ArrayLike]) -> None:
        put_groups(self, check_groups(value, len(self.faces)))

    @classmethod
    @checks_types
    def concatenate(
        cls,
        meshes: Iterable[Mesh],
        name: str = "",
        *,
        poses: Iterable[ArrayLike | Sequence[ArrayLike]] | None = None,
    ) -> Mesh:
        """Return one mesh that holds everything of several, in their order.

        What only some of them have is filled in: computed normals, zero texture coordinates,
        white vertex colours. Materials that are the same object are kept once. One mesh is drawn
        faster than many small ones; `InstancedMesh` is for copies of the same.

        Parameters
        ----------
        meshes : iterable of Mesh
            One may be there many times.
        name : str
        poses : iterable, optional
            Where each mesh goes: a 4x4 matrix, or translation (3,), rotation (quaternion x, y, z,
            w) and scale (a number or (3,)). Normals are transformed by the inverse transpose; a
            pose that mirrors turns the faces over, so that their fronts stay outside.

        Raises
        ------
        InvalidArgumentError
            One is no mesh, a pose is not affine, or there are not as many poses as meshes.
        """
        from ._concatenation import concatenate, placed

        if not isinstance(meshes, Iterable):
            raise InvalidArgumentError(f"meshes must be several Mesh, not {meshes!r}")
        meshes = list(meshes)
        if poses is not None:
            meshes = placed(cls, meshes, poses)
        return concatenate(cls, meshes, name)

    def with_creases(self) -> Mesh:
        """Return the mesh with the normals that it is drawn with, by its ``crease_angle``.

        Returns
        -------
        mesh : Mesh
            Faces in the same order; vertices are split where triangles meet at more than the angle,
            the added ones behind the others. The mesh itself if it has normals, if its angle is
            pi, or if it has joints or morph targets.

        Notes
        -----
        Method: triangles round a point that share an edge that is no crease have one normal there,
        the sum of theirs weighted by their angles at the point. Points are what has exactly the
        same coordinates. Triangles that are turned against each other, which is no crease, get
        opposite normals.
        """
        return mesh_with_creases(self)

    @checks_types
    def with_tangents(self, uv_set: int = 0) -> Mesh:
        """Return the mesh with tangents computed from normals and texture coordinates.

        Parameters
        ----------
        uv_set : {0, 1}
            Of ``uvs`` or ``uvs1``: those of the normal map.

        Returns
        -------
        mesh : Mesh
            Faces in the same order; vertices are split where the image is mirrored, or goes two
            ways.

        Raises
        ------
        InvalidArgumentError
            There are no such texture coordinates.

        Notes
        -----
        Method: M. Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008, which normal maps are
        baked for (MikkTSpace). Without tangents, faces use a direction of their own.
        """
        from ._tangents import mesh_with_tangents

        return mesh_with_tangents(self, uv_set)

    @classmethod
    def from_trimesh(cls, geometry: Any) -> Mesh:
        """Return the mesh of what the package trimesh holds.

        Parameters
        ----------
        geometry : trimesh.Trimesh, PointCloud, Path3D or Scene
            The parts of a scene are joined, each at its place.

        Returns
        -------
        mesh : Mesh
            With texture coordinates, colours, materials and textures. Normals only if the geometry
            was given some.

        Raises
        ------
        InvalidArgumentError
            It is none of these.
        """
        from ...io.trimesh_conversion import mesh_from_trimesh

        return mesh_from_trimesh(geometry)

    def to_trimesh(self) -> Any:
        """Return the mesh for the package trimesh, which must be installed.

        Returns
        -------
        geometry : trimesh.Trimesh, PointCloud or Scene
            A point cloud if there are no faces; a scene of one geometry for each material if faces
            have several. Lines are left out.

        Raises
        ------
        ImportError
            There is no trimesh: ``pip install engine3d[formats]``.
        """
        from ...io.trimesh_conversion import mesh_to_trimesh

        return mesh_to_trimesh(self)

    @checks_types
    def save(
        self, path: str | os.PathLike[str] | BinaryIO, *, format: str | None = None, **options: Any
    ) -> None:
        """Write the mesh to a file; parameters and exceptions of `save_mesh`."""
        from ...io.writers import save_mesh

        save_mesh(self, path, format=format, **options)

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__({**state, "_derived": {}})
        for arrays in (self._arrays, self._scalars):
            arrays.update({name: own(array) for name, array in arrays.items()})
        own_containers(self)

    def _repr_png_(self) -> bytes | None:
        """A picture for notebooks; see `thumbnail`."""
        from ...rendering.thumbnail import thumbnail

        return thumbnail(self)

    def __repr__(self) -> str:
        parts = [f"{len(self.positions)} vertices", f"{len(self.faces)} faces"]
        parts += [f"{len(self.lines)} lines"] if len(self.lines) else []
        parts += [f"{len(self.points)} points"] if len(self.points) else []
        return f"Mesh({', '.join(parts)}, name={self.name!r})"

    def _replace(self, what: str, array: Any) -> None:
        """Check an array against those that are there, and put it in its place."""
        while True:  # until nothing was assigned between the check and this
            others = dict(self._arrays)
            check_fit(self, what, array, others)
            fresh = {what: array}
            ids = others.get("material_ids")
            anew = what == "faces" and (ids is None or len(ids) != len(array))
            if anew:  # pages of zeros that nobody reads never come
                zeros = frozen(np.zeros(len(array), np.int32))
                fresh["material_ids"] = check_indices(zeros, "material_ids")
            if exchange(self._arrays, others, fresh):
                break
        if anew:
            put_groups(self, {})
        self._changed()

    def _put(self, fresh: dict[str, Any]) -> None:
        """Put arrays in their places together, which have a row for each vertex."""
        while True:
            others: dict[str, Any] = dict(self._arrays)
            for what, array in fresh.items():
                rows = None if array is None else array.shape[_movers.VERTEX_AXES[what]]
                if rows not in (None, len(others["positions"])):
                    raise InvalidArgumentError(
                        f"{what} has {rows} rows for {len(others['positions'])} vertices"
                    )
            if exchange(self._arrays, others, fresh):
                break
        self._changed()

    def _changed(self) -> None:
        self._origin = None
        self._derived = {}  # that of twins stays
        renew(self)


def own_containers(mesh: Mesh) -> None:
    """Make plain lists and dicts, which copies and the editor put in, a mesh's own."""
    mesh._materials = CheckedList(mesh, _take_materials, mesh._materials)
    put_groups(mesh, mesh._groups)


def scalars_of(mesh: Mesh) -> dict[str, NDArray[np.number]]:
    """Return what loaders put in: numbers of the vertices, (V,) or (V, N) by name.

    Viewers colour by them.
    """
    return mesh._scalars


def _take_materials(mesh: Mesh, materials: list[Any], put: Callable[[list[Any]], None]) -> None:
    """Let a mesh's own list hold other materials."""
    if not materials:
        raise InvalidArgumentError(
            f"{mesh!r} needs a material: replace them all at once, materials[:] = [...]"
        )
    materials = _check_materials(materials)
    _require_used(mesh, len(materials))
    put(materials)
    renew(mesh)


def _require_used(mesh: Mesh, count: int) -> None:
    """Raise if a face of a mesh refers to no material of so many."""
    if count < len(mesh._materials):
        what = f"material_ids of {mesh!r}"
        require_range(mesh.material_ids, count, what, "materials")


def _check_materials(materials: Iterable[Material] | None) -> list[Material]:
    if isinstance(materials, Material):
        raise InvalidArgumentError("materials must be a list of Material, not one Material")
    if materials is not None and not isinstance(materials, Iterable):
        raise InvalidArgumentError(f"materials must be a list of Material, not {shown(materials)}")
    materials = [] if materials is None else list(materials)
    for material in materials:
        if not isinstance(material, Material):
            raise InvalidArgumentError(f"materials must be Material, not {shown(material)}")
    return materials or [Material()]
