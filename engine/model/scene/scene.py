"""A scene: a tree of nodes that place meshes, lights and cameras in the world.

In: objects and poses, at any time. Out: nodes in the order they were added, which is the order of
drawing. The nodes are handles of rows of arrays, from which C finds world poses, visibility and
bounds of what changed; the scene counts its changes, so that a renderer renews only what it must.
"""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING
from weakref import WeakSet

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.scene_graph import OBJECT_BOX, union
from ...base.calls import checks_types, hinted
from ...base.checked_containers import CheckedDict
from ...base.linalg.quaternions import quaternion_of_turns
from ...base.numbers import shown
from ...base.validation import flag, text, vector3
from ...choices import ColorLike
from ...errors import InvalidArgumentError
from ..environments.environment import Environment
from ..geometry.mesh import Mesh
from ..motion.posing import (
    Posing,
    check_morph_weights,
    check_skin,
    may_bend,
    posed_for,
    set_weights,
)
from ._objects import ObjectTable
from ._queries import SceneQueries
from .cameras import Camera
from .gradients import Gradient
from .instances import InstancedMesh
from .lights import LIGHTS
from .node_arrays import NodeArrays
from .nodes import Node, check_euler, check_pose, check_rotation, check_scale
from .selection import NodeSelection
from .surroundings import Surroundings

if TYPE_CHECKING:
    from ..materials.material import Material
    from ..motion.clips import AnimationClip
    from ..motion.skins import Skin
    from .animation import Animator
    from .nodes import SceneObject

_LEAST_REMOVED = 1024  # slots of removed nodes that are not worth packing
_OBJECT_TYPES = (Mesh, InstancedMesh, Camera, *LIGHTS)


