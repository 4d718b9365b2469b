"""Documents, which readers make of files: objects with their meshes, lights, cameras and counts.

These are plain records in the file's own coordinates. Nothing here knows about scenes: whoever
builds one decides what becomes of the lights and cameras.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from ...model.environments.environment import Environment
from ...model.geometry.mesh import Mesh, scalars_of
from ...model.materials.material import Material
from .json_values import JsonValue

if TYPE_CHECKING:
    from ...choices import Interpolation, MotionPath

#: The parts of a node's pose, as keywords of `Scene.add`.
Place: TypeAlias = dict[str, Any]


class DocumentObject(NamedTuple):
    """A named mesh of a file.

    Attributes
    ----------
    name : str
    mesh : Mesh
    pose : (4, 4) float64 or None
        Places the mesh in the document; None if its coordinates are the document's.
    """

    name: str
    mesh: Mesh
    pose: np.ndarray | None = None


@dataclass
class LightRecord:
    """A light of a file.

    Attributes
    ----------
    kind : {"ambient", "point", "directional", "spot"}
    position : tuple of 3 float
    color : tuple of 3 float
        Linear light, 0..1.
    intensity : float
    name : str
    target : tuple of 3 float or None
        The point that a spot light shines at.
    angle : float or None
        Full angle of a spot light's cone, radians.
    """

    kind: str
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    intensity: float = 1.0
    name: str = ""
    target: tuple[float, float, float] | None = None
    angle: float | None = None


@dataclass
class CameraRecord:
    """A camera of a file that stands somewhere by itself.

    Attributes
    ----------
    position, target : tuple of 3 float
    fov : float
        Vertical field of view, radians.
    up : tuple of 3 float
    roll : float
        Turn about the view axis, radians.
    name : str
    """

    position: tuple[float, float, float]
    target: tuple[float, float, float]
    fov: float
    up: tuple[float, float, float] = (0.0, 1.0, 0.0)
    roll: float = 0.0
    name: str = ""


@dataclass
class SceneRecord:
    """The tree of a scene's file; what nodes hold is checked by whoever builds a scene of it.

    Attributes
    ----------
    values : JsonValue
        Background and light.
    materials : list of Material
    meshes : dict of int to Mesh
        Those of the objects that are meshes, by number.
    objects, nodes : list of JsonValue
    places : list of Place
    parents : list of int
        Of each node; -1: none.
    children : dict of int to list of int
        Of each node that has some, in their order.
    environments : list of Environment or None
        None stands for one whose file cannot be read.
    """

    values: JsonValue
    materials: list[Material]
    meshes: dict[int, Mesh]
    objects: list[JsonValue]
    nodes: list[JsonValue]
    places: list[Place]
    parents: list[int]
    children: dict[int, list[int]]
    environments: list[Environment | None] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class MeshRecord:
    """A mesh of a tree, which any number of nodes may show.

    Attributes
    ----------
    name : str
    mesh : Mesh
        With what moves it: joints, weights, morph targets.
    morph_weights : tuple of float
        One for each morph target, where the node says nothing else.
    variants : dict of int to tuple of Material
        What takes the place of the mesh's materials in a variant of `TreeRecord.variants`.
    rest : tuple of MeshRecord
        Further parts of the mesh, which no `Mesh` could hold with the others: what carries other
        vertex attributes, lines and points of another material. All of them have as many morph
        targets; weights and extras are those of the first.
    extras : object
        What the file says besides, as JSON has it; None for nothing.
    """

    name: str
    mesh: Mesh
    morph_weights: tuple[float, ...] = ()
    variants: dict[int, tuple[Material, ...]] = field(default_factory=dict)
    rest: tuple[MeshRecord, ...] = ()
    extras: Any = None

    @property
    def parts(self) -> tuple[MeshRecord, ...]:
        """All parts of the mesh, this one first."""
        return (self, *self.rest)


@dataclass(frozen=True, eq=False)
class SkinRecord:
    """The skin that bends a mesh.

    The vertex of a skinned mesh stands at the sum over its joints of
    ``weight * world(joint) @ inverse_bind @ position``; where the node of the mesh stands changes
    nothing.

    Attributes
    ----------
    name : str
    joints : tuple of int
        Numbers of nodes in the tree.
    inverse_binds : (J, 4, 4) float64
        joint-from-mesh at rest.
    skeleton : int or None
        The node that the file names as their common root; changes nothing.
    extras : object
    """

    name: str
    joints: tuple[int, ...]
    inverse_binds: np.ndarray
    skeleton: int | None = None
    extras: Any = None


@dataclass(frozen=True, eq=False)
class ChannelRecord:
    """How one part of one node changes in time.

    Attributes
    ----------
    node : int
        Its number in the tree.
    path : {"translation", "rotation", "scale", "weights"}
    interpolation : {"step", "linear", "cubicspline"}
    times : (K,) float32
        Seconds, never less than 0, each more than the one before.
    values : (K, N) or (K, 3, N) float32
        N is 3, 4 (quaternions x, y, z, w) or the number of morph targets. Of splines, each key has
        the tangent towards it, the value, and the tangent away from it.
    """

    node: int
    path: MotionPath
    interpolation: Interpolation
    times: np.ndarray
    values: np.ndarray


@dataclass(frozen=True, eq=False)
class PropertyRecord:
    """How a property of something else than a node's pose changes in time.

    Attributes
    ----------
    kind : {"node", "material", "camera", "light"}
    number : int
        In the tree's list of these.
    path : str
        The attribute of what a scene has for it: see `PropertyChannel`.
    interpolation : {"step", "linear", "cubicspline"}
    times : (K,) float32
    values : (K, N) or (K, 3, N) float32
        As of `ChannelRecord`.
    """

    kind: str
    number: int
    path: str
    interpolation: Interpolation
    times: np.ndarray
    values: np.ndarray


@dataclass(frozen=True, eq=False)
class ClipRecord:
    """An animation.

    Attributes
    ----------
    name : str
    duration : float
        The last time of all channels, seconds; all clips begin at 0.
    channels : tuple of ChannelRecord
    extras : object
    properties : tuple of PropertyRecord
    """

    name: str
    duration: float
    channels: tuple[ChannelRecord, ...]
    extras: Any = None
    properties: tuple[PropertyRecord, ...] = ()


@dataclass(frozen=True, eq=False)
class LensRecord:
    """The camera of a node; it stands where its node stands.

    Attributes
    ----------
    kind : {"perspective", "orthographic"}
    name : str
    yfov : float or None
        Vertical field of view of a perspective camera, radians.
    aspect : float or None
        Width over height; None for the picture's own.
    xmag, ymag : float or None
        Half the width and height that an orthographic camera sees.
    znear : float
    zfar : float
        Infinite if the file names none.
    extras : object
    """

    kind: str
    name: str = ""
    yfov: float | None = None
    aspect: float | None = None
    xmag: float | None = None
    ymag: float | None = None
    znear: float = 0.0
    zfar: float = math.inf
    extras: Any = None


@dataclass(frozen=True, eq=False)
class LampRecord:
    """A light that its node places; it shines along the node's -Z.

    Attributes
    ----------
    kind : str
        "directional", "point" or "spot"; a file may have others, which give no light.
    name : str
    color : tuple of 3 float
        Linear light.
    intensity : float
        Lux of directional lights, candela of the others.
    range : float
        Where it ends; infinite if the file names no end.
    inner_cone_angle, outer_cone_angle : float
        Of a spot light: from the axis, radians.
    extras : object
    """

    kind: str
    name: str = ""
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    intensity: float = 1.0
    range: float = math.inf
    inner_cone_angle: float = 0.0
    outer_cone_angle: float = math.pi / 4
    extras: Any = None


@dataclass(frozen=True, eq=False, slots=True)  # a file may have very many
class NodeRecord:
    """A node of a tree; numbers count in the lists of the `TreeRecord`.

    Attributes
    ----------
    name : str
    children : tuple of int
    translation, rotation, scale : tuple of float or None
        As the file has them; None where it leaves them out.
    matrix : (4, 4) float64 or None
        parent-from-node, where the file has it so.
    visible : bool
    mesh, skin, camera, light : int or None
    weights : tuple of float or None
        Of the morph targets, instead of the mesh's.
    instances : (N, 4, 4) float64 or None
        node-from-instance, where the mesh is drawn many times.
    instance_parts : tuple of (N, 3), (N, 4) and (N, 3) or None
        Translations, quaternions and scales, where the file has these poses so.
    instance_colors : (N, 4) float32 or None
        Linear light and alpha.
    extras : object
    """

    name: str = ""
    children: tuple[int, ...] = ()
    translation: tuple[float, ...] | None = None
    rotation: tuple[float, ...] | None = None
    scale: tuple[float, ...] | None = None
    matrix: np.ndarray | None = None
    visible: bool = True
    mesh: int | None = None
    skin: int | None = None
    camera: int | None = None
    light: int | None = None
    weights: tuple[float, ...] | None = None
    instances: np.ndarray | None = None
    instance_parts: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None
    instance_colors: np.ndarray | None = None
    extras: Any = None


@dataclass(frozen=True, eq=False)
class TreeRecord:
    """The tree of a file: its nodes, and what they name, each thing once.

    Attributes
    ----------
    nodes : tuple of NodeRecord
        All of the file, also those that the shown scene does not hold.
    roots : tuple of int
        The nodes that the shown scene begins with.
    meshes : tuple of MeshRecord
    skins : tuple of SkinRecord
    clips : tuple of ClipRecord
    cameras : tuple of LensRecord
    lights : tuple of LampRecord
    materials : tuple of Material
        All of the file.
    made_materials : dict of int to tuple of Material
        All that each of them became: of meshes without normals, say, another than of those with.
    variants : tuple of str
        Names of the sets of materials that one may choose from.
    extras : object
    """

    nodes: tuple[NodeRecord, ...] = ()
    roots: tuple[int, ...] = ()
    meshes: tuple[MeshRecord, ...] = ()
    skins: tuple[SkinRecord, ...] = ()
    clips: tuple[ClipRecord, ...] = ()
    cameras: tuple[LensRecord, ...] = ()
    lights: tuple[LampRecord, ...] = ()
    materials: tuple[Material, ...] = ()
    made_materials: dict[int, tuple[Material, ...]] = field(default_factory=dict)
    variants: tuple[str, ...] = ()
    extras: Any = None

    def parts(self, node: NodeRecord) -> tuple[MeshRecord, ...]:
        """Return the parts of a node's mesh; none if it has no mesh."""
        return () if node.mesh is None else self.meshes[node.mesh].parts


