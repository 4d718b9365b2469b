"""The node parts and other properties that clips animate: one row for each.

In: clips; then rows of values. Out: nodes and properties set to these values. Their values before
the first write are remembered.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np

from ..scene.nodes import Node
from ..scene.scene import Scene
from .clips import PATHS, AnimationClip, Channel
from .properties import Property, PropertyChannel

#: The path of all channels that are not part of a node's pose; its rows are the properties.
PROPERTIES = "properties"
#: Values by path: (rows, N) float64; for weights and properties, a list of (T,) arrays.
Values: TypeAlias = dict[str, Any]


def row_of(channel: Channel | PropertyChannel) -> tuple[str, Node | Property]:
    """Return the path that a channel belongs to, and the object of its row."""
    if isinstance(channel, PropertyChannel):
        return PROPERTIES, Property(channel.target, channel.path)
    return channel.path, channel.node


class AnimatedParts:
    """Everything that a set of clips animates.

    Attributes
    ----------
    rows : dict of str to dict of Node or Property to int
        The row of each object, by path.
    rest : dict
        The nodes' values when this was created.
    """

    def __init__(self, scene: Scene, clips: Iterable[AnimationClip]) -> None:
        self.rows: dict[str, dict[Any, int]] = {path: {} for path in (*PATHS, PROPERTIES)}
        for clip in clips:
            for channel in clip.channels:
                path, moved = row_of(channel)
                self.rows[path].setdefault(moved, len(self.rows[path]))
        self.rest: Values = {path: _values_of(scene, path, self.rows[path]) for path in PATHS}
        self.rest[PROPERTIES] = [held.numbers() for held in self.rows[PROPERTIES]]
        self._held = [held.held() for held in self.rows[PROPERTIES]]
        self._slots: tuple[tuple[object, object], dict[str, np.ndarray]] | None = None

    def none(self) -> dict[str, np.ndarray]:
        """Return a mask by path, all False."""
        return {path: np.zeros(len(rows), np.bool_) for path, rows in self.rows.items()}

    def write(self, scene: Scene, values: Values, masks: dict[str, np.ndarray]) -> None:
        """Write the values of the masked rows to their nodes."""
        arrays = scene.data.arrays
        slots = self._slots_in(scene)
        for path in ("translation", "rotation", "scale"):
            rows = np.flatnonzero(masks[path] & (slots[path] >= 0))
            if not len(rows):
                continue
            part, where = values[path][rows], slots[path][rows]
            if path == "translation":
                arrays.set_translations(where, part)
            elif path == "rotation":
                arrays.set_many_parts(where, part, None)
            else:
                arrays.set_many_parts(where, None, part)
        for node, row in self.rows["weights"].items():
            if masks["weights"][row] and slots["weights"][row] >= 0:
                weights = values["weights"][row]
                if len(weights) == len(getattr(node.object, "morph_targets", ())):
                    node.morph_weights = weights

        for number, held in enumerate(self.rows[PROPERTIES]):
            is_gone = isinstance(held.target, Node) and held.target.scene is not scene
            if not masks[PROPERTIES][number] or is_gone:
                continue
            numbers = values[PROPERTIES][number]
            if numbers is self.rest[PROPERTIES][number]:
                held.restore(self._held[number])
            else:
                held.put(numbers)

    def _slots_in(self, scene: Scene) -> dict[str, np.ndarray]:
        """Return the slots of all rows, -1 for removed nodes."""
        data = scene.data
        state = data.arrays, data.removals
        if self._slots is None or self._slots[0] != state:
            slots = {
                path: data.slots_of(rows) for path, rows in self.rows.items() if path != PROPERTIES
            }
            self._slots = state, slots
        return self._slots[1]


def _values_of(scene: Scene, path: str, nodes: dict[Node, int]) -> np.ndarray | list[np.ndarray]:
    if path == "weights":
        return [_weights_of(node) for node in nodes]
    return getattr(scene.select(nodes), f"{path}s")


def _weights_of(node: Node) -> np.ndarray:
    if node.morph_weights is not None:
        return node.morph_weights
    return np.zeros(len(getattr(node.object, "morph_targets", ())))
