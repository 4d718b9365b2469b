"""The internal data of a scene's nodes, for posing, drawing, queries and saving.

In: nodes that come, go and change objects. Out: their arrays, the objects they draw, and which of
them hold lights, cameras or colliders. Counters of changes let users of the data renew only what
they must.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any
from weakref import WeakSet

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.scene_graph import OBJECT_BOX, union
from ...base.named_things import NamedThings
from ...base.numbers import shown
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..motion.posed_mesh import PosedMesh
from ._objects import ObjectTable
from ._posing import (
    Posing,
    check_morph_weights,
    check_skin,
    may_bend,
    posed_for,
    set_weights,
)
from .cameras import Camera
from .instances import InstancedMesh
from .lights import LIGHTS
from .node_arrays import CASTS_NONE, RECEIVES_NONE, NodeArrays
from .nodes import Node

if TYPE_CHECKING:
    from ..materials.material import Finish, Material
    from ..materials.textures import Reading
    from ..motion.robots import Robot
    from ..motion.skins import Skin
    from .nodes import SceneObject
    from .scene import Scene

_OBJECT_TYPES = (Mesh, InstancedMesh, Camera, *LIGHTS)
_LEAST_REMOVED = 1024  # fewer slots of removed nodes are not worth packing


class SceneData:
    """Internal data of one scene's nodes: `Scene.data`.

    For the engine's own parts, not for programs: it may change in any version, and nothing in it is
    checked.

    Attributes
    ----------
    arrays : NodeArrays
        A row per node. Packing removed nodes replaces the arrays.
    objects : ObjectTable
        The objects that nodes draw.
    posing : Posing or None
        The nodes with deformed meshes; None until there is one.
    cameras, lights, colliders : dict of int to Node
        The nodes that hold one, by ID, in the order of adding.
    robots : dict of str to Robot
        The robots whose links are nodes, by name.
    placed_colliders : object
        Data of collider_queries.py about the colliders; None once they change.
    removals : int
        How often a node or its object was removed.
    renames : int
        How often a node was renamed.
    untextured : frozenset of Material
        Materials drawn without their textures.
    reading : callable or None
        Returns with which anisotropy and bias a texture is read; None is its own.
    finish : callable or None
        Returns the material that is drawn for one of a `Mesh`, called with that material and
        whether it is tinted: by colours of vertices or instances; points and lines alone count as
        tinted. None draws it as it is. It must keep textures, flat shading and the alpha mode.
    """

    untextured: frozenset[Material] = frozenset()
    reading: Reading | None = None
    finish: Finish | None = None

    def __init__(self) -> None:
        self.arrays = NodeArrays()
        self.objects = ObjectTable()
        self.posing: Posing | None = None
        self.cameras: dict[int, Node] = {}
        self.lights: dict[int, Node] = {}
        self.colliders: dict[int, Node] = {}
        self.robots: NamedThings[Robot] = NamedThings("robot")
        self.placed_colliders: Any = None
        self.removals = self.renames = 0
        self._ids = itertools.count()
        self._removed = 0  # slots of removed nodes
        self._removed_lately = 0  # of these, since the last packing
        self._gone: WeakSet[Node] = WeakSet()  # removed nodes, without their descendants
        self._nodes: tuple[Node, ...] | None = ()  # both are computed on demand
        self._names: dict[str, Node] | None = None

    @property
    def node_count(self) -> int:
        """Number of nodes in the scene."""
        return self.arrays.count - self._removed

    @property
    def nodes(self) -> tuple[Node, ...]:
        """All nodes, in the order of adding."""
        nodes = self._nodes
        if nodes is None:
            nodes = tuple(node for node in self.arrays.nodes if node is not None)
            self._nodes = nodes
        return nodes

    def find(self, name: str) -> Node | None:
        """Return the first node with a name, or None."""
        names = self._names
        if names is None:
            names = {}
            for node in self.nodes:
                names.setdefault(node.name, node)
            self._names = names  # assigned when complete: another thread may read it meanwhile
        return names.get(name)

    def node_of(self, number: int) -> Node | None:
        """Return the node with an ID, if it is in the scene."""
        ids = self.arrays.columns["id"][: self.arrays.count]
        slot = int(np.searchsorted(ids, number))
        return self.arrays.nodes[slot] if slot < len(ids) and ids[slot] == number else None

    def slots_of(self, nodes: Iterable[Node]) -> NDArray[np.int32]:
        """Return the rows of nodes in ``arrays``, -1 for nodes not in the scene."""
        arrays = self.arrays
        slots = [
            node._slot if node._arrays is arrays and node._scene is not None else -1
            for node in nodes
        ]
        return np.array(slots, np.int32)

    def names(self) -> list[str]:
        """Return the name of each row of ``arrays``, empty for removed nodes."""
        return ["" if node is None else node._name for node in self.arrays.nodes]

    def camera_node(self) -> Node | None:
        """Return the first visible node with a camera, which is the default for drawing."""
        for node in self.cameras.values():
            if node.shown:
                return node
        return None

    def placed_lights(self) -> list[tuple[Any, int]]:
        """Return the lights, each with the slot of its node."""
        return [(node._object, node._slot) for node in list(self.lights.values())]

    def lights_state(self) -> tuple[Any, ...]:
        """Return a state that differs once `placed_lights` change or move in the arrays."""
        return self.arrays, self.removals, len(self.lights)

    def census(self) -> tuple[Any, ...]:
        """Return a state that differs once a node has come or gone."""
        return self.arrays.count, self.removals

    def update(self, threads: int = 1) -> None:
        """Update world poses, visibility and bounds of all nodes; threads: 0 is all."""
        if self.posing is not None:
            self.posing.update(self, threads)
        self.objects.refresh(self.arrays)
        self.arrays.update(self.objects.boxes, threads)

    def bounds(self) -> NDArray[np.float64]:
        """Return the box around all visible meshes, (2, 3) in world space; zeros if none."""
        self.update()
        return box_around(self.arrays)

    def shadow_bounds(self) -> NDArray[np.float64]:
        """Return the box, as `bounds`, of all that casts or receives shadows."""
        self.update()
        return box_of_shadows(self.arrays)

    def add(self, scene: Scene, obj: SceneObject | None, name: str, parent: Node | None) -> Node:
        """Add a node to the scene, at its parent's pose."""
        node = Node(scene, obj, name, next(self._ids))
        above = -1 if parent is None else parent._slot
        node._slot = self.arrays.append(node, above, self.objects.take(obj), node.id)
        self._list(node)
        self._nodes = None
        if self._names is not None:
            self._names.setdefault(name, node)
        return node

    def remove(self, node: Node) -> None:
        """Remove a node and its subtree; each keeps its slot as long as anybody holds the node."""
        arrays, taken = self.arrays, []
        for slot in arrays.remove(node._slot):
            gone, arrays.nodes[slot] = arrays.nodes[slot], None
            taken.append(gone)
            gone._scene = None
            self.objects.release(gone._drawn)
            for listed in (self.cameras, self.lights, self.colliders):
                listed.pop(gone.id, None)
        node._taken = tuple(taken[1:])
        for below in node._taken:
            below._taken_with = node
        self._gone.add(node)
        self._removed += len(taken)
        self._removed_lately += len(taken)
        self.removals += 1
        self._nodes = self._names = None
        if self._removed_lately > max(_LEAST_REMOVED, arrays.count // 2):
            self._pack()

    def may_restore(self, node: Node) -> bool:
        """Return whether `remove` was called with a node that has not come back."""
        return node in self._gone

    def removed_with(self, node: Node) -> Node:
        """Return the node that `remove` was called with when this node was removed."""
        return node if node._taken_with is None else node._taken_with

    def restore(self, scene: Scene, node: Node) -> None:
        """Restore a removed node to the scene, with the subtree removed with it."""
        taken, arrays = (node, *node._taken), self.arrays
        for slot, back in zip(arrays.restore(node._slot), taken, strict=True):
            arrays.nodes[slot] = back
            back._scene, back._taken_with = scene, None
            arrays.set_object(slot, self.objects.take(back._drawn))
            self._list(back)
            self.list_collider(back)
        self._gone.discard(node)
        node._taken = ()
        self._removed -= len(taken)
        self.removals += 1
        self._nodes = self._names = None

    def _pack(self) -> None:
        """Free the slots of removed nodes that nobody holds any more."""
        gone = [node for top in self._gone for node in (top, *top._taken)]
        self.arrays, slots = self.arrays.packed([node._slot for node in gone])
        self._removed, self._removed_lately = len(gone), 0
        for node in (*filter(None, self.arrays.nodes), *gone):
            node._arrays, node._slot = self.arrays, int(slots[node._slot])

    def _list(self, node: Node) -> None:
        """Register nodes with cameras and lights, in the order of adding."""
        listed = self.cameras if isinstance(node._object, Camera) else self.lights
        if isinstance(node._object, (Camera, *LIGHTS)):
            last = max(listed, default=-1)
            listed[node.id] = node
            if node.id < last:
                ordered = dict(sorted(listed.items()))
                listed.clear()
                listed.update(ordered)

    def list_collider(self, node: Node) -> None:
        """Register nodes with colliders, in the order of adding."""
        self.placed_colliders = None
        if node.collider is None:
            self.colliders.pop(node.id, None)
        elif node.id not in self.colliders:
            self.colliders[node.id] = node
            self.colliders = dict(sorted(self.colliders.items()))

    def forget_names(self) -> None:
        """Drop the cached names, because a node was renamed."""
        self._names = None
        self.renames += 1

    def hold(self, node: Node, obj: SceneObject | None) -> None:
        """Replace the object that a node holds."""
        check_object(obj)
        node._object = obj
        self.show(node)
        self.cameras.pop(node.id, None)
        self.lights.pop(node.id, None)
        self._list(node)
        self.removals += 1

    def show(self, node: Node) -> None:
        """Update what a node draws: its object, deformed by its skin and morph weights."""
        before, looks = node._drawn, may_bend(node)
        if looks and self.posing is None:
            self.posing = Posing()
        posed = posed_for(node)
        drawn = node._object if posed is None else posed
        number = self.objects.take(drawn)
        self.objects.release(before)
        node._drawn = drawn
        self.arrays.set_object(node._slot, number)
        if self.posing is not None:
            (self.posing.take if looks else self.posing.leave)(node)
        self.placed_colliders = None

    def show_as(self, node: Node, other: Node) -> None:
        """Show a node under another node's ID in frames."""
        self.arrays.columns["object_id"][node._slot] = other.id
        self.arrays.changes += 1

    def set_skin(self, node: Node, skin: Skin | None) -> None:
        """Set the skin that deforms a node's mesh."""
        node._skin = check_skin(skin, node)
        self.show(node)

    def set_morph_weights(self, node: Node, weights: ArrayLike | None) -> None:
        """Set a node's morph weights."""
        node._morph_weights = check_morph_weights(weights, node._object)
        if isinstance(node._drawn, PosedMesh) and node._morph_weights is not None:
            set_weights(node._drawn, node._morph_weights)
            self.arrays.changes += 1
        else:
            self.show(node)


def box_around(arrays: Any) -> NDArray[np.float64]:
    """Return the box around the visible objects of given rows, as of the last update."""
    box = np.empty(OBJECT_BOX)
    around = union(arrays.columns["bounds"][: arrays.count], box)
    return box[:6].reshape(2, 3) if around else np.zeros((2, 3))


def box_of_shadows(arrays: Any) -> NDArray[np.float64]:
    """Return `box_around` what casts or receives shadows."""
    columns, count = arrays.columns, arrays.count
    takes_part = columns["unshadowed"][:count] != CASTS_NONE | RECEIVES_NONE
    if takes_part.all():
        return box_around(arrays)
    box = np.empty(OBJECT_BOX)
    around = union(np.ascontiguousarray(columns["bounds"][:count][takes_part]), box)
    return box[:6].reshape(2, 3) if around else np.zeros((2, 3))


def check_object(obj: Any) -> None:
    """Check that a node can hold an object."""
    if obj is not None and not isinstance(obj, _OBJECT_TYPES):
        if hasattr(type(obj), "add_to"):  # several nodes
            kind = type(obj).__name__
            raise InvalidArgumentError(f"a {kind} is several nodes: add it by scene.add")
        allowed = ", ".join(kind.__name__ for kind in _OBJECT_TYPES)
        raise InvalidArgumentError(f"obj must be {allowed} or None (a group), not {shown(obj)}")
