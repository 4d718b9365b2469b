"""What the nodes of a scene draw: each mesh and each set of instances once, under a number.

In: objects, as nodes come and go. Out: their numbers, and their boxes in object space, renewed when
an object changed. A number is used again only after ``version`` has grown.
"""

from __future__ import annotations

import numpy as np

from ._native.scene_graph import OBJECT_BOX, NativeShapes
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
        self._watched: list[tuple[object, int]] | None = []

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
        watched = self._watched
        if watched is not None and all(thing.version == version for thing, version in watched):
            return None
        self._shapes = None
        boxes = np.array([_box(obj) for obj in self.objects]).reshape(-1, OBJECT_BOX)
        changed = np.ones(len(boxes), np.uint8)
        known = min(len(self.boxes), len(boxes))
        changed[:known] = (boxes[:known] != self.boxes[:known]).any(axis=1)
        self.boxes = boxes
        self._watched = [
            (thing, thing.version)
            for obj in self._numbers
            for thing in ((obj, obj.mesh) if isinstance(obj, InstancedMesh) else (obj,))
        ]
        return changed if changed.any() else None

    def _changed(self) -> None:
        self.version += 1
        self._watched = None


def _box(obj) -> np.ndarray:
    if isinstance(obj, Mesh):
        return mesh_box(obj)
    return _NO_BOX if obj is None else obj._box_in_node()
