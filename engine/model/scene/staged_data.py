"""The data of a staged scene: a scene's data and that of the nodes beside it, joined.

In: the data of two scenes, and the hidden nodes of the first. Out: the data that a renderer reads.
Arrays of its own hold the rows of both trees, one after the other; only changes are copied.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..._native.rasterizer import NativeRows
from ..._native.scene_graph import BOX, SHOWN
from ..materials.material import Finish, Material
from ..materials.textures import Reading
from ._objects import NO_BOX
from .node_arrays import NodeArrays
from .nodes import Node
from .scene_data import SceneData, box_around, box_of_shadows
from .shown import as_shown

if TYPE_CHECKING:
    from ._posing import Posing

#: The columns that drawing reads.
_COLUMNS = (
    *("parent", "object", "object_id", "flags", "world", "bounds"),
    *("world_version", "anchor", "unshadowed"),
)
_LEAST_ROOM = 64  # room for objects of a scene; doubled when it is not enough


class StagedData:
    """The data of two scenes, joined, as renderers read it from a `SceneData`.

    Attributes
    ----------
    own, added : SceneData
        The data of the scene, and of the nodes beside it.
    keeps_lights, shows_textures : bool
        Whether the scene's own lights shine, and its materials show their textures.
    reading, finish : callable or None
        As in `SceneData`.
    hidden : frozenset of Node
    part_of : callable or None
        As given to `StagedScene.hide`.
    arrays, objects
        As in `SceneData`; the added ones follow the scene's own.
    """

    def __init__(self, own: SceneData, added: SceneData) -> None:
        self.own, self.added = own, added
        self.keeps_lights = self.shows_textures = True
        self.reading: Reading | None = None
        self.finish: Finish | None = None
        self.hidden: frozenset[Node] = frozenset()
        self.part_of: Callable[[Any], Any] | None = None
        self.arrays = _JoinedRows(self)
        self.objects = _JoinedObjects()

    @property
    def trees(self) -> tuple[SceneData, SceneData]:
        """The data of both scenes."""
        return self.own, self.added

    @property
    def first_added_id(self) -> int:
        """The first ID of the added nodes in frames."""
        arrays = self.own.arrays
        return int(arrays.columns["id"][arrays.count - 1]) + 1 if arrays.count else 0

    # The members below are those of `SceneData`.

    def bounds(self) -> NDArray[np.float64]:
        self.update()
        return box_around(self.arrays)

    def shadow_bounds(self) -> NDArray[np.float64]:
        self.update()
        return box_of_shadows(self.arrays)

    def update(self, threads: int = 1) -> None:
        """Update both trees, then join them."""
        for tree in self.trees:
            tree.update(threads)
        self.objects.join(self)
        self.arrays.join()

    @property
    def posing(self) -> Posing | None:
        return self.own.posing

    @property
    def untextured(self) -> frozenset[Material]:
        if self.shows_textures:
            return frozenset()
        own = self.objects.objects[: self.objects.first_added]
        meshes = (getattr(obj, "mesh", obj) for obj in own if obj is not None)
        return frozenset(material for mesh in meshes for material in mesh.materials)

    @property
    def node_count(self) -> int:
        return self.own.node_count + self.added.node_count

    def census(self) -> tuple[Any, ...]:
        return self.own.census(), self.added.census()

    def camera_node(self) -> Node | None:
        return self.own.camera_node()

    def placed_lights(self) -> list[tuple[Any, int]]:
        own = self.own.placed_lights() if self.keeps_lights else []
        first = self.own.arrays.count
        return own + [(light, first + slot) for light, slot in self.added.placed_lights()]

    def lights_state(self) -> tuple[Any, ...]:
        trees = (tree.lights_state() for tree in self.trees)
        return self.keeps_lights, self.own.arrays.count, *trees


#: The state that rows were made from.
State: TypeAlias = tuple[Any, ...]


class _JoinedRows:
    """The rows of two trees of nodes, as `NodeArrays` has those of one.

    Attributes
    ----------
    columns : dict of str to ndarray
    rows : NativeRows
        The columns, as C takes them; once they are joined.
    count : int
    changes, updated : (tuple, tuple)
        The state of each tree's rows: now, and when they were joined.
    """

    def __init__(self, staged: StagedData) -> None:
        self.columns: dict[str, NDArray[Any]] = {}
        self.rows: NativeRows
        self.count = 0
        self.updated: tuple[State, State] = ((), ())
        self._made_of: Callable[[], Any] = weakref.ref(staged)

    @property
    def changes(self) -> tuple[State, State]:
        staged = self._made_of()
        return _state_of(staged, *(tree.arrays.changes for tree in staged.trees))

    def join(self) -> None:
        """Copy the rows that changed."""
        staged, before = self._made_of(), self.updated
        state = _state_of(staged, *(tree.arrays.updated for tree in staged.trees))
        if state == before:
            return
        self.updated = ((), ())  # in case anything below raises
        count = sum(tree.arrays.count for tree in staged.trees)
        if count != self.count or not self.columns:
            before = ((), ())
            own = staged.own.arrays.columns
            columns = {
                name: np.empty((count, *own[name].shape[1:]), own[name].dtype) for name in _COLUMNS
            }
            self.rows, self.columns, self.count = NativeRows(columns), columns, count
        if state[0] != before[0]:
            self._copy_scene(staged)
        if state[1] != before[1]:
            self._copy_added(staged)
        self.updated = state

    def _copy_scene(self, staged: StagedData) -> None:
        arrays, columns = staged.own.arrays, self.columns
        for name, column in columns.items():
            column[: arrays.count] = arrays.columns[name][: arrays.count]
        slots = staged.own.slots_of(staged.hidden)
        slots = slots[slots >= 0]
        columns["flags"][slots] &= ~SHOWN & 0xFF
        columns["bounds"][slots] = NO_BOX[:BOX]
        drawn = columns["object"][: arrays.count]
        for whole, part in staged.objects.parts.items():
            drawn[drawn == whole] = part

    def _copy_added(self, staged: StagedData) -> None:
        arrays, first = staged.added.arrays, staged.own.arrays.count
        for name, column in self.columns.items():
            column[first:] = arrays.columns[name][: arrays.count]
        self.columns["object_id"][first:] += staged.first_added_id
        for name, offset in (("parent", first), ("object", staged.objects.first_added)):
            added = self.columns[name][first:]
            added[added >= 0] += offset

    def select(
        self, frustum: NDArray[np.float64], widen: float, flat: bool, bits: NDArray[np.uint64]
    ) -> int:
        """Select as `NodeArrays` does; added nodes are always selected."""
        arrays = self._made_of().own.arrays
        own = bits[: (arrays.count + 63) // 64]
        tested = arrays.select(frustum, widen, flat, own)
        bits[len(own) :] = 0
        for slot in range(arrays.count, self.count):
            bits[slot >> 6] |= np.uint64(1 << (slot & 63))
        return tested


def _state_of(staged: StagedData, own: int, added: int) -> tuple[State, State]:
    """Return the states of the scene's rows and of the added rows, at given changes."""
    scene, beside, objects = staged.own.arrays, staged.added.arrays, staged.objects
    return (
        (scene, scene.count, own, staged.hidden, objects.renewals),
        (beside, beside.count, added, scene, scene.count, objects.first_added),
    )


