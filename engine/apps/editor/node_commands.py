"""Commands on the tree: add, delete, duplicate, reparent, move.

Nodes keep their handles and IDs through undo and redo.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterable, Mapping, Sequence

from ...base import linalg
from ...base.language import translated, translated_count
from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.motion.skins import Skin
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node, next_sibling, with_below
from ...model.scene.placements import Placements
from ...model.scene.scene import Scene
from ...model.scene.selection import NodeSelection
from .history import Command
from .motion_copies import motions_in, move_alike, put_motions
from .new_things.free_names import FreeNames
from .selection import topmost


def counted(what: str, nodes: Sequence[Node]) -> str:
    """Return a label: "Delete 'lamp'" for one node, "Delete 3 nodes" for several."""
    return f"{what} {named(nodes)}"


def named(nodes: Sequence[Node]) -> str:
    """Return what to call nodes: "'lamp'" for one, "3 nodes" for several."""
    if len(nodes) == 1:
        return repr(nodes[0].name)
    return translated_count("{count:,} node", "{count:,} nodes", len(nodes))


class AddNodes(Command):
    """Add nodes to a scene.

    Parameters
    ----------
    scene : Scene
    add : callable
        ``add(scene)`` adds the nodes, the first time; it may do nothing else to the scene.
    label : str
    """

    makes_nodes = True

    def __init__(self, scene: Scene, add: Callable[[Scene], object], label: str) -> None:
        self.label = label
        self._scene = scene
        self._add = add
        self._places: list[tuple[Node, Node | None]] | None = None

    def do(self) -> None:
        if self._places is None:
            self._add_first()
        else:
            for node, parent in self._places:
                self._scene.restore(node, parent=parent)
            put_motions(self._scene, self._motions[1])

    def _add_first(self) -> None:
        count, motions = len(self._scene.nodes), motions_in(self._scene)
        try:
            self._add(self._scene)
        except BaseException:
            for node in topmost(self._scene.nodes[count:]):
                self._scene.remove(node)
            put_motions(self._scene, motions)
            raise
        self._motions = motions, motions_in(self._scene)
        self.nodes = topmost(self._scene.nodes[count:])  # the latest ones are last
        self._places = [(node, node.parent) for node in self.nodes]

    def undo(self) -> None:
        for node, _ in reversed(self._places):
            self._scene.remove(node)
        put_motions(self._scene, self._motions[0])


class DeleteNodes(Command):
    """Deletes nodes with their subtrees."""

    def __init__(self, scene: Scene, nodes: Iterable[Node]) -> None:
        self.nodes = topmost(nodes)
        self.label = counted(translated("Delete"), self.nodes)
        self._scene = scene
        self._places: list[tuple[Node, Node | None, Node | None]] = []

    def do(self) -> None:
        self._places = []
        for node in self.nodes:
            self._places.append((node, node.parent, next_sibling(node)))
            self._scene.remove(node)

    def undo(self) -> None:
        for node, parent, sibling in reversed(self._places):
            self._scene.restore(node, parent=parent, before=sibling)


class DuplicateNodes(AddNodes):
    """Adds copies of nodes beside them, with their subtrees.

    Copies share meshes, have their own lights and cameras, and move as their originals.
    """

    def __init__(self, scene: Scene, nodes: Iterable[Node]) -> None:
        originals = topmost(nodes)

        def add(scene: Scene) -> None:
            parents = {node: node.parent for node in originals}
            copy_nodes(scene, parents, FreeNames(scene.data.names()))

        super().__init__(scene, add, counted(translated("Duplicate"), originals))


class Reparent(Command):
    """Moves nodes to another parent, by default without moving them in the world.

    Parameters
    ----------
    scene : Scene
    nodes : iterable of Node
    parent : Node or None
    before : Node, optional
        The child of the parent that they come before.
    keep_world_pose : bool
        False keeps their poses below the parent instead.
    """

    def __init__(
        self,
        scene: Scene,
        nodes: Iterable[Node],
        parent: Node | None,
        *,
        before: Node | None = None,
        keep_world_pose: bool = True,
    ) -> None:
        self.nodes = topmost(nodes)
        under = translated("the scene") if parent is None else repr(parent.name)
        moved = counted("Move", self.nodes)
        self.label = translated("{move} under {parent}", move=moved, parent=under)
        self._scene, self._parent, self._before = scene, parent, before
        self._keeps = keep_world_pose
        self._places: list[tuple[Node, Node | None, Node | None]] = []
        self._new: Placements | None = None

    def do(self) -> None:
        self._old = Placements(self._scene, self.nodes)
        self._places = []
        try:
            for node in self.nodes:
                place = node, node.parent, next_sibling(node)
                node.reparent(self._parent, keep_world_pose=self._keeps, before=self._before)
                self._places.append(place)
        except BaseException:
            self.undo()
            raise
        if self._new is not None:  # what moves stood elsewhere the first time
            self._new.put(self._scene)
        self._new = Placements(self._scene, self.nodes)

    def undo(self) -> None:
        for node, parent, sibling in reversed(self._places):
            node.reparent(parent, before=sibling)
        self._old.put(self._scene)


class GroupNodes(Command):
    """Puts nodes below a new one, which takes the place of the first."""

    makes_nodes = True

    def __init__(self, scene: Scene, nodes: Iterable[Node], name: str = "group") -> None:
        self._members = topmost(nodes)
        self.label = counted(translated("Group"), self._members)
        parent = self._members[0].parent
        free = FreeNames(scene.data.names()).free(name)
        self._add = AddNodes(scene, lambda scene: scene.add(name=free, parent=parent), "")
        self._scene = scene
        self._reparent: Reparent | None = None

    def do(self) -> None:
        self._add.do()
        self.nodes = self._add.nodes
        if self._reparent is None:
            self._reparent = Reparent(self._scene, self._members, self.nodes[0])
        try:
            self._reparent.do()
        except BaseException:
            self._add.undo()
            raise

    def undo(self) -> None:
        self._reparent.undo()
        self._add.undo()


class JoinNodes(Command):
    """Replaces the meshes of several nodes by a single one, and deletes the nodes.

    One mesh draws faster than many small ones. Children of the nodes are deleted with them.

    Parameters
    ----------
    scene : Scene
    nodes : iterable of Node
        At least one of them holds a Mesh; the others go as they are.
    """

    makes_nodes = True

    def __init__(self, scene: Scene, nodes: Iterable[Node]) -> None:
        chosen = [node for node in nodes if isinstance(node.object, Mesh)]
        if not chosen:
            raise InvalidArgumentError("none of the nodes holds a mesh to be joined")
        self.label = counted(translated("Join"), chosen)
        self._scene = scene
        name, meshes = chosen[0].name, [node.object for node in chosen]
        poses = [node.world_pose for node in chosen]
        self._add = AddNodes(
            scene, lambda scene: scene.add(Mesh.concatenate(meshes, name, poses=poses)), ""
        )
        self._delete = DeleteNodes(scene, chosen)

    def do(self) -> None:
        self._add.do()
        self._delete.do()
        self.nodes = self._add.nodes

    def undo(self) -> None:
        self._delete.undo()
        self._add.undo()


class MoveNodes(Command):
    """Moves, rotates or scales nodes.

    Parameters
    ----------
    scene : Scene
    nodes : iterable of Node
    move : callable
        ``move(selection)`` changes the poses of a `NodeSelection`, the first time.
    label : str, optional
    """

    def __init__(
        self,
        scene: Scene,
        nodes: Iterable[Node],
        move: Callable[[NodeSelection], object],
        label: str = "",
    ) -> None:
        self.nodes = tuple(nodes)
        self.label = label or counted(translated("Move"), self.nodes)
        self._scene, self._move = scene, move
        self._new: Placements | None = None

    def do(self) -> None:
        if self._new is not None:
            self._new.put(self._scene)
            return
        self._old = Placements(self._scene, self.nodes)
        try:
            self._move(self._scene.select(self.nodes))
        except BaseException:
            self._old.put(self._scene)
            raise
        self._new = Placements(self._scene, self.nodes)

    def undo(self) -> None:
        self._old.put(self._scene)

    def absorb(self, later: Command) -> bool:
        if not (isinstance(later, MoveNodes) and later.nodes == self.nodes):
            return False
        self._new = later._new
        return True


def in_world(matrix) -> Callable[[NodeSelection], None]:
    """Return a function for `MoveNodes` that moves nodes by a world matrix, (4, 4) float.

    A node below another of them moves only with that one.
    """

    def move(selection: NodeSelection) -> None:
        for node in topmost(selection.nodes):
            pose = linalg.multiply(matrix, node.world_pose)
            if node.parent is not None:
                pose = linalg.multiply(linalg.inverse(node.parent.world_pose), pose)
            node.pose = pose

    return move


def copy_nodes(
    scene: Scene, parents: Mapping[Node, Node | None], names: FreeNames | None = None
) -> tuple[Node, ...]:
    """Add copies of nodes of any other scene, or of the same one, with their subtrees.

    The copies keep the drawing order of the originals. They move and deform alike.

    Parameters
    ----------
    scene : Scene
    parents : dict of Node to Node or None
        The parents of the copies by their originals, none of which is below another.
    names : FreeNames, optional
        Of the scene: the copies of the given nodes get names that nothing else has. Without, they
        are called as the originals.

    Returns
    -------
    copies : tuple of Node
        Of the given nodes, in their order.
    """
    subtrees = [with_below(node) for node in parents]
    nodes = [node for subtree in subtrees for node in subtree]
    made = {
        original: _copied(scene, original)
        for subtree in subtrees
        for original in sorted(subtree, key=lambda original: original.id)
    }
    for original in nodes:  # parents first, siblings in their order
        is_top = original in parents
        made[original].reparent(parents[original] if is_top else made[original.parent])
    _bend_alike(made)
    move_alike(made)
    if names is not None:
        for original in parents:
            made[original].name = names.free(original.name)
    return tuple(made[node] for node in parents)


def _bend_alike(made: dict[Node, Node]) -> None:
    """Make copies deform like their originals: by copied joints, if these are copied."""
    skins: dict[Skin, Skin | None] = {}
    for original, twin in made.items():
        skin = original.skin
        if skin is not None and skin not in skins:
            skins[skin] = _skin_of_copies(skin, made, twin)
        twin.skin = None if skin is None else skins[skin]
        if original.morph_weights is not None:
            twin.morph_weights = original.morph_weights


def _skin_of_copies(skin: Skin, made: dict[Node, Node], twin: Node) -> Skin | None:
    """Return the skin for copies; None if a joint in another scene has no copy."""
    joints = [made.get(joint, joint) for joint in skin.joints]
    if any(joint.scene is not twin.scene for joint in joints):
        return None
    return Skin(joints, skin.inverse_binds, skin.name)


def _copied(scene: Scene, node: Node) -> Node:
    obj = node.object
    if not isinstance(obj, (Mesh, InstancedMesh)):
        obj = copy.copy(obj)
    twin = scene.add(
        obj,
        name=node.name,
        pose=node.pose,
        static=node.static,
        cast_shadows=node.cast_shadows,
        receive_shadows=node.receive_shadows,
    )
    if not node.visible:
        twin.visible = False
    twin.collider = node.collider
    return twin
