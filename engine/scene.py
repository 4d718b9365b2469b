"""A scene: a tree of nodes that place meshes, lights and cameras in the world.

In: objects and poses, at any time. Out: nodes in the order they were added (which is the order of
drawing), each with its world pose, computed when asked for and kept until something above it moves.
The scene counts its changes, so that a renderer renews only what changed. Poses are float64 and
world poses are products in a fixed order of operations: the same bits on every machine.
"""

from __future__ import annotations

import itertools

import numpy as np

from . import linalg
from .attributes import frozen_floats, matrix4, vector3
from .cameras import Camera
from .colors import check_color
from .errors import InvalidArgumentError
from .instances import InstancedMesh, transform_box
from .lights import DirectionalLight, PointLight
from .mesh import Mesh

_IDENTITY = matrix4(np.eye(4), "pose")
_OBJECT_TYPES = (Mesh, InstancedMesh, Camera, DirectionalLight, PointLight)


class Node:
    """An object's place in a scene; made by `Scene.add`.

    ``pose`` is parent-from-node, a 4x4 matrix; ``translation``, ``rotation`` (quaternion x, y, z,
    w) and ``scale`` are the same pose in parts. Assign any of them at any time; what is read is
    read-only. Setting a part of a pose that is sheared drops the shear.

    Attributes
    ----------
    id : int
        What ``frame.object_id`` shows; counts up from 0 in the order of adding, never used twice.
    object : Mesh, InstancedMesh, Camera, DirectionalLight, PointLight or None
        None for a node that only groups others.
    parent : Node or None
    children : tuple of Node
    """

    __slots__ = (
        "__weakref__",
        "_children",
        "_object",
        "_parent",
        "_parts",
        "_pose",
        "_scene",
        "_visible",
        "_world_pose",
        "id",
        "name",
    )

    def __init__(self, scene: Scene, obj, name: str, parent: Node | None, number: int) -> None:
        self._scene = scene
        self._object = obj
        self._parent = parent
        self._children: list[Node] = []
        self._visible = True
        self._pose = _IDENTITY
        self._parts = None
        self._world_pose = None
        self.id = number
        self.name = name

    @property
    def object(self):
        return self._object

    @property
    def parent(self) -> Node | None:
        return self._parent

    @property
    def children(self) -> tuple[Node, ...]:
        return tuple(self._children)

    @property
    def pose(self) -> np.ndarray:
        """parent-from-node, (4, 4) float64."""
        return self._pose

    @pose.setter
    def pose(self, value) -> None:
        matrix = matrix4(value, "pose")
        if matrix[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
            raise InvalidArgumentError("pose must be affine: its last row is 0 0 0 1")
        self._place(matrix, None)

    @property
    def translation(self) -> np.ndarray:
        """(3,) float64."""
        return self._pose[:3, 3]

    @translation.setter
    def translation(self, value) -> None:
        offset = vector3(value, "translation")
        matrix = self._pose.copy()
        matrix[:3, 3] = offset
        matrix.setflags(write=False)
        self._place(matrix, self._parts)

    @property
    def rotation(self) -> np.ndarray:
        """Quaternion x, y, z, w, (4,) float64."""
        return self._rotation_and_scale()[0]

    @rotation.setter
    def rotation(self, value) -> None:
        self._compose(self.translation, value, self._rotation_and_scale()[1])

    @property
    def scale(self) -> np.ndarray:
        """Factors along the node's axes, (3,) float64; one number may be assigned."""
        return self._rotation_and_scale()[1]

    @scale.setter
    def scale(self, value) -> None:
        self._compose(self.translation, self._rotation_and_scale()[0], value)

    @property
    def visible(self) -> bool:
        """False hides the node and everything below it."""
        return self._visible

    @visible.setter
    def visible(self, value: bool) -> None:
        if bool(value) != self._visible:
            self._visible = bool(value)
            if self._scene is not None:
                self._scene._structure_version += 1

    @property
    def shown(self) -> bool:
        """Whether the node and all nodes above it are visible."""
        node = self
        while node is not None:
            if not node._visible:
                return False
            node = node._parent
        return True

    @property
    def world_pose(self) -> np.ndarray:
        """world-from-node, (4, 4) float64, read-only."""
        if self._world_pose is None:
            if self._parent is None:
                self._world_pose = self._pose
            else:
                product = linalg.multiply(self._parent.world_pose, self._pose)
                product.setflags(write=False)
                self._world_pose = product
        return self._world_pose

    def __repr__(self) -> str:
        what = "group" if self._object is None else type(self._object).__name__
        return f"<Node {self.id} {self.name!r}: {what}>"

    def _compose(self, translation, rotation, scale) -> None:
        rotation = frozen_floats(rotation, "rotation", (4,))
        if not rotation.any():
            raise InvalidArgumentError("rotation must not be the zero quaternion")
        scale = np.broadcast_to(scale, (3,)) if np.ndim(scale) == 0 else scale
        scale = vector3(scale, "scale")
        matrix = linalg.compose(vector3(translation, "translation"), rotation, scale)
        matrix.setflags(write=False)
        self._place(matrix, (rotation, scale))

    def _rotation_and_scale(self) -> tuple[np.ndarray, np.ndarray]:
        if self._parts is None:
            _, rotation, scale = linalg.decompose(self._pose)
            rotation.setflags(write=False)
            scale.setflags(write=False)
            self._parts = rotation, scale
        return self._parts

    def _place(self, matrix: np.ndarray, parts) -> None:
        self._pose = matrix
        self._parts = parts
        self._forget_world_pose()
        if self._scene is not None:
            self._scene._pose_version += 1

    def _forget_world_pose(self) -> None:
        """Below a node whose world pose is unknown no other is known, so the walk ends there."""
        if self._world_pose is None:
            return
        pending = [self]
        while pending:
            node = pending.pop()
            node._world_pose = None
            pending.extend(child for child in node._children if child._world_pose is not None)


class Scene:
    """What is drawn, and the light that is everywhere.

    Parameters
    ----------
    background : sequence of 3 numbers, or None
        Colour behind everything; None is transparent black (alpha 0).
    ambient : sequence of 3 numbers
        Light that reaches every surface from all sides.
    light_clamp : (low, high), optional
        Limits of the light that a surface receives (ambient included) before its colour multiplies
        it, such as (0.1, 1).

    Attributes
    ----------
    background, ambient, light_clamp
        As above; assign at any time.
    warnings : list of str
        What was left out or replaced where the scene was made from a file.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(
        self, background=(0, 0, 0), ambient=(0.1, 0.1, 0.1), light_clamp: tuple | None = None
    ) -> None:
        self._nodes: dict[int, Node] = {}
        self._numbers = itertools.count()
        self._structure_version = 0
        self._pose_version = 0
        self._first_camera: Node | None = None
        self._camera_version = -1
        self.warnings: list[str] = []
        self.background = background
        self.ambient = ambient
        self.light_clamp = light_clamp

    @property
    def background(self):
        return self._background

    @background.setter
    def background(self, value) -> None:
        self._background = None if value is None else check_color(value, "background")

    @property
    def ambient(self):
        return self._ambient

    @ambient.setter
    def ambient(self, value) -> None:
        self._ambient = check_color(value, "ambient")

    @property
    def light_clamp(self) -> tuple[float, float] | None:
        return self._light_clamp

    @light_clamp.setter
    def light_clamp(self, value) -> None:
        if value is None:
            self._light_clamp = None
            return
        low, high = _pair(value, "light_clamp")
        if not 0 <= low <= high:
            raise InvalidArgumentError(f"light_clamp must be 0 <= low <= high, not {value!r}")
        self._light_clamp = (low, high)

    def add(
        self,
        obj=None,
        *,
        name: str | None = None,
        parent: Node | None = None,
        pose=None,
        translation=None,
        rotation=None,
        scale=None,
    ) -> Node:
        """Put an object into the scene.

        Parameters
        ----------
        obj : Mesh, InstancedMesh, Camera, DirectionalLight, PointLight or None
            The same object may be added many times. None adds a node that groups others.
        name : str, optional
            The object's own name if left out.
        parent : Node, optional
            A node of this scene; the new node moves with it.
        pose : (4, 4) float, optional
            parent-from-node; or give the parts instead:
        translation : (3,) float, optional
        rotation : (4,) float, optional
            Quaternion x, y, z, w.
        scale : float or (3,) float, optional

        Returns
        -------
        node : Node

        Raises
        ------
        InvalidArgumentError
        """
        if obj is not None and not isinstance(obj, _OBJECT_TYPES):
            allowed = ", ".join(kind.__name__ for kind in _OBJECT_TYPES)
            raise InvalidArgumentError(
                f"a scene holds {allowed} or None (a group), not {type(obj).__name__}"
            )
        if parent is not None and not (isinstance(parent, Node) and parent._scene is self):
            raise InvalidArgumentError("parent must be a node of this scene")
        if name is None:
            name = getattr(obj, "name", "")
        node = Node(self, obj, str(name), parent, 0)
        parts = (translation, rotation, scale)
        if pose is not None:
            if any(part is not None for part in parts):
                raise InvalidArgumentError("give pose or translation, rotation and scale, not both")
            node.pose = pose
        elif any(part is not None for part in parts):
            node._compose(
                (0.0, 0.0, 0.0) if translation is None else translation,
                (0.0, 0.0, 0.0, 1.0) if rotation is None else rotation,
                1.0 if scale is None else scale,
            )
        node.id = next(self._numbers)
        self._nodes[node.id] = node
        if parent is not None:
            parent._children.append(node)
        self._structure_version += 1
        return node

    def remove(self, node: Node) -> None:
        """Take a node and everything below it out of the scene.

        Raises
        ------
        InvalidArgumentError
            The node is not in this scene.
        """
        if not isinstance(node, Node) or node._scene is not self:
            raise InvalidArgumentError("remove() needs a node of this scene")
        if node._parent is not None:
            node._parent._children.remove(node)
        pending = [node]
        while pending:
            gone = pending.pop()
            pending.extend(gone._children)
            del self._nodes[gone.id]
            gone._scene = None
        self._structure_version += 1

    @property
    def nodes(self) -> tuple[Node, ...]:
        """All nodes, in the order they were added."""
        return tuple(self._nodes.values())

    def _camera_node(self) -> Node | None:
        """The first visible node that holds a camera: what is drawn through by default."""
        if self._camera_version != self._structure_version:
            cameras = (node for node in self._nodes.values() if isinstance(node._object, Camera))
            self._first_camera = next((node for node in cameras if node.shown), None)
            self._camera_version = self._structure_version
        return self._first_camera

    def find(self, name: str) -> Node | None:
        """Return the first node of that name, or None."""
        return next((node for node in self._nodes.values() if node.name == name), None)

    @property
    def bounds(self) -> np.ndarray:
        """The box around all visible meshes, (2, 3) float64 in world space; zeros if none."""
        poses, boxes = [], []
        for node in self._nodes.values():
            box = _bounds_in_node(node._object)
            if box is not None and node.shown:
                poses.append(node.world_pose)
                boxes.append(box)
        if not boxes:
            return np.zeros((2, 3))
        low, high = np.stack(boxes, axis=1)
        centers, halves = transform_box(np.stack(poses), (low + high) * 0.5, (high - low) * 0.5)
        return np.stack([(centers - halves).min(axis=0), (centers + halves).max(axis=0)])

    def __repr__(self) -> str:
        return f"Scene({len(self._nodes)} nodes)"


def _bounds_in_node(obj) -> np.ndarray | None:
    if isinstance(obj, Mesh):
        return obj.bounds if len(obj.positions) else None
    if isinstance(obj, InstancedMesh):
        return obj.bounds_in_node()
    return None


def _pair(value, what: str) -> tuple[float, float]:
    try:
        low, high = value
        return float(low), float(high)
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{what} must be two numbers, not {value!r}") from None