@dataclass
class Document:
    """Everything that a file holds.

    Attributes
    ----------
    format : str
        Name of the format, such as ``"obj"``.
    objects : list of DocumentObject
        ``(name, mesh, pose)``, in the order of the file.
    lights : list of LightRecord
    cameras : list of CameraRecord
    counts : dict
        The lists that the file holds, before any splitting or joining: numbers (``vertices``,
        ``uvs``, ``normals``, ``faces``, ``triangles``, ``lines``, ``points``) and lists of names
        (``objects``, ``groups``, ``materials``).
    warnings : list of str
        What was left out or replaced, one line each.
    scene : SceneRecord or None
        The tree of nodes, of a scene of engine3d; its objects then are what of it shows.
    tree : TreeRecord or None
        The tree of nodes, of another file that holds one; its objects then are what of it shows.
    unit : str
        The symbol of the coordinates' unit, such as ``"mm"``; empty where the format has none.
    arrays : dict of str to list of str
        Names of what ``scalars`` can hold, of ``"vertices"`` and of ``"faces"``.
    up : str
        Which axis is up, by custom, in files of the format: ``"+Y"`` or ``"+Z"``.
    """

    format: str
    objects: list[DocumentObject] = field(default_factory=list)
    lights: list[LightRecord] = field(default_factory=list)
    cameras: list[CameraRecord] = field(default_factory=list)
    counts: dict[str, Any] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    scene: SceneRecord | None = None
    tree: TreeRecord | None = None
    unit: str = ""
    arrays: dict[str, list[str]] = field(default_factory=dict)
    up: str = "+Y"

    @property
    def scalars(self) -> list[dict[str, np.ndarray]]:
        """Numbers of vertices, (V,) or (V, N) by name, of the mesh of each object.

        What has no meaning of its own, if `load_document` was asked for it: properties of PLY
        files, attributes of glTF files whose names begin with ``_``. Of faces, each vertex has the
        numbers of the faces around it.
        """
        return [scalars_of(entry.mesh) for entry in self.objects]
