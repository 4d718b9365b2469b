"""The nodes of a scene whose meshes are deformed, and which of them must be posed again.

In: nodes with skins or morph weights. Out: posed meshes, which the scene's arrays draw instead of
the meshes at rest, and their boxes. Only what moved is posed again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any
from weakref import WeakValueDictionary

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..._native.rasterizer import NativePose, pose_meshes
from ...base.dirty_tracking import Watch
from ...errors import InvalidArgumentError
from ..geometry.mesh import Mesh
from ..materials.colors import float32_of
from ..motion.posed_mesh import PosedMesh
from ..motion.skeletons import WORLD, skeleton_of
from ..motion.skins import Skin

if TYPE_CHECKING:
    from .nodes import Node
    from .scene_data import SceneData


class Posing:
    """The posed nodes of one scene.

    Attributes
    ----------
    moment : int
        Grows whenever a mesh is posed anew.
    numbers : (N,) int32
        The posed objects' numbers in `ObjectTable`.
    poses : list of NativePose
        The pose of each.
    """

    def __init__(self) -> None:
        self.moment = 0
        self.numbers = np.empty(0, np.int32)
        self.poses: list[NativePose] = []
        self._nodes: WeakValueDictionary[int, Node] = WeakValueDictionary()
        self._here: list[Node] = []  # those in the scene, by ID
        self._watch = Watch()  # of their meshes
        self._posed: list[PosedMesh] = []
        # The arrays and links that the skeletons were found in.
        self._linked: tuple[Any, ...] | None = None
        self._changes = -1

    def take(self, node: Node) -> None:
        """Start to track a node that has a skin or morph weights."""
        self._nodes[node.id] = node
        self._linked = None

    def leave(self, node: Node) -> None:
        """Stop tracking a node."""
        if self._nodes.pop(node.id, None) is not None:
            self._linked = None

    def update(self, data: SceneData, threads: int) -> None:
        """Pose everything that moved since the last call."""
        arrays = data.arrays
        is_other_tree = self._linked != (arrays, arrays.links)
        if is_other_tree:
            self._find_nodes()
        changed = self._watch.found()
        if is_other_tree or changed:
            # Meshes first: the links below depend on them.
            are_others = self._follow_meshes(data)
            if is_other_tree or are_others:
                self._link(data)
            for mesh, version in changed:
                self._watch.saw(mesh, version)
        if arrays.changes == self._changes:
            return
        moved = pose_meshes(self.poses, arrays.columns["pose"], threads)
        if moved:
            boxes = np.array([self._posed[number].box() for number in moved])
            arrays.renew_boxes(data.objects, self.numbers[moved], boxes)
            data.objects.forget_shapes()
            arrays.changes += 1
            self.moment += 1
        self._changes = arrays.changes

    def _find_nodes(self) -> None:
        """Find the nodes that are in the scene, and watch their meshes."""
        self._here = [node for _, node in sorted(self._nodes.items()) if node._scene is not None]
        self._watch = Watch(node._object for node in self._here)

    def _follow_meshes(self, data: SceneData) -> bool:
        """Switch nodes between posed and plain meshes; return whether any changed."""
        are_others = False
        for node in self._here:
            drawn = node._drawn
            if _is_bent(node) != isinstance(drawn, PosedMesh):
                data.show(node)
                are_others = True
            elif isinstance(drawn, PosedMesh) and drawn.renew():
                are_others = True
        return are_others

    def _link(self, data: SceneData) -> None:
        """Find the joints of all skins in the current tree."""
        arrays = data.arrays
        drawn = [(node, node._drawn) for node in self._here]
        placed = [(node, posed) for node, posed in drawn if isinstance(posed, PosedMesh)]
        self._posed = [posed for _, posed in placed]
        self.poses = [posed.native for posed in self._posed]
        numbers = [data.objects.number_of(posed) for posed in self._posed]
        self.numbers = np.array(numbers, np.int32)
        slots, anchors = [], []
        for node, posed in placed:
            set_weights(posed, node._morph_weights)
            anchor = self._find_joints(node, posed.native, data)
            if anchor is not None:
                slots.append(node._slot)
                anchors.append(node._slot if anchor == WORLD else anchor)
        arrays.place_by(np.array(slots, np.int32), np.array(anchors, np.int32))
        self._linked = arrays, arrays.links
        self._changes = -1
        self.moment += 1

    def _find_joints(self, node: Node, native: NativePose, data: SceneData) -> int | None:
        """Set the joints of a node's pose; return the anchor's slot, or None without a skin."""
        skin = node._skin
        joints: list[int] = [] if skin is None else data.slots_of(skin.joints).tolist()
        if skin is None or -1 in joints or not 0 < native.rest.joints <= len(joints):
            native.forget_skeleton()  # the mesh was replaced, or joints were removed
            return None
        skeleton = skeleton_of(skin, joints, data.arrays.columns["parent"])
        native.set_skeleton(*skeleton[1:])
        return -1 if skeleton.anchor == node._slot else skeleton.anchor


def check_skin(value: Skin | None, node: Node) -> Skin | None:
    """Check that a value is a skin of the node's scene, or None."""
    if value is None:
        return None
    if not isinstance(value, Skin):
        raise InvalidArgumentError(f"skin must be a Skin or None, not {type(value).__name__}")
    if value.joints[0]._scene is not node._scene:
        raise InvalidArgumentError("the joints of a skin must be nodes of the node's scene")
    check_fit(node._object, value)
    return value


def check_fit(obj: Any, skin: Skin) -> None:
    """Check that a skin has all the joints that an object refers to."""
    if not isinstance(obj, Mesh) or obj.joints is None:
        raise InvalidArgumentError("a skin needs a Mesh with joints and weights")
    used = int(obj.joints[obj.weights != 0].max(initial=0)) + 1
    if used > len(skin.joints):
        raise InvalidArgumentError(
            f"the mesh refers to joint {used - 1}, but the skin has {len(skin.joints)} joints"
        )


def check_morph_weights(value: ArrayLike | None, obj: Any) -> NDArray[np.float64] | None:
    """Return the weights of an object's morph targets, checked: read-only (T,) float64."""
    if value is None:
        return None
    targets = obj.morph_targets if isinstance(obj, Mesh) else ()
    from ...base.validation import frozen_floats

    return frozen_floats(value, "morph_weights", (len(targets),))


def may_bend(node: Node) -> bool:
    """Return whether a node holds a mesh and has a skin or morph weights."""
    has_means = node._skin is not None or node._morph_weights is not None
    return has_means and isinstance(node._object, Mesh)


def _is_bent(node: Node) -> bool:
    """Return whether a node shows its mesh deformed."""
    mesh = node._object
    if not isinstance(mesh, Mesh):
        return False
    bends = node._skin is not None and mesh.joints is not None
    return bends or (node._morph_weights is not None and len(mesh.morph_targets) > 0)


def posed_for(node: Node) -> PosedMesh | None:
    """Return the posed mesh that a node shows, or None if it shows the mesh itself."""
    posed, mesh = node._drawn, node._object
    if not isinstance(mesh, Mesh) or not _is_bent(node):
        return None
    if not isinstance(posed, PosedMesh) or posed.mesh is not mesh:
        posed = PosedMesh(mesh)
    set_weights(posed, node._morph_weights)
    return posed


def set_weights(posed: PosedMesh, weights: NDArray[np.float64] | None) -> None:
    """Set a posed mesh's weights; zeros if there are none or their number does not fit."""
    targets = posed.native.rest.targets
    if weights is None or len(weights) != targets:
        weights = np.zeros(targets)
    posed.native.set_weights(float32_of(weights))
