"""The objects of a scene's nodes: each mesh or set of instances once, under a number.

In: objects, as nodes come and go. Out: their numbers, and their boxes in object space, renewed when
an object changes. A number is reused only after ``version`` has grown. The cost of a change depends
on the change, not on the number of objects.

Threads that compute the same missing value at once get the same result: nothing counts as done
before its result is stored.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ..._native.scene_graph import OBJECT_BOX, NativeShapes, move_boxes
from ...base.dirty_tracking import Watch
from ..geometry.mesh import Mesh
from ..motion.posed_mesh import PosedMesh
from .instances import InstancedMesh, box_in_node, mesh_box

if TYPE_CHECKING:
    from .node_arrays import NodeArrays
    from .shown import Drawn

Part: TypeAlias = Mesh | InstancedMesh
_REMEMBERED = 1024  # how many reassigned numbers are remembered
NO_BOX = np.array((np.inf,) * 3 + (-np.inf,) * 3 + (0.0,) * 3)


class ObjectTable:
    """The drawable objects of a scene.

    Attributes
    ----------
    objects : list of Mesh, InstancedMesh or None
        By number; None where a number is free.
    boxes : (N, OBJECT_BOX) float64
        By number: lowest and highest corner, and the largest absolute coordinates; lowest above
        highest if the object is empty. There may be more rows than numbers.
    version : int
        Grows by one when a number is given another object.
    """

    def __init__(self) -> None:
        self.objects: list[Drawn | None] = []
        self.boxes = np.empty((0, OBJECT_BOX))
        self.version = 0
        self._shapes: NativeShapes | None = None
        self._numbers: dict[Drawn, int] = {}
        self._uses: list[int] = []
        self._free: list[int] = []
        self._watch = Watch()
        # The numbers of the objects that draw each mesh or set of instances.
        self._drawn: dict[Part, set[int]] = {}
        self._parts: dict[int, list[Part]] = {}  # the things that each number draws
        self._renewed: list[int] = []  # the numbers given other objects, the latest last
        self._given: list[int] = []  # the version at which each number was given its object
        self._unboxed: set[int] = set()  # the numbers whose boxes are out of date

    @property
    def shapes(self) -> NativeShapes:
        """The objects' shapes for rays; created when a ray first asks."""
        shapes = self._shapes
        if shapes is None:
            shapes = self._shapes = NativeShapes(len(self.objects))
        return shapes

    def take(self, obj: object) -> int:
        """Return an object's number for one more node; -1 if the object is never drawn."""
        if not isinstance(obj, (Mesh, InstancedMesh, PosedMesh)):
            return -1
        number = self._numbers.get(obj)
        if number is None:
            if not self._free:
                self._free.append(len(self.objects))
                self.objects.append(None)
                self._uses.append(0)
                self._given.append(0)
                self._make_room()
            number = self._numbers[obj] = self._free.pop()
            self._give(number, obj)
            if not isinstance(obj, PosedMesh):
                self._look_at(obj, number)
            if not isinstance(obj, Mesh):
                self._look_at(obj.mesh, number)
        self._uses[number] += 1
        return number

    def number_of(self, obj: Drawn) -> int:
        """Return the number of an object that a node draws."""
        return self._numbers[obj]

    def forget_shapes(self) -> None:
        """Forget the shapes: an object's faces have changed or moved."""
        self._shapes = None

    def release(self, obj: Any) -> None:
        """Release an object's number for one node."""
        number = self._numbers.get(obj)
        if number is None:
            return
        self._uses[number] -= 1
        if self._uses[number] == 0:
            del self._numbers[obj]
            self._free.append(number)
            self._give(number, None)
            for part in self._parts.pop(number):
                self._look_away(part, number)

    def renewed_since(self, version: int) -> set[int] | None:
        """Return the numbers given other objects since a version; None if forgotten."""
        count = self.version - version
        return set(self._renewed[-count:] if count else ()) if count <= len(self._renewed) else None

    def drawn_by(self, thing: Part) -> set[int]:
        """Return the numbers of the objects that draw a mesh or set of instances."""
        return set(self._drawn.get(thing, ()))

    def refresh(self, arrays: NodeArrays) -> None:
        """Renew the boxes, and mark the nodes in ``arrays`` whose boxes changed."""
        found = self._watch.found()
        if not found and not self._unboxed:
            return
        given = {number: self._given[number] for number in self._unboxed.copy()}
        numbers = sorted(given.keys() | self._numbers_of(found))
        boxes = [_box(self.objects[number]) for number in numbers]
        self._shapes = None
        if numbers:
            arrays.renew_boxes(self, np.array(numbers, np.int32), np.array(boxes))
        for thing, version in found:
            self._watch.saw(thing, version)
        for number, version in given.items():
            self._unboxed.discard(number)
            if self._given[number] != version:  # another object came meanwhile
                self._unboxed.add(number)

    def _numbers_of(self, changed: list[tuple[Any, int]]) -> set[int]:
        """Return the numbers of the objects that draw the changed things."""
        numbers: set[int] = set()
        for thing, _ in changed:
            numbers |= self.drawn_by(thing)
            if isinstance(thing, InstancedMesh) and thing in self._numbers:
                self._follow(thing, self._numbers[thing])
        return numbers

    def _follow(self, instances: InstancedMesh, number: int) -> None:
        """Watch the mesh that the instances draw now instead of the earlier one."""
        mesh = instances.mesh
        self._look_at(mesh, number)
        parts, self._parts[number] = self._parts[number], [instances, mesh]
        for part in parts:
            if part is not instances and part is not mesh:
                self._look_away(part, number)

    def _make_room(self) -> None:
        """Make room for a row per number; new rows are NaN and so differ from every box."""
        if len(self.boxes) < len(self.objects):
            move_boxes(self, np.full((2 * len(self.objects), OBJECT_BOX), np.nan))

    def _look_at(self, thing: Part, number: int) -> None:
        numbers = self._drawn.setdefault(thing, set())
        if not numbers:
            self._watch.add(thing)
        if number not in numbers:
            numbers.add(number)
            self._parts.setdefault(number, []).append(thing)

    def _look_away(self, thing: Part, number: int) -> None:
        numbers = self._drawn.get(thing, set())
        numbers.discard(number)
        if not numbers:
            self._drawn.pop(thing, None)
            self._watch.remove(thing)

    def _give(self, number: int, obj: Drawn | None) -> None:
        self.objects[number] = obj
        self.version += 1
        self._given[number] = self.version
        self._unboxed.add(number)
        self._renewed.append(number)
        if len(self._renewed) > 2 * _REMEMBERED:
            del self._renewed[:_REMEMBERED]


def _box(obj: Drawn | None) -> np.ndarray:
    if isinstance(obj, Mesh):
        return mesh_box(obj)
    if isinstance(obj, PosedMesh):
        return obj.box()
    return NO_BOX if obj is None else box_in_node(obj)
