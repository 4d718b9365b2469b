"""What the nodes of a scene draw: each mesh and each set of instances once, under a number.

In: objects, as nodes come and go. Out: their numbers, and their boxes in object space, renewed when
an object changed. A number is used again only after ``version`` has grown. What a change costs
depends on what changed, not on how many objects there are.
"""

from __future__ import annotations

import numpy as np

from ._native.scene_graph import OBJECT_BOX, NativeShapes
from .changes import Watch
from .instances import InstancedMesh, mesh_box
from .mesh import Mesh

_REMEMBERED = 1024  # numbers that got other objects
_NO_BOX = np.array((np.inf,) * 3 + (-np.inf,) * 3 + (0.0,) * 3)


class ObjectTable:
    """The objects of a scene that can be drawn.

    Attributes
    ----------
    objects : list of Mesh, InstancedMesh or None
        By number; None where a number is free.
    boxes : (N, OBJECT_BOX) float64
        By number: lowest and highest corner, and how far from 0 coordinates are that they were made
        of; lowest above highest where nothing can show. There may be more rows than numbers.
    version : int
        Grows by one when a number gets another object.
    """

    def __init__(self) -> None:
        self.objects: list = []
        self.boxes = np.empty((0, OBJECT_BOX))
        self.version = 0
        self._shapes: NativeShapes | None = None
        self._numbers: dict = {}
        self._uses: list[int] = []
        self._free: list[int] = []
        self._watch = Watch()
        self._drawn: dict = {}  # numbers of what each mesh or set of instances is drawn by
        self._parts: dict[int, list] = {}  # the meshes and sets of instances that a number draws
        self._renewed: list[int] = []  # the numbers that got other objects, the latest last
        self._unboxed: set[int] = set()  # of these, those whose boxes are not renewed yet

    @property
    def shapes(self) -> NativeShapes:
        """What the objects are to rays; told when a ray first asks."""
        if self._shapes is None:
            self._shapes = NativeShapes(len(self.objects))
        return self._shapes

    def take(self, obj) -> int:
        """Return the number of an object for one more node; -1 for what is never drawn."""
        if not isinstance(obj, (Mesh, InstancedMesh)):
            return -1
        number = self._numbers.get(obj)
        if number is None:
            if not self._free:
                self._free.append(len(self.objects))
                self.objects.append(None)
                self._uses.append(0)
            number = self._numbers[obj] = self._free.pop()
            self._give(number, obj)
            self._look_at(obj, number)
            if isinstance(obj, InstancedMesh):
                self._look_at(obj.mesh, number)
        self._uses[number] += 1
        return number

    def release(self, obj) -> None:
        """Say that a node of the object is gone."""
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
        """Return the numbers that got other objects since a version; None if that is forgotten."""
        count = self.version - version
        return set(self._renewed[-count:] if count else ()) if count <= len(self._renewed) else None

    def drawn_by(self, thing) -> set[int]:
        """Return the numbers of the objects that draw a mesh or set of instances."""
        return self._drawn.get(thing, set())

    def refresh(self) -> np.ndarray | None:
        """Renew the boxes; return (N,) uint8 that tells which changed, or None."""
        numbers = sorted(self._unboxed | self._numbers_that_changed())
        self._unboxed = set()
        if not numbers:
            return None
        self._shapes = None
        if len(self.boxes) < len(self.objects):
            more = np.full((2 * len(self.objects) - len(self.boxes), OBJECT_BOX), np.nan)
            self.boxes = np.concatenate([self.boxes, more])
        boxes = np.array([_box(self.objects[number]) for number in numbers])
        changed = np.zeros(len(self.boxes), np.uint8)
        changed[numbers] = (boxes != self.boxes[numbers]).any(axis=1)
        self.boxes[numbers] = boxes
        return changed if changed.any() else None

    def _numbers_that_changed(self) -> set[int]:
        numbers = set()
        for thing in self._watch.changed():
            numbers |= self._drawn[thing]
            if isinstance(thing, InstancedMesh):
                self._look_at(thing.mesh, self._numbers[thing])
        return numbers

    def _look_at(self, thing, number: int) -> None:
        numbers = self._drawn.setdefault(thing, set())
        if not numbers:
            self._watch.add(thing)
        if number not in numbers:
            numbers.add(number)
            self._parts.setdefault(number, []).append(thing)

    def _look_away(self, thing, number: int) -> None:
        self._drawn[thing].remove(number)
        if not self._drawn[thing]:
            del self._drawn[thing]
            self._watch.remove(thing)

    def _give(self, number: int, obj) -> None:
        self.objects[number] = obj
        self.version += 1
        self._unboxed.add(number)
        self._renewed.append(number)
        if len(self._renewed) > 2 * _REMEMBERED:
            del self._renewed[:_REMEMBERED]


def _box(obj) -> np.ndarray:
    if isinstance(obj, Mesh):
        return mesh_box(obj)
    return _NO_BOX if obj is None else obj._box_in_node()
