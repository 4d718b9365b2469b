"""Snapshots of a scene's complete state, and their restoration.

In: a scene. Out: its state: tree, poses, names, switches, objects, colliders, motion, and the
contents of objects, materials and textures. Read-only arrays are not copied. It supports arbitrary
changes, such as by a line of Python.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from ..._native.scene_graph import STATIC, VISIBLE
from ...base.held_values import kept, same
from ...model.geometry.mesh import Mesh
from ...model.materials.material import textures_of
from ...model.scene.animation import Motions, motions_of, set_motions
from ...model.scene.instances import InstancedMesh
from ...model.scene.node_arrays import CASTS_NONE, RECEIVES_NONE
from ...model.scene.placements import Placements
from ...model.scene.scene import Scene
from ...model.scene.surroundings import SCENE_VALUES
from ...model.spatial.colliders import MeshCollider
from .contents import contents, put_contents
from .selection import topmost

_SCENE_VALUES = (*SCENE_VALUES, "warnings")


class SceneState:
    """The state of a scene at creation.

    Parameters
    ----------
    scene : Scene

    Attributes
    ----------
    nodes : tuple of Node
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self.nodes = scene.nodes
        self._values = {name: kept(getattr(scene, name)) for name in _SCENE_VALUES}
        animator = scene.animator
        # An animator without motions is equivalent to none.
        self._motions = Motions() if animator is None else motions_of(animator)
        self._animator = animator if any(self._motions) else None
        self._placements = Placements(scene, self.nodes)
        slots = scene.data.slots_of(self.nodes)
        columns = scene.data.arrays.columns
        self._flags = columns["flags"][slots] & (VISIBLE | STATIC)
        self._unshadowed = columns["unshadowed"][slots]
        ids = np.append(columns["id"], -1)  # the last entry maps -1, "none", to itself
        self._links = [ids[columns[name][slots]].tolist() for name in ("parent", "next")]
        self._held = [(node.name, node.object, node.collider) for node in self.nodes]
        self._bent = [(node.skin, kept(node.morph_weights)) for node in self.nodes]
        self._things = {thing: contents(thing) for thing in _reachable(self._held)}

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, SceneState)
            and self.nodes == other.nodes
            and self._values == other._values
            and (self._animator, self._motions) == (other._animator, other._motions)
            and self._placements.same(other._placements)
            and self._flags.tobytes() == other._flags.tobytes()
            and self._unshadowed.tobytes() == other._unshadowed.tobytes()
            and self._links == other._links
            and same(self._held, other._held)
            and same(self._bent, other._bent)
            and self._things.keys() == other._things.keys()
            and all(same(held, other._things[thing]) for thing, held in self._things.items())
        )

    __hash__ = None  # type: ignore[assignment]

    def put(self) -> None:
        """Restore the scene's state; nodes that are not in the state are removed."""
        scene = self._scene
        for name, value in self._values.items():
            setattr(scene, name, kept(value))
        self._put_motions()
        self._restore_nodes()
        self._link_nodes()
        stay = set(self.nodes)
        for node in topmost([node for node in scene.nodes if node not in stay]):
            scene.remove(node)
        for thing, held in self._things.items():
            put_contents(thing, held)
        self._placements.put(scene)
        for node, flags, unshadowed, (name, obj, collider), (skin, weights) in zip(
            self.nodes,
            self._flags.tolist(),
            self._unshadowed.tolist(),
            self._held,
            self._bent,
            strict=True,
        ):
            node.visible, node.static = bool(flags & VISIBLE), bool(flags & STATIC)
            node.cast_shadows = not unshadowed & CASTS_NONE
            node.receive_shadows = not unshadowed & RECEIVES_NONE
            _hold(node, name, obj, collider)
            if node.skin is not skin:
                node.skin = skin
            if not same(node.morph_weights, weights):
                node.morph_weights = weights

    def _put_motions(self) -> None:
        scene = self._scene
        if self._animator is not None:
            scene.animator = self._animator
        if scene.animator is not None:
            set_motions(scene.animator, self._motions)

    def _restore_nodes(self) -> None:
        for node in self.nodes:
            if node.scene is None:
                self._scene.restore(self._scene.data.removed_with(node))

    def _link_nodes(self) -> None:
        by_id = {node.id: node for node in self.nodes}
        wanted: dict[int, list[int]] = {}
        parents, following = self._links
        for node, parent in zip(self.nodes, parents, strict=True):
            if parent >= 0:
                wanted.setdefault(parent, []).append(node.id)
        next_of = dict(zip((node.id for node in self.nodes), following, strict=True))
        orders = {parent: _in_order(ids, next_of) for parent, ids in wanted.items()}
        for node, parent in zip(self.nodes, parents, strict=True):
            if (-1 if node.parent is None else node.parent.id) != parent:
                node.reparent(None)
        for parent, ids in orders.items():
            if [child.id for child in by_id[parent].children] != ids:
                for child in ids:
                    by_id[child].reparent(by_id[parent])


def _in_order(ids: list[int], next_of: dict[int, int]) -> list[int]:
    """Return the IDs of a parent's children in order."""
    followers = {next_of[number] for number in ids}
    number = next(number for number in ids if number not in followers)
    ordered = []
    while number >= 0:
        ordered.append(number)
        number = next_of[number]
    return ordered


def _hold(node, name: str, obj: Any, collider: Any) -> None:
    if node.name != name:
        node.name = name
    if node.object is not obj:
        node.collider = None
        node.object = obj
    if node.collider is not collider:
        node.collider = collider


def _reachable(held: list[tuple]) -> Iterator[Any]:
    """Return the objects of nodes, and their resources, each once."""
    todo: list[Any] = [thing for _, obj, collider in held for thing in (obj, collider)]
    seen: set[int] = set()
    while todo:
        thing = todo.pop()
        if thing is None or id(thing) in seen:
            continue
        seen.add(id(thing))
        yield thing
        if isinstance(thing, (InstancedMesh, MeshCollider)):
            todo.append(thing.mesh)
        elif isinstance(thing, Mesh):
            for material in thing.materials:
                todo += [material, *textures_of(material).values()]
