"""The trees of nodes in documents, by number: of scene files, and of all other files.

They are plain records in the file's own coordinates; the code that builds a scene checks them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ...model.environments.environment import Environment
from ...model.geometry.mesh import Mesh
from ...model.materials.material import Material
from ..reading.json_values import JsonValue

if TYPE_CHECKING:
    from ...choices import Interpolation, MotionPath
    from ...model.motion.joints import JointForm, JointValue

#: The parts of a node's pose, as keywords of `Scene.add`.
Place: TypeAlias = dict[str, Any]


@dataclass
class SceneRecord:
    """The node tree of a scene file; building a scene checks the nodes' objects.

    Attributes
    ----------
    values : JsonValue
        Background and light.
    materials : list of Material
    meshes : dict of int to Mesh
        The objects that are meshes, by number.
    objects, nodes : list of JsonValue
    places : list of Place
    parents : list of int
        The parent of each node; -1: none.
    children : dict of int to list of int
        The children of each node that has some, in order.
    environments : list of Environment or None
        None if its file cannot be read.
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
        The mesh, with joints, weights and morph targets.
    morph_weights : tuple of float
        Default weight of each morph target.
    variants : dict of int to tuple of Material
        The materials that replace the mesh's in a variant of `TreeRecord.variants`.
    rest : tuple of MeshRecord
        Further parts of the mesh, which do not fit into one `Mesh`: with other vertex attributes,
        or lines and points with another material. All have the same number of morph targets;
        weights and extras are those of the first.
    extras : object
        Extra data of the file, as JSON; None for none.
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
    """The skin that deforms a mesh.

    A skinned vertex's position is the sum over its joints of ``weight * world(joint) @ inverse_bind
    @ position``; the pose of the mesh's node has no effect.

    Attributes
    ----------
    name : str
    joints : tuple of int
        Node numbers in the tree.
    inverse_binds : (J, 4, 4) float64
        joint-from-mesh at rest.
    skeleton : int or None
        The node that the file names as their common root; it has no effect.
    extras : object
    """

    name: str
    joints: tuple[int, ...]
    inverse_binds: np.ndarray
    skeleton: int | None = None
    extras: Any = None


@dataclass(frozen=True, eq=False)
class ChannelRecord:
    """Animates one part of one node.

    Attributes
    ----------
    node : int
        The node's number in the tree.
    path : {"translation", "rotation", "scale", "weights"}
    interpolation : {"step", "linear", "cubicspline"}
    times : (K,) float32
        Seconds, at least 0, strictly increasing.
    values : (K, N) or (K, 3, N) float32
        N is 3, 4 (quaternions x, y, z, w) or the number of morph targets. Each key of a spline has
        in-tangent, value and out-tangent.
    """

    node: int
    path: MotionPath
    interpolation: Interpolation
    times: np.ndarray
    values: np.ndarray


@dataclass(frozen=True, eq=False)
class PropertyRecord:
    """Animates a property other than a node's pose.

    Attributes
    ----------
    kind : {"node", "material", "camera", "light"}
    number : int
        The index in the tree's list.
    path : str
        The attribute of the scene's object: see `PropertyChannel`.
    interpolation : {"step", "linear", "cubicspline"}
    times : (K,) float32
    values : (K, N) or (K, 3, N) float32
        As in `ChannelRecord`.
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
        The last time of all channels in seconds; all clips start at 0.
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
    """The camera of a node, with the node's pose.

    Attributes
    ----------
    kind : {"perspective", "orthographic"}
    name : str
    yfov : float or None
        Vertical field of view of a perspective camera, radians.
    aspect : float or None
        Width over height; None for that of the picture.
    xmag, ymag : float or None
        Half the visible width and height of an orthographic camera.
    znear : float
    zfar : float
        Infinite if the file gives none.
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
    """A light placed by its node; it shines along the node's -Z.

    Attributes
    ----------
    kind : str
        "directional", "point" or "spot"; unknown kinds give no light.
    name : str
    color : tuple of 3 float
        Linear light.
    intensity : float
        Lux for directional lights, candela for others.
    range : float
        The range; infinite if the file gives none.
    inner_cone_angle, outer_cone_angle : float
        Angles of a spot light from its axis, radians.
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
    """A node of a tree; numbers index the lists of the `TreeRecord`.

    Attributes
    ----------
    name : str
    children : tuple of int
    translation, rotation, scale : tuple of float or None
        As in the file; None if missing.
    matrix : (4, 4) float64 or None
        parent-from-node, if the file uses a matrix.
    visible : bool
    mesh, skin, camera, light : int or None
    weights : tuple of float or None
        Morph weights that override the mesh's.
    instances : (N, 4, 4) float64 or None
        node-from-instance, if the mesh is instanced.
    instance_parts : tuple of (N, 3), (N, 4) and (N, 3) or None
        Translations, quaternions and scales of the instances, if the file has them.
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
class JointRecord:
    """A joint between two nodes of a tree.

    Attributes
    ----------
    form : JointForm
    parent, child : int
        Node numbers in the tree; the child is below the parent.
    """

    form: JointForm
    parent: int
    child: int


@dataclass(frozen=True, eq=False)
class RobotRecord:
    """The links and joints of a tree.

    Attributes
    ----------
    name : str
    links : tuple of int
        Node numbers in the tree.
    joints : tuple of JointRecord
    values : dict of str to JointValue
        Where the joints stand; those that are missing, at rest.
    """

    name: str
    links: tuple[int, ...]
    joints: tuple[JointRecord, ...]
    values: dict[str, JointValue] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class TreeRecord:
    """The tree of a file: its nodes and their objects, each once.

    Attributes
    ----------
    nodes : tuple of NodeRecord
        All nodes of the file, including those outside the default scene.
    roots : tuple of int
        The root nodes of the default scene.
    meshes : tuple of MeshRecord
    skins : tuple of SkinRecord
    clips : tuple of ClipRecord
    cameras : tuple of LensRecord
    lights : tuple of LampRecord
    materials : tuple of Material
        All materials of the file.
    made_materials : dict of int to tuple of Material
        All versions created of each material: meshes without normals use a different one, for
        example.
    variants : tuple of str
        Names of the material variants.
    extras : object
    robot : RobotRecord or None
        The joints that move the nodes.
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
    robot: RobotRecord | None = None

    def parts(self, node: NodeRecord) -> tuple[MeshRecord, ...]:
        """Return the parts of a node's mesh; none if it has no mesh."""
        return () if node.mesh is None else self.meshes[node.mesh].parts
