"""Places the listed nodes that may be visible, at their current poses.

In: the arrays of a scene's nodes, and the picture's culling options. Out: the draws of a
`NativeDrawList`, placed by C.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..._native.rasterizer import NativeDrawList
from ...model.scene.staged_data import NodeRows
from .._memo import Memo


class Placing(NamedTuple):
    """Which nodes to place, and the frustum to cull them by."""

    frustum: np.ndarray | None = None  # clip_from_world: nodes outside are culled
    marks: float = 0.0  # how far lines and points may extend, as a fraction of half the image
    flat: bool = False  # test boxes one by one, without their trees
    batching: bool = True  # draw nodes of one mesh together


class Placement:
    """The draws of one native draw list.

    Attributes
    ----------
    changes : int
        Grows whenever a draw moves.
    """

    def __init__(self, native: NativeDrawList) -> None:
        self._native = native
        self._placed = Memo()
        self._frustum: np.ndarray | None = None
        self._how = 1.0, False, True  # widen, flat and batching
        self._selected: bytes | None = None
        self.changes = 0

    def forget(self) -> None:
        """Force placing all nodes anew."""
        self._placed.forget()

    def shows(self, arrays: NodeRows) -> bool:
        """Return whether nothing has moved."""
        return self._placed.is_of(arrays, arrays.changes)

    def place(self, arrays: NodeRows, placing: Placing, has_marks: bool, anew: bool) -> None:
        """Place the draws of potentially visible nodes at their current poses.

        Parameters
        ----------
        arrays : NodeArrays
        placing : Placing
        has_marks : bool
            Whether any lines or points are drawn.
        anew : bool
            Whether to list draws even if the same nodes may be visible.
        """
        frustum, marks, flat, batching = placing
        how = 1.0 + marks if has_marks else 1.0, flat, batching
        # Changes made after the update show in the next frame.
        moved = self._placed.differs(arrays, arrays.updated)
        if not moved and self._frustum is frustum and self._how == how:
            return
        self._placed.forget()  # in case anything below raises
        selection, tested = None, 0
        if frustum is not None:
            selection = np.empty((arrays.count + 63) // 64, np.uint64)
            tested = arrays.select(frustum, how[0], flat, selection)
        self._native.node_boxes_tested = tested
        selected = None if selection is None else selection.tobytes()
        is_same = selected is not None and selected == self._selected
        if moved or anew or not is_same or batching != self._how[2]:
            self._native.place(arrays.rows, arrays.count, selection, frustum, *how, moved)
        self.changes += moved
        self._selected, self._frustum, self._how = selected, frustum, how
        self._placed.done()
