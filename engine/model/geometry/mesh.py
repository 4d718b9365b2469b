"""Meshes: vertices, triangles, lines and points, with their materials.

A `Mesh` checks its arguments once, keeps them as read-only C-contiguous arrays with fixed dtypes,
and derives normals, edges and polygons on demand. No index is ever out of range. Every assignment
raises ``version``, so the renderer knows to rebuild its own data. Conventions: object space,
right-handed; front faces are counter-clockwise; texture coordinates have their origin at the bottom
left.
"""

from __future__ import annotations

import copy
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, BinaryIO, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import exchange, frozen
from ...base.calls import checks_types
from ...base.checked_containers import CheckedList
from ...base.dirty_tracking import renew
from ...base.notebook_pictures import ShownInNotebooks
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
from .values import MeshValues, Values, check_values, drop_misfits, put_values
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


class Mesh(ShownInNotebooks, Closed):
    """Triangles, lines and points over one list of vertices.

    Parameters
    ----------
    positions : (V, 3) float
        Vertices in object space. Non-finite ones give a warning; primitives that use them are not
        drawn.
    faces : (F, 3) int, optional
        Vertex indices of the triangles.
    normals : (V, 3) float, optional
        Vertex normals; computed if left out.
    uvs : (V, 2) float, optional
        Texture coordinates, (0, 0) at the image's bottom left.
    uvs1 : (V, 2) float, optional
        A second set, for textures that use it.
    tangents : (V, 4) float, optional
        The tangent (the normal map's right) and 1 or -1: the bitangent (its up) is this sign times
        ``cross(normal, tangent)``.
    colors : (V, 3) or (V, 4) int or float, or V colours, optional
        Vertex colours, display values: integers 0..255 or floats 0..1, unless they are marked as
        `linear`; or a list of names and other colours. Integers that are all 0 or 1 mean 0.0 and
        1.0, unless they are ``uint8``. Alpha is opaque if left out. Floats are kept as linear
        light, and marked so.
    materials : list of Material, optional
        One default material if left out.
    material_ids : (F,) int, optional
        The material of each face; all zero if left out.
    lines : (L, 2) int, optional
        Vertex indices of line segments.
    points : (P,) int, optional
        Vertex indices of points.
    edge_visible : (F, 3) bool, optional
        Whether the edge from vertex k to vertex (k + 1) % 3 of a face is an edge of the model;
        False for the diagonals of polygons. By default, all are.
    position_ids : (V,) int, optional
        Vertices with the same number are one point of the surface, split for another attribute such
        as a texture seam. Computed normals and edges treat them as one.
    joints : (V, N) int, optional
        The joints that move a vertex, as indices into the `Skin` of the mesh's node.
    weights : (V, N) float, optional
        The weight of each joint: not negative, and not all 0 for a vertex. Rows are normalised to a
        sum of 1.
    morph_targets : iterable of MorphTarget, optional
        Offsets that a node adds to the vertices, each times its weight in ``node.morph_weights``.
    crease_angle : float
        Radians, 0 to pi: computed normals make an edge sharp if its triangles meet at a greater
        angle. Pi, the default, keeps every edge smooth; loaders use 35 degrees. Meshes with joints
        or morph targets ignore it and are smooth.
    name : str

    Attributes
    ----------
    positions, faces, normals, uvs, uvs1, tangents, colors, material_ids, lines, points
    edge_visible, position_ids
        As above, read-only: float32, int32, uint8 or bool. Assign to replace one; lengths must
        still match.
    joints : (V, N) uint16 or None
    weights : (V, N) float32 or None
        Read-only; `set_influences` replaces both.
    morph_targets : tuple of MorphTarget
    crease_angle : float
    materials : list of Material
    groups : dict of str to (N,) int32
        Face indices of named parts; emptied when the number of faces changes.
    values : dict of str to (N,) or (N, K) number
        Numbers of the vertices, faces or points by name, such as temperatures.
        Pictures show them by ``color_by``. They are dropped when the number of their elements
        changes.
    warnings : list of str
        The loader's warnings: what it omitted or replaced.
    version : int

    Raises
    ------
    InvalidArgumentError
        A shape, type or length is wrong, or an index is out of range.
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
    _values: MeshValues
    _FORGOTTEN = ("_derived", "_origin")
    # The UV set that tangents are computed from when the mesh is drawn without any, or None.
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
        put_values(self, {})
        self.warnings = []
        self._arrays: dict[str, np.ndarray | None] = dict.fromkeys(_movers.VERTEX_AXES)
        self._morph_targets = ()
        # Each with the arrays it was computed from.
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
        """Joint indices, (V, N) uint16, or None."""
        return self._arrays.get("joints")

    @property
    def weights(self) -> NDArray[np.float32] | None:
        """Joint weights, (V, N) float32, whose rows sum to 1, or None."""
        return self._arrays.get("weights")

    def set_influences(self, joints: ArrayLike | None, weights: ArrayLike | None) -> None:
        """Set the joints of each vertex and their weights; None removes both.

        Parameters
        ----------
        joints : (V, N) int
        weights : (V, N) float
            As in the constructor.

        Raises
        ------
        InvalidArgumentError
            Shapes do not match, a joint is not below 65536, a weight is negative or not finite, or
            all weights of a vertex are 0.
        """
        self._put(_movers.check_influences(joints, weights, len(self.positions)))

    @property
    def morph_targets(self) -> tuple[MorphTarget, ...]:
        """The morph targets, in the order of their weights; assignable at any time."""
        return self._morph_targets

    @morph_targets.setter
    def morph_targets(self, value: Iterable[MorphTarget]) -> None:
        targets = _movers.check_targets(value, len(self.positions))
        stacks = _movers.stacked(targets, len(self.positions))
        self._morph_targets = targets
        self._put(stacks)

    @property
    def normals(self) -> NDArray[np.float32]:
        """Vertex normals (V, 3) float32: the given ones, or else angle-weighted, computed once.

        Computed normals ignore creases; `with_creases` returns the normals that are drawn.
        """
        return derived(self, "normals")

    @normals.setter
    def normals(self, value: ArrayLike | None) -> None:
        self._given_normals = value

    @property
    def has_normals(self) -> bool:
        """Whether normals were given; if False, they are computed."""
        return self._given_normals is not None

    @property
    def crease_angle(self) -> float:
        """Crease angle in radians: where normals are computed, edges above it are drawn sharp."""
        return self._crease_angle

    @crease_angle.setter
    def crease_angle(self, value: float) -> None:
        self._crease_angle = check_crease_angle(value)
        self._changed()

    @property
    def face_normals(self) -> NDArray[np.float32]:
        """One unit normal per face, (F, 3) float32; all triangles of a polygon share one."""
        return derived(self, "face_normals")

    @property
    def polygons(self) -> NDArray[np.int32]:
        """The polygon of each face, (F,) int32 from 0 on, never decreasing.

        Consecutive triangles that share an edge hidden in both form one polygon.
        """
        return derived(self, "polygons")

    def edges(self) -> NDArray[np.int32]:
        """Return each visible edge of the faces once: (E, 2) int32 vertex indices.

        An edge is visible if any face shows it. Edges are in order of first appearance; vertices
        with the same position ID count as one.
        """
        return derived(self, "edges")

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Minimum and maximum of the finite coordinates, (2, 3) float64; zeros without any."""
        return derived(self, "bounds")

    @property
    def materials(self) -> list[Material]:
        """The materials that ``material_ids`` index; at least one.

        The list can be changed in place, as long as every face keeps a material: change
        ``material_ids`` first.
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
        """Face indices of the named parts, each (N,) int32."""
        return self._groups

    @groups.setter
    def groups(self, value: Mapping[str, ArrayLike]) -> None:
        put_groups(self, check_groups(value, len(self.faces)))

    @property
    def values(self) -> MeshValues:
        """Numbers of the vertices, faces or points by name, each (N,) or (N, K), read-only.

        ``mesh.values["t"] = array`` copies the array; its length tells what it belongs to, and
        ``mesh.values.on("t")`` returns that. Where the length fits several kinds of elements,
        assign ``Values(array, on="faces")``; a name that exists keeps its kind if it fits.
        """
        return self._values

    @values.setter
    def values(self, value: Mapping[str, ArrayLike | Values]) -> None:
        put_values(self, check_values(self, value))
        self._origin = None
        renew(self)

    @classmethod
    @checks_types
    def concatenate(
        cls,
        meshes: Iterable[Mesh],
        name: str = "",
        *,
        poses: Iterable[ArrayLike | Sequence[ArrayLike]] | None = None,
    ) -> Mesh:
        """Return one mesh that holds several meshes, in their order.

        Attributes that only some meshes have are filled in: computed normals, zero texture
        coordinates, white vertex colours, NaN for ``values``. Equal material objects are kept once.
        One mesh draws faster than many small ones; for copies of one mesh use `InstancedMesh`.

        Parameters
        ----------
        meshes : iterable of Mesh
            A mesh may occur more than once.
        name : str
        poses : iterable, optional
            The pose of each mesh: a 4x4 matrix, or translation (3,), rotation (quaternion x, y, z,
            w) and scale (a number or (3,)). Normals are transformed by the inverse transpose; a
            mirroring pose reverses the faces, so that their fronts stay outside.

        Raises
        ------
        InvalidArgumentError
            An item is not a mesh, a pose is not affine, or the numbers of poses and meshes differ.
        """
        from ._concatenation import concatenate, placed

        if not isinstance(meshes, Iterable):
            raise InvalidArgumentError(f"meshes must be several Mesh, not {meshes!r}")
        meshes = list(meshes)
        if poses is not None:
            meshes = placed(cls, meshes, poses)
        return concatenate(cls, meshes, name)

    @classmethod
    @checks_types
    def from_polygons(
        cls,
        positions: ArrayLike,
        polygons: Iterable[ArrayLike],
        *,
        normals: ArrayLike | None = None,
        uvs: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        materials: Iterable[Material] | None = None,
        material_ids: ArrayLike | None = None,
        name: str = "",
    ) -> Mesh:
        """Return a mesh of polygons, which are cut into triangles as those of files are.

        Parameters
        ----------
        positions : (V, 3) float
        polygons : iterable of (N,) int
            The vertex indices of each polygon, three or more, counter-clockwise as seen from its
            front. It may be concave, but has no holes.
        normals, uvs, colors, materials, name
            As in the constructor: for each vertex.
        material_ids : (P,) int, optional
            The material of each polygon.

        Returns
        -------
        mesh : Mesh
            Its ``edge_visible`` hides the diagonals, and `polygons` numbers the polygons.

        Raises
        ------
        InvalidArgumentError
            A polygon has less than three corners, or an index is out of range.
        """
        from ._polygons import mesh_of_polygons

        attributes = {"normals": normals, "uvs": uvs, "colors": colors, "materials": materials}
        mesh = mesh_of_polygons(cls, positions, polygons, material_ids, attributes)
        mesh.name = text(name, "name")
        return mesh

    def copy(self) -> Mesh:
        """Return a mesh that shows the same, and can be changed without changing this one.

        Its materials are copies, too; textures and morph targets are shared, as are the read-only
        arrays, so that a copy takes no memory for them.
        """
        made = copy.copy(self)
        made.materials = [copy.copy(material) for material in self.materials]
        made.warnings = list(self.warnings)
        return made

    @checks_types
    def transformed(self, matrix: ArrayLike) -> Mesh:
        """Return a mesh whose vertices are moved by a matrix; this one stays as it is.

        Parameters
        ----------
        matrix : (4, 4) float
            Affine, such as a node's ``pose``. Normals are turned by its inverse transpose; if it
            mirrors, faces are reversed, so that their fronts stay outside.

        Returns
        -------
        mesh : Mesh
            With the same materials, not copies.

        Raises
        ------
        InvalidArgumentError
            The matrix is not affine or has no inverse, or the mesh has joints or morph targets,
            which move with their nodes: set the pose of these instead.
        """
        from ._placing import transformed_mesh

        return transformed_mesh(self, matrix)

    def with_creases(self) -> Mesh:
        """Return the mesh with the normals it is drawn with, by its ``crease_angle``.

        Returns
        -------
        mesh : Mesh
            Faces in the same order; vertices are split where triangles meet at more than the angle,
            and added behind the others. Returns the mesh itself if it has normals, joints or morph
            targets, or if its angle is pi.

        Notes
        -----
        Triangles around a point that share smooth edges get one normal there: the sum of their
        normals, weighted by their angles at the point. Vertices with exactly the same coordinates
        are one point. Neighbours with opposite winding are no crease; they get opposite normals.
        """
        return mesh_with_creases(self)

    @checks_types
    def with_tangents(self, uv_set: int = 0) -> Mesh:
        """Return the mesh with tangents computed from normals and texture coordinates.

        Parameters
        ----------
        uv_set : {0, 1}
            The set that the normal map uses, ``uvs`` or ``uvs1``.

        Returns
        -------
        mesh : Mesh
            Faces in the same order; vertices are split where the texture is mirrored, or its
            direction is ambiguous.

        Raises
        ------
        InvalidArgumentError
            The mesh lacks these texture coordinates.

        Notes
        -----
        Method: M. Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008 (MikkTSpace), for
        which normal maps are baked. Without tangents, each face uses its own direction.
        """
        from ._tangents import mesh_with_tangents

        return mesh_with_tangents(self, uv_set)

    @classmethod
    def from_trimesh(cls, geometry: Any) -> Mesh:
        """Return a mesh converted from a trimesh object.

        Parameters
        ----------
        geometry : trimesh.Trimesh, PointCloud, Path3D, VoxelGrid or Scene
            The parts of a scene are joined, each at its pose.

        Returns
        -------
        mesh : Mesh
            With texture coordinates, colours, materials and textures. Normals only if the geometry
            was given some.

        Raises
        ------
        InvalidArgumentError
            The object is none of these.
        """
        from ...io.trimesh_conversion import mesh_from_trimesh

        return mesh_from_trimesh(geometry)

    def to_trimesh(self) -> Any:
        """Return the mesh as a trimesh object; the package trimesh must be installed.

        Returns
        -------
        geometry : trimesh.Trimesh, PointCloud or Scene
            A point cloud if there are no faces; a scene of one geometry for each material if faces
            have several. Lines are left out.

        Raises
        ------
        ImportError
            trimesh is not installed: ``pip install engine3d[formats]``.
        """
        from ...io.trimesh_conversion import mesh_to_trimesh

        return mesh_to_trimesh(self)

    @checks_types
    def save(
        self, path: str | os.PathLike[str] | BinaryIO, *, format: str | None = None, **options: Any
    ) -> None:
        """Write the mesh to a file; see `save_mesh` for parameters and exceptions."""
        from ...io.writers import save_mesh

        save_mesh(self, path, format=format, **options)

    def __setstate__(self, state: dict[str, Any]) -> None:
        values = state["_values"]
        super().__setstate__({**state, "_derived": {}, "_values": {}})
        self._arrays.update({name: own(array) for name, array in self._arrays.items()})
        self._values = values
        own_containers(self)

    def __repr__(self) -> str:
        parts = [f"{len(self.positions)} vertices", f"{len(self.faces)} faces"]
        parts += [f"{len(self.lines)} lines"] if len(self.lines) else []
        parts += [f"{len(self.points)} points"] if len(self.points) else []
        return f"Mesh({', '.join(parts)}, name={self.name!r})"

    def _replace(self, what: str, array: Any) -> None:
        """Check an array against the mesh's others, and replace it."""
        while True:  # until nothing is assigned between the check and the replacement
            others = dict(self._arrays)
            check_fit(self, what, array, others)
            fresh = {what: array}
            ids = others.get("material_ids")
            anew = what == "faces" and (ids is None or len(ids) != len(array))
            if anew:  # untouched zero pages are never allocated
                zeros = frozen(np.zeros(len(array), np.int32))
                fresh["material_ids"] = check_indices(zeros, "material_ids")
            if exchange(self._arrays, others, fresh):
                break
        if anew:
            put_groups(self, {})
        if self._values:
            drop_misfits(self)
        self._changed()

    def _put(self, fresh: dict[str, Any]) -> None:
        """Replace several arrays at once, each with a row for each vertex."""
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
        self._derived = {}  # twins keep theirs
        renew(self)


def own_containers(mesh: Mesh) -> None:
    """Replace plain lists and dicts, set by copies and the editor, with the mesh's own types."""
    mesh._materials = CheckedList(mesh, _take_materials, mesh._materials)
    put_groups(mesh, mesh._groups)
    put_values(mesh, mesh._values)


def _take_materials(mesh: Mesh, materials: list[Any], put: Callable[[list[Any]], None]) -> None:
    """Replace the content of a mesh's own list of materials."""
    if not materials:
        raise InvalidArgumentError(
            f"{mesh!r} needs a material: replace them all at once, materials[:] = [...]"
        )
    materials = _check_materials(materials)
    _require_used(mesh, len(materials))
    put(materials)
    renew(mesh)


def _require_used(mesh: Mesh, count: int) -> None:
    """Raise if a face refers to a material beyond the given count."""
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
