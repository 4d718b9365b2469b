"""The nodes of a scene as arrays: a row per node, in the order of adding.

In: slots. Out: arrays that C keeps up to date (csrc/scene/). A removed node keeps its slot until
the rows are packed into new arrays, with the rows of nodes and of removed nodes that may come back.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._native.rasterizer import NativeRows
from ..._native.scene_graph import ALIVE, BOX, NativeGraph

#: Name of each array -> dtype and shape of a row.
_COLUMNS = {
    "parent": (np.int32, ()),
    "first_child": (np.int32, ()),
    "last_child": (np.int32, ()),
    "next": (np.int32, ()),
    "previous": (np.int32, ()),
    "object": (np.int32, ()),
    "id": (np.int32, ()),
    "object_id": (np.int32, ()),  # the ID in frames: the node's own, or another's
    "flags": (np.uint8, ()),
    "pose": (np.float64, (12,)),
    "rotation": (np.float64, (4,)),
    "scale": (np.float64, (3,)),
    "world": (np.float64, (12,)),
    "bounds": (np.float64, (BOX,)),
    "pose_version": (np.uint32, ()),
    "world_version": (np.uint32, ()),
    "changed": (np.int32, ()),
    "stack": (np.int32, ()),
    "anchor": (np.int32, ()),
    "unshadowed": (np.uint8, ()),  # CASTS_NONE and RECEIVES_NONE
}
#: Columns that C receives with each call that reads them.
_NOT_ATTACHED = ("object_id", "unshadowed")
#: Flags that switch a node's shadows off; 0 casts and receives them.
CASTS_NONE, RECEIVES_NONE = 1, 2
_LINKS = ("parent", "first_child", "last_child", "next", "previous", "anchor")
_ROOM = 16


class NodeArrays(NativeGraph):
    """Growable arrays of nodes.

    Attributes
    ----------
    columns : dict of str to ndarray
        Named as in csrc/include/e3d_scene.h; only the first ``count`` rows are nodes.
    rows : NativeRows
        The columns that drawing reads, as C takes them.
    nodes : list of Node or None
        The handle of each slot; None while the node is removed.
    """

    def __init__(self) -> None:
        self.nodes: list[Any] = []
        self.columns: dict[str, np.ndarray] = {}
        self._make_room(_ROOM)

    def append(self, node: Any, parent: int, number: int, identity: int) -> int:
        """Add a node at the identity; return its slot."""
        if self.count == self.room:
            self._make_room(2 * self.room)
        slot = self.add(parent, number, identity)
        self.nodes.append(node)
        self.columns["object_id"][slot] = identity
        return slot

    def world_poses(self, slots: np.ndarray) -> np.ndarray:
        """Return world-from-node of given slots, (N, 4, 4) float64, as of the last update."""
        return matrices_of(self.columns["world"][slots])

    def packed(self, removed: list[int]) -> tuple[NodeArrays, np.ndarray]:
        """Return new arrays with the nodes and the removed nodes that may come back.

        Also return the new slot of each old one, -1 for freed slots. The nodes themselves are not
        changed yet.
        """
        count = self.count
        stays = self.columns["flags"][:count] & ALIVE != 0
        stays[removed] = True
        rows = np.flatnonzero(stays)
        slots = np.full(count + 1, -1, np.int32)  # the last entry maps -1, "none", to itself
        slots[rows] = np.arange(len(rows), dtype=np.int32)
        other = NodeArrays()
        other._make_room(max(_ROOM, 2 * len(rows)))
        for name, column in self.columns.items():
            kept = column[rows]
            other.columns[name][: len(rows)] = slots[kept] if name in _LINKS else kept
        other.nodes = [self.nodes[slot] for slot in rows.tolist()]
        other.changes = self.changes
        other.adopt(len(rows))
        return other, slots

    def _make_room(self, room: int) -> None:
        columns = {}
        for name, (dtype, row) in _COLUMNS.items():
            columns[name] = np.zeros((room, *row), dtype)
            columns[name][: self.count] = self.columns.get(name, columns[name])[: self.count]
        rows = NativeRows(columns)
        self.attach(
            **{name: column for name, column in columns.items() if name not in _NOT_ATTACHED}
        )
        self.columns, self.rows = columns, rows


def matrices_of(rows: np.ndarray) -> np.ndarray:
    """Return 4x4 matrices from their first three rows, (N, 12)."""
    matrices = np.zeros((len(rows), 4, 4))
    matrices[:, :3] = rows.reshape(-1, 3, 4)
    matrices[:, 3, 3] = 1.0
    return matrices
