"""Scenes: trees of nodes that place meshes, lights and cameras in the world.

In: objects and poses, at any time. Out: nodes in the order of adding, which is the drawing order. A
node is the handle of a row of arrays, from which C computes the changed world poses, visibility and
bounds; the scene counts its changes, so that a renderer renews only what it must.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NoReturn, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...base.calls import checks_types, hinted
from ...base.checked_containers import CheckedDict
from ...base.linalg.quaternions import quaternion_of_turns
from ...base.notebook_pictures import ShownInNotebooks
from ...base.numbers import shown
from ...base.validation import text, vector3
from ...choices import ColorLike
from ...errors import InvalidArgumentError
from ...model.materials.linear_colors import linear
from ..environments.environment import Environment
from ._queries import SceneQueries
from .gradients import Gradient
from .nodes import Node, check_euler, check_pose, check_rotation, check_scale, with_below
from .scene_data import SceneData, check_object
from .selection import NodeSelection
from .surroundings import Surroundings

if TYPE_CHECKING:
    from ..motion.clips import AnimationClip
    from ..motion.robots import Robot
    from .animation import Animator
    from .nodes import SceneObject, SeveralNodes

_USUAL_FLAGS = {"cast_shadows": True, "receive_shadows": True, "static": False}
_DIM = linear(0.1, 0.1, 0.1)


class Scene(ShownInNotebooks, Surroundings, SceneQueries):
    """A tree of nodes to draw, with a background and ambient light.

    Parameters
    ----------
    background : str or sequence of 3 numbers, Gradient, Environment or None
        The background: a colour, a gradient, or the environment as the camera sees it; None is
        transparent black (alpha 0).
    ambient : str or sequence of 3 numbers
        Light that reaches every surface from all sides; physical materials also reflect it, as
        uniform surroundings.
    light_clamp : (low, high), optional
        Limits of the light that a surface receives (ambient included), before its colour is
        applied, such as (0.1, 1). Physical materials ignore them.
    exposure : float
        Stops: the light of lit surfaces is multiplied by ``2**exposure``.

    Attributes
    ----------
    background, ambient, light_clamp, exposure
        As above; assign at any time.
    environment : Environment or None
        Image-based lighting; physically based materials reflect it.
    environment_intensity : float
        Factor on the environment's radiance, also as background; 1 by default.
    environment_rotation : float
        Radians about +Y, counter-clockwise seen from above; also turns the background.
    background_blur : float
        Blur of an environment as background, 0..1.
    fog : Fog, ExponentialFog or None
        Fog, in modes "lit" and "unlit".
    animations : dict of str to AnimationClip
        The file's clips by name, for an `AnimationPlayer`.
    robots : mapping of str to Robot
        The file's robots by name, whose joints move nodes; read-only.
    warnings : list of str
        The loader's warnings: what it omitted or replaced.
    animator : Animator or None
        Moves the nodes as the scene's file says, and is saved with the scene. Call its
        `Animator.seek` or `Animator.advance`; nothing moves otherwise. Assignable.

    Raises
    ------
    InvalidArgumentError
    """

    warnings: list[str]
    if TYPE_CHECKING:  # for the engine's own parts; undeclared, so that programs can't assign it
        data: SceneData

    def __init__(
        self,
        background: ColorLike | Gradient | Environment | None = (0, 0, 0),
        ambient: ColorLike = _DIM,
        light_clamp: Sequence[float] | None = None,
        exposure: float = 0.0,
    ) -> None:
        super().__init__(background, ambient, light_clamp, exposure)
        object.__setattr__(self, "data", SceneData())
        self.animations = {}
        self._animator: Animator | None = None
        self.warnings = []

    @property
    def animations(self) -> dict[str, AnimationClip]:
        return self._animations

    @animations.setter
    def animations(self, value: Mapping[str, AnimationClip]) -> None:
        from ..motion.clips import check_clips

        self._animations = CheckedDict(self, _take_animations, check_clips(value))

    @property
    def robots(self) -> Mapping[str, Robot]:
        """The robots of the file by name, read-only; see `Robot`."""
        return MappingProxyType(self.data.robots)

    @property
    def animator(self) -> Animator | None:
        return self._animator

    @animator.setter
    def animator(self, value: Animator | None) -> None:
        # Only an Animator has motions; its module imports this one.
        fits = value is None or (hasattr(value, "_motions") and value._scene is self)
        if not fits:
            raise InvalidArgumentError("animator must be an Animator of this scene, or None")
        self._animator = value

    @hinted
    def add(
        self,
        obj: SceneObject | SeveralNodes | None = None,
        *,
        name: str | None = None,
        parent: Node | None = None,
        pose: ArrayLike | None = None,
        translation: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        euler: ArrayLike | None = None,
        scale: ArrayLike | None = None,
        static: bool = False,
        cast_shadows: bool = True,
        receive_shadows: bool = True,
    ) -> Node:
        """Add a node for an object to the scene.

        Parameters
        ----------
        obj : Mesh, InstancedMesh, Camera, a light of any kind, or None
            The same object may be added many times. None adds a group node, or a node whose
            ``object`` is assigned later. What has a method ``add_to``, such as
            `engine3d.worlds.World` and `engine3d.detail.DetailedInstances`, adds several nodes
            below one.
        name : str, optional
            By default the object's name.
        parent : Node, optional
            A node of this scene that the new node moves with.
        pose : (4, 4) float, optional
            parent-from-node; or give the parts instead:
        translation : (3,) float, optional
        rotation : (4,) float, optional
            Quaternion x, y, z, w.
        euler : (3,) float, optional
            Instead of ``rotation``: angles in radians about x, then the new y, then the newest z,
            as in `Node.euler` and three.js; convert degrees with ``numpy.radians``.
        scale : float or (3,) float, optional
        static : bool
            A hint that the node stays where it is; see `Node.static`.
        cast_shadows, receive_shadows : bool
            See `Node.cast_shadows`.

        Returns
        -------
        node : Node

        Raises
        ------
        InvalidArgumentError
        """
        is_several = hasattr(type(obj), "add_to")
        if not is_several:
            check_object(obj)
        if parent is not None and not (isinstance(parent, Node) and parent._scene is self):
            raise InvalidArgumentError(f"parent must be a node of this scene, not {shown(parent)}")
        name = None if name is None else text(name, "name")
        if rotation is not None and euler is not None:
            raise InvalidArgumentError("give rotation or euler, not both")
        if euler is not None:
            rotation = quaternion_of_turns(check_euler(euler))
        parts = (translation, rotation, scale)
        if pose is not None and any(part is not None for part in parts):
            raise InvalidArgumentError("give pose or translation, rotation and scale, not both")
        pose = None if pose is None else check_pose(pose)
        translation = None if translation is None else vector3(translation, "translation")
        rotation = None if rotation is None else check_rotation(rotation)
        scale = None if scale is None else check_scale(scale)
        add = _added_below if is_several else _added
        node = add(self, obj, name, parent)
        arrays, slot = self.data.arrays, node._slot
        if pose is not None:
            arrays.set_pose(slot, pose)
        if translation is not None:
            arrays.set_translation(slot, translation)
        if rotation is not None or scale is not None:
            arrays.set_parts(slot, rotation, scale)
        flags = {"cast_shadows": cast_shadows, "receive_shadows": receive_shadows, "static": static}
        for each in with_below(node) if is_several else (node,):
            for flag, value in flags.items():
                # What is left at its default stays as `add_to` set it.
                if value is not _USUAL_FLAGS[flag]:
                    setattr(each, flag, value)
        return node

    def remove(self, node: Node) -> None:
        """Remove a node and its subtree from the scene; see `restore`.

        Raises
        ------
        InvalidArgumentError
            The node is not in this scene.
        """
        if not isinstance(node, Node) or node._scene is not self:
            raise InvalidArgumentError(f"node must be one of this scene, not {_unfound(node)}")
        self.data.remove(node)

    def restore(
        self, node: Node, *, parent: Node | None = None, before: Node | None = None
    ) -> None:
        """Restore a removed node, with the subtree that was removed with it.

        All of them keep their IDs, and so their places in drawing order, and changes made
        meanwhile.

        Parameters
        ----------
        node : Node
            The node that `remove` was called with.
        parent : Node, optional
            The new parent; by default the scene itself.
        before : Node, optional
            As in `Node.reparent`.

        Raises
        ------
        InvalidArgumentError
            The node was not removed from this scene, or only as part of another's subtree; or the
            parent is invalid.
        """
        if not (isinstance(node, Node) and self.data.may_restore(node)):
            raise InvalidArgumentError(
                f"node must be one that was removed from this scene, not {_unfound(node)}"
            )
        self.data.restore(self, node)
        try:
            node.reparent(parent, before=before)
        except InvalidArgumentError:
            self.remove(node)
            raise

    @property
    def nodes(self) -> tuple[Node, ...]:
        """All nodes, in the order of adding."""
        return self.data.nodes

    @checks_types
    def find(self, name: str) -> Node | None:
        """Return the first node with a name, or None."""
        return self.data.find(name)

    def select(self, nodes: Iterable[Node] | None = None) -> NodeSelection:
        """Return a selection of nodes, whose poses are read and written as arrays.

        Parameters
        ----------
        nodes : iterable of Node, optional
            By default all current nodes of the scene.

        Returns
        -------
        selection : NodeSelection

        Raises
        ------
        InvalidArgumentError
            A node is not in this scene; also raised later, once one is removed.
        """
        if nodes is not None and not isinstance(nodes, Iterable):
            raise InvalidArgumentError(f"nodes must be an iterable of Node, not {nodes!r}")
        return NodeSelection(self, self.nodes if nodes is None else nodes)

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The box around all visible meshes, (2, 3) float64 in world space; zeros if none."""
        return self.data.bounds()

    @checks_types
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene to a file; see `engine3d.save_scene`."""
        from ...io.writing.scene_saving import save_scene

        save_scene(self, path)

    def copy(self) -> Scene:
        """Return a scene that shows the same, and can be changed without changing this one.

        Nodes, cameras, lights, skins, animations and the animator are copied; node IDs count from 0
        again. Meshes, instances, materials, textures and environments are shared: replace
        ``node.object`` by ``node.object.copy()`` before changing one.
        """
        from ._copies import copied_scene

        return copied_scene(self)

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a Scene cannot be pickled, and is copied by scene.copy()")

    def __repr__(self) -> str:
        return f"Scene({self.data.node_count} nodes)"


def _take_animations(
    scene: Scene, clips: dict[Any, Any], put: Callable[[dict[Any, Any]], None]
) -> None:
    """Replace the content of a scene's own dict of clips."""
    from ..motion.clips import check_clips

    put(check_clips(clips))


def _unfound(node: object) -> str:
    """Return the description of a non-node argument: usually `Scene.find` did not find its name."""
    return "None, which find() returns of an unknown name" if node is None else shown(node)


def _added(scene: Scene, obj: Any, name: str | None, parent: Node | None) -> Node:
    """Add one node."""
    called = text(getattr(obj, "name", ""), "name") if name is None else name
    return scene.data.add(scene, obj, called, parent)


def _added_below(scene: Scene, obj: Any, name: str | None, parent: Node | None) -> Node:
    """Add something that adds its own nodes; return the one above them."""
    node = obj.add_to(scene)
    if name is not None:
        node.name = name
    if parent is not None:
        node.reparent(parent)
    return node
