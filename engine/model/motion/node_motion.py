"""The base of motions: what moves one node of a scene as a function of time.

In: a node. Out: the same node, as long as it exists, and motions for copies of scenes.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from typing import TYPE_CHECKING
from weakref import ref

if TYPE_CHECKING:
    from typing_extensions import Self

    from ..scene.nodes import Node


class NodeMotion:
    """The motion of one node, which may have been removed.

    A removed node may come back (`Scene.restore`), so its motion is kept as long as the node
    exists.
    """

    def __init__(self, node: Node) -> None:
        self._node = ref(node)

    @property
    def node(self) -> Node | None:
        return self._node()

    def copied(self, copy_of: Callable[[Node], Node]) -> Self | None:
        """Return the motion of a copied node; None if there is no copy.

        Parameters
        ----------
        copy_of : callable
            Returns the copy of a node, or the node itself if it has none.
        """
        node = self.node
        if node is None or copy_of(node) is node:
            return None
        copied = copy.copy(self)
        copied._node = ref(copy_of(node))
        return copied


def turns_at(time: float, rate: float, phase: float) -> float:
    """Return how many turns, or ways along a path, are done at a time; 0 if they overflow."""
    turns = time * rate + phase
    return turns if math.isfinite(turns) else 0.0
