"""A scene and what is put beside it, drawn as one: neither holds anything of the other.

In: a scene; nodes that are drawn after its own, values that take the place of its own, and what of
it is hidden. Out: what a renderer reads of a scene, and the scene itself as it was. The rows of
both trees stand one below the other in arrays of their own; only what changed is copied there.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..._native.scene_graph import BOX, SHOWN
from ..materials.material import Material
from ..motion.shown import as_shown
from ._objects import NO_BOX
from .nodes import Node
from .scene import Scene
from .surroundings import SCENE_VALUES, Surroundings

#: The columns that are read of a scene that is drawn.
_COLUMNS = (
    *("parent", "object", "object_id", "flags", "world", "bounds"),
    *("world_version", "anchor", "unshadowed"),
)
_LEAST_ROOM = 64  # for objects of a scene; twice as much when it is not enough


class StagedScene(Surroundings):
    """A scene, and what is drawn with it.

    Parameters
    ----------
    scene : Scene
        Stays as it is.

    Attributes
    ----------
    scene : Scene
    beside : Scene
        Its nodes are drawn after those of the scene, with ids above theirs.
    keeps_lights : bool
        Whether the lights of the scene shine.
    background, ambient, light_clamp, exposure, …
        As of `Scene`: those of the scene, until they are assigned.
    """

    scene: Scene
    beside: Scene
    keeps_lights: bool

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.beside = Scene()
        self.keeps_lights = self._shows_textures = True
        self._hidden: frozenset[Node] = frozenset()
        self._part_of: Callable[[Any], Any] | None = None
        self._arrays = _JoinedRows(self)
        self._objects = _JoinedObjects()

    def __getattr__(self, name: str) -> Any:
        """Return the scene's own value of anything that was not assigned."""
        if name[1:] not in SCENE_VALUES:
            raise AttributeError(f"a StagedScene has no {name}")
        return getattr(self.scene, name)

    def show_textures(self, shown: bool) -> None:
        """Draw the materials of the scene with their textures, or without."""
        self._shows_textures = shown

    def hide(self, nodes: Iterable[Node], part_of: Callable[[Any], Any] | None = None) -> None:
        """Leave nodes of the scene out of pictures, but not those below them; all others show.

        Parameters
        ----------
        nodes : iterable of Node
        part_of : callable, optional
            Called with a `Mesh` or `InstancedMesh`; returns what is drawn of it.
        """
        self._hidden, self._part_of = frozenset(nodes), part_of
        self._objects.forget_parts()

    def own_pixels(self, object_id: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Return which pixels of a frame's ``object_id`` show something of the scene itself."""
        return (object_id >= 0) & (object_id < self.first_added_id)

    @property
    def first_added_id(self) -> int:
        """The id from which on pictures tell of what was added."""
        arrays = self.scene._arrays
        return int(arrays.columns["id"][arrays.count - 1]) + 1 if arrays.count else 0

    # The members below are those of a `Scene` that renderers read.

    bounds = Scene.bounds
    _census = Scene._census

    def _update(self, threads: int = 1) -> None:
        """Make both trees true, and then what is joined of them."""
        for tree in (self.scene, self.beside):
            tree._update(threads)
        self._objects.join(self)
        self._arrays.join()

    @property
    def _posing(self) -> Any:
        return self.scene._posing

    @property
    def _untextured(self) -> frozenset[Material]:
        if self._shows_textures:
            return frozenset()
        meshes = (
            getattr(obj, "mesh", obj) for obj in self._objects.objects[: self._objects.first_added]
        )
        return frozenset(
            material for mesh in meshes if mesh is not None for material in mesh.materials
        )

    @property
    def _removed(self) -> int:
        return self.scene._removed + self.beside._removed

    @property
    def _removals(self) -> tuple:
        """Return numbers that differ once a node, or its object, went, or rows moved."""
        trees = [(tree._arrays, tree._arrays.count, tree._removals) for tree in self._trees()]
        return self.keeps_lights, *trees

    @property
    def _lights(self) -> dict[int, _PlacedLight]:
        own = self.scene._lights.values() if self.keeps_lights else ()
        lights = [_PlacedLight(node.object, node._slot) for node in own]
        first = self.scene._arrays.count
        added = self.beside._lights.values()
        lights += [_PlacedLight(node.object, first + node._slot) for node in added]
        return dict(enumerate(lights))

    def _camera_node(self) -> Node | None:
        return self.scene._camera_node()

    def _trees(self) -> tuple[Scene, Scene]:
        return self.scene, self.beside


class _PlacedLight:
    """A light, and the row of its node."""

    def __init__(self, light: Any, slot: int) -> None:
        self.object, self._slot = light, slot


class _JoinedRows:
    """The rows of two trees of nodes, as `NodeArrays` has those of one.

    Attributes
    ----------
    columns : dict of str to ndarray
    count : int
    changes, updated : (tuple, tuple)
        What the rows of each tree are made of: now, and when they were joined.
    """

    def __init__(self, staged: StagedScene) -> None:
        self.columns: dict[str, NDArray[Any]] = {}
        self.count = 0
        self.updated: tuple[tuple, tuple] = ((), ())
        self._made_of = weakref.ref(staged)

    @property
    def changes(self) -> tuple[tuple, tuple]:
        staged = self._made_of()
        return _state_of(staged, *(tree._arrays.changes for tree in staged._trees()))

    def join(self) -> None:
        """Copy the rows that changed."""
        staged, before = self._made_of(), self.updated
        state = _state_of(staged, *(tree._arrays.updated for tree in staged._trees()))
        if state == before:
            return
        self.updated = ((), ())  # for if anything below raises
        count = sum(tree._arrays.count for tree in staged._trees())
        if count != self.count or not self.columns:
            self.count, before = count, ((), ())
            for name in _COLUMNS:
                column = staged.scene._arrays.columns[name]
                self.columns[name] = np.empty((count, *column.shape[1:]), column.dtype)
        if state[0] != before[0]:
            self._copy_scene(staged)
        if state[1] != before[1]:
            self._copy_added(staged)
        self.updated = state

    def _copy_scene(self, staged: StagedScene) -> None:
        arrays, columns = staged.scene._arrays, self.columns
        for name, column in columns.items():
            column[: arrays.count] = arrays.columns[name][: arrays.count]
        slots = [node._slot for node in staged._hidden if node._scene is staged.scene]
        columns["flags"][slots] &= ~SHOWN & 0xFF
        columns["bounds"][slots] = NO_BOX[:BOX]
        drawn = columns["object"][: arrays.count]
        for whole, part in staged._objects.parts.items():
            drawn[drawn == whole] = part

    def _copy_added(self, staged: StagedScene) -> None:
        arrays, first = staged.beside._arrays, staged.scene._arrays.count
        for name, column in self.columns.items():
            column[first:] = arrays.columns[name][: arrays.count]
        self.columns["object_id"][first:] += staged.first_added_id
        for name, offset in (("parent", first), ("object", staged._objects.first_added)):
            added = self.columns[name][first:]
            added[added >= 0] += offset

    def select(self, frustum, widen: float, flat: bool, bits: NDArray[np.uint64]) -> int:
        """As of `NodeArrays`; added nodes are always selected."""
        arrays = self._made_of().scene._arrays
        own = bits[: (arrays.count + 63) // 64]
        tested = arrays.select(frustum, widen, flat, own)
        bits[len(own) :] = 0
        for slot in range(arrays.count, self.count):
            bits[slot >> 6] |= np.uint64(1 << (slot & 63))
        return tested


def _state_of(staged: StagedScene, own: int, added: int) -> tuple[tuple, tuple]:
    """Return the state of the rows of a scene and of the added ones, at some changes."""
    scene, beside, objects = staged.scene._arrays, staged.beside._arrays, staged._objects
    return (
        (scene, scene.count, own, staged._hidden, objects.renewals),
        (beside, beside.count, added, scene, scene.count, objects.first_added),
    )


class _JoinedObjects:
    """The objects of two trees, as `ObjectTable` has those of one.

    Attributes
    ----------
    objects : list
        Those of the scene, room for more of them, parts of them, and those that were added.
    version : tuple
        Another one when a number gets another object.
    parts : dict of int to int
        By the number of an object of the scene that of what is drawn in its place.
    first_added : int
        The first number of what was added.
    renewals : int
        How often parts were made.
    """

    def __init__(self) -> None:
        self.objects: list = []
        self.version: tuple = ()
        self.parts: dict[int, int] = {}
        self.first_added = self._room = _LEAST_ROOM
        self.renewals = 0
        self._own: Any = None
        self._added: Any = None
        self._made: dict[int, tuple[tuple, Any]] = {}  # by number what a part is made of, and it

    def forget_parts(self) -> None:
        """Make all parts anew."""
        self._made, self.parts = {}, {}
        self.renewals += 1

    def join(self, staged: StagedScene) -> None:
        """Follow what the trees draw now."""
        self._own, self._added = (tree._objects for tree in staged._trees())
        while self._room < len(self._own.objects):
            self._room *= 2
        if staged._part_of is not None:
            self._make_parts(staged._part_of, staged.scene._posing)
        looks = self._added, self._room, self.renewals, staged._shows_textures
        version = self._own.version, self._added.version, *looks
        if version != self.version:
            free = [None] * (self._room - len(self._own.objects))
            parts = [self._made[number][1] for number in self.parts]
            self.objects = [*self._own.objects, *free, *parts, *self._added.objects]
            self.first_added = self._room + len(parts)
            self.version = version

    def _make_parts(self, part_of: Callable[[Any], Any], posing: Any) -> None:
        """Find what is drawn of each object, where that is not all of it."""
        moment = None if posing is None else posing.moment
        posed = () if posing is None else posing.numbers.tolist()
        before = self._made
        self._made = {}
        for number, obj in enumerate(self._own.objects):
            if obj is not None:
                versions = getattr(obj, "version", 0), getattr(obj, "mesh", obj).version
                made_of = obj, *versions, moment if number in posed else None
                known = before.get(number)
                if known is None or known[0] != made_of:
                    known = made_of, part_of(as_shown(obj))
                self._made[number] = known
        if self._made != before:
            self.renewals += 1
            cut = [n for n, (of, part) in self._made.items() if part is not as_shown(of[0])]
            self.parts = {number: self._room + place for place, number in enumerate(cut)}

    def renewed_since(self, version: tuple) -> set[int] | None:
        """As of `ObjectTable`."""
        own = self._own.renewed_since(version[0])
        added = self._added.renewed_since(version[1]) if version[2:] == self.version[2:] else None
        if own is None or added is None:
            return None
        return own | {self.first_added + number for number in added}

    def drawn_by(self, thing: Any) -> set[int]:
        """As of `ObjectTable`."""
        added = self._added.drawn_by(thing)
        return self._own.drawn_by(thing) | {self.first_added + number for number in added}