class Scene(Surroundings, SceneQueries):
    """A tree of nodes to draw, with a background and ambient light.

    Parameters
    ----------
    background : sequence of 3 numbers, Gradient, Environment or None
        What is behind everything: a colour, two, or the environment as the camera sees it; None is
        transparent black (alpha 0).
    ambient : sequence of 3 numbers
        Light that reaches every surface from all sides; to physical materials, surroundings that
        look so everywhere.
    light_clamp : (low, high), optional
        Limits of the light that a surface receives (ambient included) before its colour multiplies
        it, such as (0.1, 1). Physical materials have no such limits.
    exposure : float
        Stops: what lit surfaces show is multiplied by ``2**exposure``.

    Attributes
    ----------
    background, ambient, light_clamp, exposure
        As above; assign at any time.
    environment : Environment or None
        Light from all around; physically based materials reflect it.
    environment_intensity : float
        Factor of the environment's radiance, 1 by default; as a background, too.
    environment_rotation : float
        Radians about +Y, counter-clockwise seen from above; as a background, too.
    background_blur : float
        0..1: how blurred an environment is as the background, 1 most.
    fog : Fog, ExponentialFog or None
        What becomes of colours with distance, in modes "lit" and "unlit".
    animations : dict of str to AnimationClip
        Clips of a file, by name, for an `AnimationPlayer`.
    warnings : list of str
        What was left out or replaced where the scene was made from a file.
    animator : Animator or None
        Moves the nodes as the scene's file says, and is written with the scene. Nothing happens by
        itself: call its `Animator.seek` or `Animator.advance`. Can be assigned.

    Raises
    ------
    InvalidArgumentError
    """

    warnings: list[str]
    _untextured: frozenset[Material] = frozenset()  # what is drawn without its textures

    def __init__(
        self,
        background: ColorLike | Gradient | Environment | None = (0, 0, 0),
        ambient: ColorLike = (0.1, 0.1, 0.1),
        light_clamp: Sequence[float] | None = None,
        exposure: float = 0.0,
    ) -> None:
        super().__init__(background, ambient, light_clamp, exposure)
        self._arrays = NodeArrays()
        self._objects = ObjectTable()
        self._ids = itertools.count()
        self._removed = 0  # slots of removed nodes
        self._removed_lately = 0  # of these, since slots were last given up
        self._gone: WeakSet[Node] = WeakSet()  # nodes that were removed, but for those below them
        self._removals = 0  # how often a node, or what it held, went
        self._cameras: dict[int, Node] = {}
        self._lights: dict[int, Node] = {}
        self._colliders: dict[int, Node] = {}
        self._placed_colliders = None  # made when asked for
        self._nodes: tuple[Node, ...] | None = ()  # these two are made when asked for
        self._names: dict[str, Node] | None = None
        self._renames = 0  # how often a node got another name
        self._posing: Posing | None = None  # made when a mesh is first bent
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
    def animator(self) -> Animator | None:
        return self._animator

    @animator.setter
    def animator(self, value: Animator | None) -> None:
        # Only an Animator has motions; its module builds on this one.
        fits = value is None or (hasattr(value, "_motions") and value._scene is self)
        if not fits:
            raise InvalidArgumentError("animator must be an Animator of this scene, or None")
        self._animator = value

    @hinted
    def add(
        self,
        obj: SceneObject | None = None,
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
        """Put an object into the scene.

        Parameters
        ----------
        obj : Mesh, InstancedMesh, Camera, a light of any kind, or None
            The same object may be added many times. None adds a node that groups others, or gets
            its ``object`` later.
        name : str, optional
            The object's own name if left out.
        parent : Node, optional
            A node of this scene; the new node moves with it.
        pose : (4, 4) float, optional
            parent-from-node; or give the parts instead:
        translation : (3,) float, optional
        rotation : (4,) float, optional
            Quaternion x, y, z, w.
        euler : (3,) float, optional
            Instead of ``rotation``: angles in radians about x, y and z. Turns about x, then about
            the new y, then about the newest z, as `Node.euler` and three.js do; degrees go through
            ``numpy.radians``.
        scale : float or (3,) float, optional
        static : bool
            The node is meant to stay where it is; see `Node.static`.
        cast_shadows, receive_shadows : bool
            See `Node.cast_shadows`.

        Returns
        -------
        node : Node

        Raises
        ------
        InvalidArgumentError
        """
        _check_object(obj)
        if parent is not None and not (isinstance(parent, Node) and parent._scene is self):
            raise InvalidArgumentError(f"parent must be a node of this scene, not {shown(parent)}")
        if name is None:
            name = getattr(obj, "name", "")
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
        node = Node(self, obj, text(name, "name"), next(self._ids))
        above = -1 if parent is None else parent._slot
        node._arrays = self._arrays
        slot = node._slot = self._arrays.append(node, above, self._objects.take(obj), node.id)
        if pose is not None:
            self._arrays.set_pose(slot, pose)
        if translation is not None:
            self._arrays.set_translation(slot, translation)
        if rotation is not None or scale is not None:
            self._arrays.set_parts(slot, rotation, scale)
        if flag(static, "static"):
            node.static = True
        node.cast_shadows, node.receive_shadows = cast_shadows, receive_shadows
        self._list(node)
        self._nodes = None
        if self._names is not None:
            self._names.setdefault(node._name, node)
        return node

    def _list(self, node: Node) -> None:
        """Keep the nodes of cameras and of lights, in the order in which the nodes were added."""
        listed = self._cameras if isinstance(node.object, Camera) else self._lights
        if isinstance(node.object, (Camera, *LIGHTS)):
            last = max(listed, default=-1)
            listed[node.id] = node
            if node.id < last:
                ordered = dict(sorted(listed.items()))
                listed.clear()
                listed.update(ordered)

    def _put(self, node: Node, obj) -> None:
        """Let a node hold another object."""
        _check_object(obj)
        node._object = obj
        self._show(node)
        self._cameras.pop(node.id, None)
        self._lights.pop(node.id, None)
        self._list(node)
        self._removals += 1

    def _show(self, node: Node) -> None:
        """Let a node draw what it holds, as its skin and its morph weights bend it."""
        posed, before = posed_for(node), node._drawn
        looks = may_bend(node)
        if looks and self._posing is None:
            self._posing = Posing()
        drawn = node._object if posed is None else posed
        number = self._objects.take(drawn)
        self._objects.release(before)
        node._posed, node._drawn = posed, drawn
        self._arrays.set_object(node._slot, number)
        if self._posing is not None:
            (self._posing.take if looks else self._posing.leave)(node)
        self._placed_colliders = None

    def _set_skin(self, node: Node, skin: Skin | None) -> None:
        """Let joints bend what a node holds."""
        node._skin = check_skin(skin, node)
        self._show(node)

    def _set_morph_weights(self, node: Node, weights: ArrayLike | None) -> None:
        """Let a node add morph targets to its mesh."""
        node._morph_weights = check_morph_weights(weights, node._object)
        if node._posed is not None and node._morph_weights is not None:
            set_weights(node._posed, node._morph_weights)
            self._arrays.changes += 1
        else:
            self._show(node)

    def remove(self, node: Node) -> None:
        """Take a node and everything below it out of the scene; see `restore`.

        Raises
        ------
        InvalidArgumentError
            The node is not in this scene.
        """
        if not isinstance(node, Node) or node._scene is not self:
            raise InvalidArgumentError(f"node must be one of this scene, not {_unfound(node)}")
        arrays, taken = self._arrays, []
        for slot in arrays.remove(node._slot):
            gone, arrays.nodes[slot] = arrays.nodes[slot], None
            taken.append(gone)
            gone._scene = None
            self._objects.release(gone._drawn)
            self._cameras.pop(gone.id, None)
            self._lights.pop(gone.id, None)
            self._colliders.pop(gone.id, None)
        node._taken = tuple(taken[1:])
        for below in node._taken:
            below._taken_with = node
        self._gone.add(node)
        self._removed += len(taken)
        self._removed_lately += len(taken)
        self._removals += 1
        self._nodes = self._names = None
        if self._removed_lately > max(_LEAST_REMOVED, arrays.count // 2):
            self._pack()

    def restore(
        self, node: Node, *, parent: Node | None = None, before: Node | None = None
    ) -> None:
        """Put a removed node back, with everything that was below it when it was removed.

        All of them keep their ids, and so their places in the order of drawing, and what they were
        given meanwhile.

        Parameters
        ----------
        node : Node
            What `remove` was called with.
        parent : Node, optional
            The node that it hangs under from now on; left out, the scene itself.
        before : Node, optional
            As in `Node.reparent`.

        Raises
        ------
        InvalidArgumentError
            The node was not removed from this scene, or only together with one above it; or the
            parent does not fit.
        """
        if not isinstance(node, Node) or node not in self._gone:
            raise InvalidArgumentError(
                f"node must be one that was removed from this scene, not {_unfound(node)}"
            )
        taken, arrays = (node, *node._taken), self._arrays
        for slot, back in zip(arrays.restore(node._slot), taken, strict=True):
            arrays.nodes[slot] = back
            back._scene, back._taken_with = self, None
            arrays.set_object(slot, self._objects.take(back._drawn))
            self._list(back)
            self._set_collider(back)
        self._gone.discard(node)
        node._taken = ()
        self._removed -= len(taken)
        self._removals += 1
        self._nodes = self._names = None
        try:
            node.reparent(parent, before=before)
        except InvalidArgumentError:
            self.remove(node)
            raise

    def _pack(self) -> None:
        """Give up the slots of removed nodes that nobody holds any more."""
        gone = [node for top in self._gone for node in (top, *top._taken)]
        self._arrays, slots = self._arrays.packed([node._slot for node in gone])
        self._removed, self._removed_lately = len(gone), 0
        for node in (*filter(None, self._arrays.nodes), *gone):
            node._arrays, node._slot = self._arrays, int(slots[node._slot])

    @property
    def nodes(self) -> tuple[Node, ...]:
        """All nodes, in the order they were added."""
        nodes = self._nodes
        if nodes is None:
            nodes = tuple(node for node in self._arrays.nodes if node is not None)
            self._nodes = nodes
        return nodes

    def _camera_node(self) -> Node | None:
        """The first visible node that holds a camera: what is drawn through by default."""
        return next((node for node in self._cameras.values() if node.shown), None)

    @checks_types
    def find(self, name: str) -> Node | None:
        """Return the first node of that name, or None where there is none."""
        names = self._names
        if names is None:
            names = {}
            for node in self.nodes:
                names.setdefault(node.name, node)
            self._names = names  # whole: another thread may ask meanwhile
        return names.get(name)

    def select(self, nodes: Iterable[Node] | None = None) -> NodeSelection:
        """Return a selection of nodes, to read or to move them together as arrays.

        Parameters
        ----------
        nodes : iterable of Node, optional
            All nodes of the scene, as they are now, if left out.

        Returns
        -------
        selection : NodeSelection

        Raises
        ------
        InvalidArgumentError
            A node is not in this scene; also later, once one was removed.
        """
        if nodes is not None and not isinstance(nodes, Iterable):
            raise InvalidArgumentError(f"nodes must be an iterable of Node, not {nodes!r}")
        return NodeSelection(self, self.nodes if nodes is None else nodes)

    def _set_collider(self, node: Node) -> None:
        """Keep the nodes that have colliders, in the order of adding."""
        self._placed_colliders = None
        if node.collider is None:
            self._colliders.pop(node.id, None)
        elif node.id not in self._colliders:
            self._colliders[node.id] = node
            self._colliders = dict(sorted(self._colliders.items()))

    def _census(self) -> tuple[int, int]:
        """Return numbers that differ once a node has come or gone."""
        return self._arrays.count, self._removals

    def _node_of(self, number: int) -> Node | None:
        """The node of an id, if it is in the scene."""
        ids = self._arrays.columns["id"][: self._arrays.count]
        slot = int(np.searchsorted(ids, number))
        return self._arrays.nodes[slot] if slot < len(ids) and ids[slot] == number else None

    def _update(self, threads: int = 1) -> None:
        """Make world poses, visibility and bounds of all nodes true; threads: 0 is all."""
        if self._posing is not None:
            self._posing.update(self, threads)
        self._objects.refresh(self._arrays)
        self._arrays.update(self._objects.boxes, threads)

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The box around all visible meshes, (2, 3) float64 in world space; zeros if none."""
        self._update()
        box = np.empty(OBJECT_BOX)
        around = union(self._arrays.columns["bounds"][: self._arrays.count], box)
        return box[:6].reshape(2, 3) if around else np.zeros((2, 3))

    @checks_types
    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene to a file; see `engine3d.save_scene`."""
        from ...io.writing.scene_saving import save_scene

        save_scene(self, path)

    def __reduce_ex__(self, protocol):
        raise TypeError("a Scene cannot be copied or pickled: add its objects to another Scene")

    def _repr_png_(self) -> bytes | None:
        """A picture for notebooks; see `thumbnail`."""
        from ...rendering.thumbnail import thumbnail

        return thumbnail(self)

    def __repr__(self) -> str:
        return f"Scene({self._arrays.count - self._removed} nodes)"


def _take_animations(scene: Scene, clips: dict, put: Callable[[dict], None]) -> None:
    """Let a scene's own dict hold other clips."""
    from ..motion.clips import check_clips

    put(check_clips(clips))


def _unfound(node) -> str:
    """Return what was given for a node: mostly the result of `Scene.find` for an unknown name."""
    return "None, which find() returns of an unknown name" if node is None else shown(node)


def _check_object(obj) -> None:
    if obj is not None and not isinstance(obj, _OBJECT_TYPES):
        allowed = ", ".join(kind.__name__ for kind in _OBJECT_TYPES)
        raise InvalidArgumentError(f"obj must be {allowed} or None (a group), not {shown(obj)}")
