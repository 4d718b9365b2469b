"""Nodes: handles of rows in a scene's arrays.

In: poses and their parts, parents and visibility, one node at a time; `Scene.select` handles many.
Out: the same, read-only, and derived values: world pose, `shown`, bounds. World poses are products
in a fixed order of operations, computed on demand and cached until the node or an ancestor moves.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NoReturn, Protocol, SupportsIndex, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.loaders import frozen
from ..._native.scene_graph import STATIC, VISIBLE, FixedSlots
from ...base import linalg
from ...base.angles import angles
from ...base.calls import checks_types
from ...base.foreign_names import UnknownName, refuses_foreign_names
from ...base.linalg.quaternions import quaternion_of_turns
from ...base.numbers import floats, shown
from ...base.validation import finite_floats, flag, matrix4, text, vector3
from ...errors import InvalidArgumentError
from ..spatial.colliders import check_collider
from ._pose_parts import PosePart
from .node_arrays import CASTS_NONE, RECEIVES_NONE, NodeArrays

if TYPE_CHECKING:
    from ..geometry.mesh import Mesh
    from ..motion.posed_mesh import PosedMesh
    from ..motion.skins import Skin
    from ..spatial.colliders import Collider
    from .cameras import Camera
    from .instances import InstancedMesh
    from .lights import Light
    from .scene import Scene

    #: The objects that a node can hold.
    SceneObject: TypeAlias = Mesh | InstancedMesh | Camera | Light

    class SeveralNodes(Protocol):
        """What adds several nodes below one."""

        def add_to(self, scene: Scene) -> Node: ...


@refuses_foreign_names
class Node(FixedSlots):
    """An object's place in a scene; made by `Scene.add`.

    ``pose`` is parent-from-node, a 4x4 matrix; ``translation``, ``rotation`` (quaternion x, y, z,
    w), ``euler`` and ``scale`` are its parts. Assign any of them at any time; the arrays returned
    are read-only. Setting a part of a sheared pose drops the shear.
    """

    __slots__ = (
        "__weakref__",
        "_arrays",
        "_collider",
        "_drawn",
        "_id",
        "_morph_weights",
        "_name",
        "_object",
        "_pose",
        "_pose_version",
        "_read_pose",
        "_scene",
        "_skin",
        "_slot",
        "_taken",
        "_taken_with",
        "_translation",
        "_world_pose",
        "_world_version",
    )

    # Set by the scene, which has a row for each node.
    _arrays: NodeArrays
    _slot: int
    # The skin, the morph weights, and the object drawn with them.
    _skin: Skin | None
    _morph_weights: NDArray[np.float64] | None
    _posed: PosedMesh | None
    _drawn: SceneObject | PosedMesh | None
    _collider: Collider | None
    _taken: tuple[Node, ...]
    _taken_with: Node | None
    _pose: NDArray[np.float64]
    _read_pose: NDArray[np.float64] | None
    _translation: PosePart
    _world_pose: NDArray[np.float64]

    def __init__(self, scene: Scene, obj: SceneObject | None, name: str, number: int) -> None:
        self._scene = scene
        self._arrays, self._slot = scene.data.arrays, -1  # its row, once it has one
        self._object = obj
        self._drawn: SceneObject | PosedMesh | None = obj  # the object drawn for it
        self._skin: Skin | None = None
        self._morph_weights: NDArray[np.float64] | None = None
        self._name = name
        self._collider = None
        self._taken: tuple[Node, ...] = ()  # the descendants removed with this node
        self._taken_with: Node | None = None  # the ancestor this node was removed with
        self._pose_version = self._world_version = -1
        self._read_pose = None  # the pose when the translation was last read
        self._id = number

    @property
    def id(self) -> int:
        """The node's ``object_id`` in frames; counts up from 0 in the order of adding."""
        return self._id

    @property
    def scene(self) -> Scene | None:
        """The node's scene; None once the node is removed."""
        return self._scene

    @property
    def object(self) -> SceneObject | None:
        """The node's Mesh, InstancedMesh, Camera or light; None for a group.

        Assign another, or None, at any time: the node keeps its ID, name, pose and children. A
        collider that uses the node's own mesh requires a mesh.
        """
        return self._object

    @object.setter
    def object(self, value: SceneObject | None) -> None:
        scene = self._in_scene()
        if self._collider is not None:
            check_collider(value, self._collider)
        scene.data.hold(self, value)

    @property
    def skin(self) -> Skin | None:
        """The joints that deform the node's mesh, or None.

        The mesh needs ``joints`` and ``weights``. The joints then place it; the node's own pose has
        no effect. Many nodes can show one mesh, each with its own skin. Other kinds of objects
        ignore the skin.
        """
        return self._skin

    @skin.setter
    def skin(self, value: Skin | None) -> None:
        self._in_scene().data.set_skin(self, value)

    @property
    def morph_weights(self) -> NDArray[np.float64] | None:
        """The weight of each morph target of the node's mesh, (T,) float64; None is 0."""
        return self._morph_weights

    @morph_weights.setter
    def morph_weights(self, value: ArrayLike | None) -> None:
        self._in_scene().data.set_morph_weights(self, value)

    @property
    def name(self) -> str:
        return self._name

    @name.setter
    def name(self, value: str) -> None:
        self._name = text(value, "name")
        if self._scene is not None:
            self._scene.data.forget_names()

    @property
    def parent(self) -> Node | None:
        """The node's parent; assigning keeps ``pose``, see `reparent`."""
        slot = self._arrays.parent_of(self._slot)
        return None if slot < 0 else self._arrays.nodes[slot]

    @parent.setter
    def parent(self, value: Node | None) -> None:
        self.reparent(value)

    @property
    def children(self) -> tuple[Node, ...]:
        """The node's children, in the order in which they were attached."""
        nodes = self._arrays.nodes
        below = (nodes[slot] for slot in self._arrays.children(self._slot))
        return tuple(node for node in below if node is not None)

    def _refuse(self, name: str) -> None:
        """Raise an error that suggests a name, if nodes do not have this one."""
        if not hasattr(Node, name):
            raise UnknownName(Node, name)

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a Node belongs to its Scene: it cannot be copied or pickled")

    def reparent(
        self,
        parent: Node | None,
        *,
        keep_world_pose: bool = False,
        before: Node | None = None,
    ) -> None:
        """Move the node, with its subtree, to another parent.

        Parameters
        ----------
        parent : Node or None
            A node of the same scene; None is the scene itself.
        keep_world_pose : bool
            Change ``pose`` so that the node stays where it is in the world, up to rounding;
            otherwise ``pose`` stays and the node moves.
        before : Node, optional
            A child of the parent: the node is inserted before it in ``parent.children`` instead of
            at the end. Drawing order stays the order of IDs.

        Raises
        ------
        InvalidArgumentError
            The parent is the node itself, a descendant or in another scene, or its world pose has
            no inverse; or ``before`` is not another child of the parent.
        """
        scene = self._scene
        if parent is not None and not (isinstance(parent, Node) and parent._scene is scene):
            raise InvalidArgumentError(f"parent must be a node of this scene, not {shown(parent)}")
        if scene is None:
            raise InvalidArgumentError("the node was removed from its scene")
        pose = None
        if flag(keep_world_pose, "keep_world_pose"):
            pose = self.world_pose
            if parent is not None:
                pose = linalg.multiply(linalg.inverse(parent.world_pose), pose)
        if before is not None and (before is self or not _hangs_under(before, parent)):
            raise InvalidArgumentError(f"before must be another child of the parent: {before!r}")
        slots = (-1 if node is None else node._slot for node in (parent, before))
        if not self._arrays.link(self._slot, *slots):
            raise InvalidArgumentError(f"{parent!r} is {self!r} or below it: that would be a cycle")
        if pose is not None:
            self.pose = pose

    @property
    def pose(self) -> NDArray[np.float64]:
        """parent-from-node, (4, 4) float64."""
        version = self._arrays.pose_version(self._slot)
        if version != self._pose_version:
            self._pose, self._pose_version = self._arrays.pose(self._slot), version
        return self._pose

    @pose.setter
    def pose(self, value: ArrayLike) -> None:
        self._arrays.set_pose(self._slot, check_pose(value))

    @property
    def translation(self) -> NDArray[np.float64]:
        """Translation, (3,) float64."""
        pose = self.pose
        if pose is not self._read_pose:
            self._read_pose, self._translation = pose, pose[:3, 3].view(PosePart)
        return self._translation

    @translation.setter
    def translation(self, value: ArrayLike) -> None:
        self._arrays.set_translation(self._slot, vector3(value, "translation"))

    @property
    def rotation(self) -> NDArray[np.float64]:
        """Quaternion x, y, z, w, (4,) float64."""
        return self._arrays.rotation(self._slot).view(PosePart)

    @rotation.setter
    def rotation(self, value: ArrayLike) -> None:
        self._arrays.set_parts(self._slot, check_rotation(value), None)

    @property
    def euler(self) -> NDArray[np.float64]:
        """The rotation as angles in radians about x, y and z, (3,) float64.

        It turns about x, then about the new y, then about the newest z: the default order of
        `linalg.euler_to_quaternion`.
        """
        return frozen(linalg.quaternion_to_euler(np.asarray(self.rotation))).view(PosePart)

    @euler.setter
    def euler(self, value: ArrayLike) -> None:
        self.rotation = quaternion_of_turns(check_euler(value))

    @property
    def scale(self) -> NDArray[np.float64]:
        """Scale factors along the node's axes, (3,) float64; one number may be assigned."""
        return self._arrays.scale(self._slot).view(PosePart)

    @scale.setter
    def scale(self, value: ArrayLike) -> None:
        self._arrays.set_parts(self._slot, None, check_scale(value))

    @checks_types
    def look_at(self, target: ArrayLike, up: ArrayLike = (0.0, 1.0, 0.0)) -> None:
        """Turn the node so that its -Z, along which cameras and lights look, meets a place.

        Parameters
        ----------
        target : (3,) float
            The place, in world space, where the node is now; later moves do not turn the node.
        up : (3,) float
            The direction, in world space, that is up for the node; if it is parallel to the line of
            sight, an axis takes its place.

        Raises
        ------
        InvalidArgumentError
            The target is where the node is, a number is not finite, or a parent's pose has no
            inverse. Position and scale stay; a shear is lost.
        """
        self._in_scene()
        place, parent = vector3(target, "target"), self.parent
        towards, upward = place - self.world_pose[:3, 3], vector3(up, "up")
        if not towards.any() or not upward.any():
            raise InvalidArgumentError("target must not be the node's own place, nor up zero")
        if parent is not None:
            turn = np.eye(4)
            turn[:3, :3] = parent.world_pose[:3, :3]
            local = linalg.transform_directions(linalg.inverse(turn), np.stack([towards, upward]))
            towards, upward = local
        scale = self.scale
        pose = linalg.look_at((0.0, 0.0, 0.0), -towards if scale[2] < 0 else towards, upward)
        pose[:3, :3] *= scale
        pose[:3, 3] = self.pose[:3, 3]
        self.pose = pose

    @property
    def visible(self) -> bool:
        """Visibility; False hides the node and its subtree."""
        return self._arrays.get_flag(self._slot, VISIBLE)

    @visible.setter
    def visible(self, value: bool) -> None:
        on = value if value is True or value is False else flag(value, "visible")
        self._arrays.set_flag(self._slot, VISIBLE, on)

    @property
    def shown(self) -> bool:
        """Whether the node and all its ancestors are visible."""
        return self._arrays.shown(self._slot)

    @property
    def static(self) -> bool:
        """A hint for programs that the node stays where it is; the renderer ignores it.

        The node can still be moved.
        """
        return self._arrays.get_flag(self._slot, STATIC)

    @static.setter
    def static(self, value: bool) -> None:
        self._arrays.set_flag(self._slot, STATIC, flag(value, "static"))

    @property
    def cast_shadows(self) -> bool:
        """Whether the node's object casts shadows; children have their own switch.

        See `DirectionalLight`. Lines and points cast no shadows.
        """
        return self._takes_part(CASTS_NONE)

    @cast_shadows.setter
    def cast_shadows(self, value: bool) -> None:
        self._take_part(CASTS_NONE, flag(value, "cast_shadows"))

    @property
    def receive_shadows(self) -> bool:
        """Whether the node's object receives shadows; children have their own switch."""
        return self._takes_part(RECEIVES_NONE)

    @receive_shadows.setter
    def receive_shadows(self, value: bool) -> None:
        self._take_part(RECEIVES_NONE, flag(value, "receive_shadows"))

    @property
    def collider(self) -> Collider | None:
        """BoxCollider, SphereCollider, MeshCollider or None; see `Scene.overlap_box`."""
        return self._collider

    @collider.setter
    def collider(self, value: Collider | None) -> None:
        check_collider(self._object, value)
        self._collider = value
        if self._scene is not None:
            self._scene.data.list_collider(self)

    @property
    def world_pose(self) -> NDArray[np.float64]:
        """world-from-node, (4, 4) float64, read-only."""
        version = self._arrays.world_version(self._slot)
        if version != self._world_version:
            self._world_pose = self._arrays.world_pose(self._slot)
            self._world_version = version
        return self._world_pose

    @property
    def bounds(self) -> NDArray[np.float64] | None:
        """The box around the node's own object in world space, (2, 3) float64.

        None if the node shows nothing: it holds no mesh or an empty one, or is hidden. The box
        encloses the transformed object box, not the vertices, so it is loose for rotated nodes.
        """
        if self._scene is None:
            return None
        self._scene.data.update()
        bounds = frozen(self._arrays.columns["bounds"][self._slot, :6].reshape(2, 3).copy())
        return bounds if bounds[0, 0] <= bounds[1, 0] else None

    def __repr__(self) -> str:
        what = "group" if self._object is None else type(self._object).__name__
        return f"<Node {self.id} {self.name!r}: {what}>"

    def _in_scene(self) -> Scene:
        """Return the node's scene; raise if the node was removed."""
        if self._scene is None:
            raise InvalidArgumentError("the node was removed from its scene")
        return self._scene

    def _takes_part(self, bit: int) -> bool:
        return not self._arrays.columns["unshadowed"][self._slot] & bit

    def _take_part(self, bit: int, on: bool) -> None:
        """Set or clear a flag that keeps the node from casting or receiving shadows."""
        if self._takes_part(bit) != on:
            self._arrays.columns["unshadowed"][self._slot] ^= bit
            self._arrays.changes += 1


