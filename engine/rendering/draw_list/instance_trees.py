"""Trees over many instances, built once the instances have not changed for some frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..._native.rasterizer import NativeDrawList
from ...model.scene.instances import MANY, InstancedMesh, instance_tree

if TYPE_CHECKING:
    from ...model.scene.shown import Drawn

_SETTLED = 3  # frames without a change


class InstanceTrees:
    """The trees of one native draw list.

    Attributes
    ----------
    made : bool
        Whether there are any trees.
    """

    def __init__(self, native: NativeDrawList) -> None:
        self._native = native
        self._many: dict[int, InstancedMesh] = {}  # by object number
        self._frames = 0
        self.made = False

    def note(self, number: int, obj: Drawn | None) -> None:
        """Register an object that is listed under a number from now on."""
        many = obj if isinstance(obj, InstancedMesh) and len(obj) >= MANY else None
        if many is not None or number in self._many:
            self._unsettle()
            self._many.pop(number, None)
            if many is not None:
                self._many[number] = many

    def settle(self) -> bool:
        """Build the trees if it is time; return whether they were built now."""
        if self.made or not self._many:
            return False
        self._frames += 1
        if self._frames == _SETTLED:
            for number, instances in self._many.items():
                self._native.set_instance_tree(number, instance_tree(instances)[0])
            self.made = True
        return self.made

    def _unsettle(self) -> None:
        if self.made:
            for number in self._many:
                self._native.set_instance_tree(number, None)
        self.made, self._frames = False, 0
