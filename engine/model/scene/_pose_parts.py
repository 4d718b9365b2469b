"""A part of a node's pose as read: a read-only array whose ``+=`` and the like assign.

``node.translation += step`` moves the node: it computes a new array and assigns it. Writing to
single elements would not change the node, so it raises an error that says what to do instead.
"""

from __future__ import annotations

from typing import Any, SupportsIndex

import numpy as np

from ...errors import InvalidArgumentError


class PosePart(np.ndarray):
    """A read-only copy of translation, rotation, Euler angles or scale."""

    __slots__ = ()

    def __setitem__(self, key: Any, value: Any) -> None:
        if not self.flags.writeable:
            raise InvalidArgumentError(
                "this is a read-only copy of a part of the node's pose: assign all of it, as in "
                "node.translation = (x, y, z)"
            )
        super().__setitem__(key, value)

    # The results are assigned to the node and may be any numbers; `__add__` and others promise
    # less.
    def __iadd__(self, other: Any) -> Any:  # type: ignore[misc]
        return super().__iadd__(other) if self.flags.writeable else np.asarray(self) + other

    def __isub__(self, other: Any) -> Any:  # type: ignore[misc]
        return super().__isub__(other) if self.flags.writeable else np.asarray(self) - other

    def __imul__(self, other: Any) -> Any:  # type: ignore[misc]
        return super().__imul__(other) if self.flags.writeable else np.asarray(self) * other

    def __itruediv__(self, other: Any) -> Any:  # type: ignore[misc]
        return super().__itruediv__(other) if self.flags.writeable else np.asarray(self) / other

    def __reduce_ex__(self, protocol: SupportsIndex) -> str | tuple[Any, ...]:
        return np.asarray(self).__reduce_ex__(protocol)

    def __repr__(self) -> str:
        return repr(np.asarray(self))