def _hangs_under(node: Node | None, parent: Node | None) -> bool:
    return parent is not None and isinstance(node, Node) and node.parent is parent


def with_below(node: Node) -> list[Node]:
    """Return a node and its descendants: parents first, siblings in order."""
    nodes = node._arrays.nodes
    return [nodes[slot] for slot in node._arrays.below(node._slot)]


def next_sibling(node: Node) -> Node | None:
    """Return the node's next sibling."""
    if node.parent is None:
        return None
    slot = int(node._arrays.columns["next"][node._slot])
    return None if slot < 0 else node._arrays.nodes[slot]


def check_pose(value: ArrayLike) -> NDArray[np.float64]:
    """Return an affine matrix, checked, as (4, 4) float64."""
    matrix = matrix4(value, "pose")
    if matrix[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        raise InvalidArgumentError("pose must be affine: its last row is 0 0 0 1")
    return matrix


def check_rotation(value: ArrayLike) -> NDArray[np.float64]:
    """Return a quaternion, checked, as (4,) float64."""
    try:
        rotation = finite_floats(value, "rotation", (4,))
    except InvalidArgumentError:
        if floats(value, "rotation").shape != (3,):
            raise
        raise InvalidArgumentError(
            "rotation is a quaternion (x, y, z, w), not three numbers: three angles are euler=, "
            f"in radians: {shown(value)}"
        ) from None
    if not 0.0 < sum(x * x for x in rotation.tolist()) < math.inf:
        raise InvalidArgumentError("rotation must not be the zero quaternion, nor overflow")
    return rotation


def check_euler(value: ArrayLike) -> NDArray[np.float64]:
    """Return three angles, checked, as a read-only (3,) float64 array."""
    return vector3(angles(value, "euler"), "euler")


def check_scale(value: ArrayLike) -> NDArray[np.float64]:
    """Return one scale factor or three, checked, as (3,) float64."""
    factors = floats(value, "scale")
    return vector3(np.broadcast_to(factors, (3,)) if factors.ndim == 0 else factors, "scale")
