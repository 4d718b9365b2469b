"""What the nodes of a scene draw: each mesh and each set of instances once, under a number.

In: objects, as nodes come and go. Out: their numbers, and their boxes in object space, renewed when
an object changed. A number is used again only after ``version`` has grown.
"""

from __future__ import annotations

import numpy as np

from ._native.scene_graph import OBJECT_BOX, NativeShapes
from .changes import Watch
from .instances import InstancedMesh, mesh_box
from .mesh import Mesh

_NO_BOX = np.array((np.inf,) * 3 + (-np.inf,) * 3 + (0.0,) * 3)


class ObjectTable:
    """The objects of a scene that can be drawn.

    Attributes
    ----------
    objects : list of Mesh, InstancedMesh or None
        By number; None where a number is free.
    boxes : (N, OBJECT_BOX) float64
        By number: lowest and highest corner, and how far from 0 coordinates are that they were made
        of; lowest above highest where nothing can show.
    version : int
        Grows when a number gets another object.
    """

    def __init__(self) -> None:
        self.objects: list = []
        self.boxes = np.empty((0, OBJECT_BOX))
        self.version = 0
        self._shapes: NativeShapes | None = None
        self._numbers: dict = {}
        self._uses: list[int] = []
        self._free: list[int] = []
        self._watch: Watch | None = Watch()  # None: objects came or went
        self._drawn: dict = {}  # numbers of what each mesh or set of instances is drawn by

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
            self.objects[number] = obj
            self._changed()
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
            self.objects[number] = None
            self._free.append(number)
            self._changed()

    def refresh(self) -> np.ndarray | None:
        """Renew the boxes; return (N,) uint8 that tells which changed, or None."""
        if self._watch is None:
            self._look_at_all()
            numbers = list(range(len(self.objects)))
        else:
            numbers = self._numbers_that_changed()
        if not numbers:
            return None
        self._shapes = None
        if len(self.boxes) < len(self.objects):
            more = np.full((len(self.objects) - len(self.boxes), OBJECT_BOX), np.nan)
            self.boxes = np.concatenate([self.boxes, more])
        boxes = np.array([_box(self.objects[number]) for number in numbers])
        changed = np.zeros(len(self.boxes), np.uint8)
        changed[numbers] = (boxes != self.boxes[numbers]).any(axis=1)
        self.boxes[numbers] = boxes
        return changed if changed.any() else None

    def _numbers_that_changed(self) -> list[int]:
        numbers = set()
        for thing in self._watch.changed():
            numbers |= self._drawn[thing]
            if isinstance(thing, InstancedMesh):
                self._look_at(thing.mesh, self._numbers[thing])
        return sorted(numbers)

    def _look_at_all(self) -> None:
        self._watch, self._drawn = Watch(), {}
        for obj, number in self._numbers.items():
            self._look_at(obj, number)
            if isinstance(obj, InstancedMesh):
                self._look_at(obj.mesh, number)

    def _look_at(self, thing, number: int) -> None:
        self._watch.add(thing)
        self._drawn.setdefault(thing, set()).add(number)

    def _changed(self) -> None:
        self.version += 1
        self._watch = None


def _box(obj) -> np.ndarray:
    if isinstance(obj, Mesh):
        return mesh_box(obj)
    return _NO_BOX if obj is None else obj._box_in_node()