class _JoinedObjects:
    """The objects of two trees, as `ObjectTable` has those of one.

    Attributes
    ----------
    objects : list
        The scene's objects, room for more, partial versions of them, and the added objects.
    version : tuple
        Differs when a number is given another object.
    parts : dict of int to int
        For scene objects by number, the number of the partial version drawn instead.
    first_added : int
        The first number of the added objects.
    renewals : int
        How often partial versions were made.
    """

    def __init__(self) -> None:
        self.objects: list[Any] = []
        self.version: State = ()
        self.parts: dict[int, int] = {}
        self.first_added = self._room = _LEAST_ROOM
        self.renewals = 0
        self._own: Any = None
        self._added: Any = None
        # by number, each part with the state it was made from
        self._made: dict[int, tuple[State, Any]] = {}

    def forget_parts(self) -> None:
        """Make all partial versions anew."""
        self._made, self.parts = {}, {}
        self.renewals += 1

    def join(self, staged: StagedData) -> None:
        """Update the table to what the trees draw now."""
        self._own, self._added = (tree.objects for tree in staged.trees)
        while self._room < len(self._own.objects):
            self._room *= 2
        if staged.part_of is not None:
            self._make_parts(staged.part_of, staged.posing)
        looks = staged.shows_textures, staged.reading, staged.finish
        made = self._added, self._room, self.renewals
        version = self._own.version, self._added.version, *made, *looks
        if version != self.version:
            free = [None] * (self._room - len(self._own.objects))
            parts = [self._made[number][1] for number in self.parts]
            self.objects = [*self._own.objects, *free, *parts, *self._added.objects]
            self.first_added = self._room + len(parts)
            self.version = version

    def _make_parts(self, part_of: Callable[[Any], Any], posing: Any) -> None:
        """Find the partial version of each object that is not drawn whole."""
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

    def renewed_since(self, version: State) -> set[int] | None:
        """Return what `ObjectTable.renewed_since` returns, for both trees."""
        own = self._own.renewed_since(version[0])
        added = self._added.renewed_since(version[1]) if version[2:] == self.version[2:] else None
        if own is None or added is None:
            return None
        return own | {self.first_added + number for number in added}

    def drawn_by(self, thing: Any) -> set[int]:
        """Return what `ObjectTable.drawn_by` returns, for both trees."""
        added = self._added.drawn_by(thing)
        return self._own.drawn_by(thing) | {self.first_added + number for number in added}


#: The data that renderers read.
AnyData: TypeAlias = SceneData | StagedData
NodeRows: TypeAlias = NodeArrays | _JoinedRows
