"""The nodes of a scene whose meshes are bent, and what of them has to be posed anew.

In: nodes with skins or weights of morph targets. Out: posed meshes, which the scene's arrays draw
instead of the meshes at rest, and their boxes. What did not move is not posed again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakValueDictionary

import numpy as np

from .._native.rasterizer import NativePose, pose_meshes
from ..errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..materials.colors import float32_of
from .posed_mesh import PosedMesh
from .skeletons import WORLD, skeleton_of
from .skins import Skin

if TYPE_CHECKING:
    from ..scene.nodes import Node
    from ..scene.scene import Scene


class Posing:
    """The posed nodes of one scene.

    Attributes
    ----------
    moment : int
        Grows whenever a mesh was posed anew.
    numbers : (N,) int32
        The objects of `ObjectTable` that are posed.
    poses : list of NativePose
        Of each.
    """

    def __init__(self) -> None:
        self.moment = 0
        self.numbers = np.empty(0, np.int32)
        self.poses: list[NativePose] = []
        self._nodes: WeakValueDictionary[int, Node] = WeakValueDictionary()
        self._posed: list[PosedMesh] = []
        self._linked: tuple | None = None  # the arrays and the links that skeletons are of
        self._changes = -1

    def take(self, node: Node) -> None:
        """Look at a node from now on; what it shows is posed."""
        self._nodes[node.id] = node
        self._linked = None

    def leave(self, node: Node) -> None:
        """Look at a node no longer."""
        if self._nodes.pop(node.id, None) is not None:
            self._linked = None

    def update(self, scene: Scene, threads: int) -> None:
        """Pose what moved since the last time."""
        arrays = scene._arrays
        renewed = [posed.renew() for posed in self._posed]
        if any(renewed) or self._linked != (arrays, arrays.links):
            self._link(scene)
        if arrays.changes == self._changes and not any(renewed):
            return
        moved = pose_meshes(self.poses, arrays.columns["pose"], threads)
        if moved:
            boxes = np.array([self._posed[number].box() for number in moved])
            arrays.renew_boxes(scene._objects, self.numbers[moved], boxes)
            scene._objects.forget_shapes()
            arrays.changes += 1
            self.moment += 1
        self._changes = arrays.changes

    def _link(self, scene: Scene) -> None:
        """Find the joints of all skins in the tree as it is now."""
        arrays = scene._arrays
        known = sorted(self._nodes.items())
        nodes = [node for _, node in known if node._scene is scene]
        self._posed = [node._posed for node in nodes]
        self.poses = [posed.native for posed in self._posed]
        numbers = [scene._objects.number_of(posed) for posed in self._posed]
        self.numbers = np.array(numbers, np.int32)
        slots, anchors = [], []
        for node in nodes:
            if node._morph_weights is not None:
                set_weights(node._posed, node._morph_weights)
            anchor = self._find_joints(node, scene)
            if anchor is not None:
                slots.append(node._slot)
                anchors.append(node._slot if anchor == WORLD else anchor)
        arrays.place_by(np.array(slots, np.int32), np.array(anchors, np.int32))
        self._linked = arrays, arrays.links
        self._changes = -1
        self.moment += 1

    def _find_joints(self, node: Node, scene: Scene) -> int | None:
        """Tell a node's pose its joints; return the anchor's slot, or None without a skin."""
        skin, native = node._skin, node._posed.native
        fits = skin is not None and 0 < native.rest.joints <= len(skin.joints)
        if not fits or any(joint._scene is not scene for joint in skin.joints):
            native.forget_skeleton()  # the mesh became another, or joints were removed
            return None
        skeleton = skeleton_of(skin, scene._arrays)
        native.set_skeleton(*skeleton[1:])
        return -1 if skeleton.anchor == node._slot else skeleton.anchor


def check_skin(value: Skin | None, node: Node) -> Skin | None:
    """Check a skin for a node."""
    if value is None:
        return None
    if not isinstance(value, Skin):
        raise InvalidArgumentError(f"skin must be a Skin or None, not {type(value).__name__}")
    if value.joints[0]._scene is not node._scene:
        raise InvalidArgumentError("the joints of a skin must be nodes of the node's scene")
    check_fit(node._object, value)
    return value


def check_fit(obj, skin: Skin) -> None:
    """Check that a skin has the joints that an object refers to."""
    if not isinstance(obj, Mesh) or obj.joints is None:
        raise InvalidArgumentError("a skin needs a Mesh with joints and weights")
    used = int(obj.joints[obj.weights != 0].max(initial=0)) + 1
    if used > len(skin.joints):
        raise InvalidArgumentError(
            f"the mesh refers to joint {used - 1}, but the skin has {len(skin.joints)} joints"
        )


def check_morph_weights(value, obj) -> np.ndarray | None:
    """Check weights of an object's morph targets: a read-only (T,) float64 array."""
    if value is None:
        return None
    targets = obj.morph_targets if isinstance(obj, Mesh) else ()
    from .._support.validation import frozen_floats

    return frozen_floats(value, "morph_weights", (len(targets),))


def posed_for(node: Node) -> PosedMesh | None:
    """Return what a node shows instead of its mesh, or None for the mesh itself."""
    mesh, posed = node._object, node._posed
    if not isinstance(mesh, Mesh):
        return None
    bent = node._skin is not None and mesh.joints is not None
    if not bent and (node._morph_weights is None or not mesh.morph_targets):
        return None
    if posed is None or posed.mesh is not mesh:
        posed = PosedMesh(mesh)
    if node._morph_weights is not None:
        set_weights(posed, node._morph_weights)
    return posed


def set_weights(posed: PosedMesh, weights: np.ndarray) -> None:
    """Give a posed mesh its weights, if its targets are still those."""
    if posed.native.rest.targets == len(weights):
        posed.native.set_weights(float32_of(weights))
