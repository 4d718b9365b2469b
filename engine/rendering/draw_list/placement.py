"""Places the listed nodes: those that may show, at the poses that they have now.

In: the arrays of a scene's nodes, and what the picture leaves out. Out: the draws of a
`NativeDrawList`, placed by C.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..._native.rasterizer import NativeDrawList
from ...model.scene.staged_data import NodeRows
from .._memo import Memo


class Placing(NamedTuple):
    """The selection and the cameras of a picture's nodes."""

    frustum: np.ndarray | None = None  # clip_from_world: what is outside is left out
    marks: float = 0.0  # how far lines and points reach beyond, as a share of half the image
    flat: bool = False  # boxes are tested one by one, without their trees
    batching: bool = True  # nodes of one mesh are drawn as one


class Placement:
    """The draws of one native draw list.

    Attributes
    ----------
    changes : int
        Grows whenever something is drawn elsewhere.
    """

    def __init__(self, native: NativeDrawList) -> None:
        self._native = native
        self._placed = Memo()
        self._frustum: np.ndarray | None = None
        self._how = 1.0, False, True  # widen, flat and batching
        self._selected: bytes | None = None
        self.changes = 0

    def forget(self) -> None:
        """Place all that is listed anew."""
        self._placed.forget()

    def shows(self, arrays: NodeRows) -> bool:
        """Whether everything is still where it was."""
        return self._placed.is_of(arrays, arrays.changes)

    def place(self, arrays: NodeRows, placing: Placing, has_marks: bool, anew: bool) -> None:
        """List the draws of what may show, where it is now.

        Parameters
        ----------
        arrays : NodeArrays
        placing : Placing
        has_marks : bool
            Whether anything is drawn as lines or points.
        anew : bool
            Whether draws are listed though the same nodes may show.
        """
        frustum, marks, flat, batching = placing
        how = 1.0 + marks if has_marks else 1.0, flat, batching
        # Changes after the update show in the next frame.
        moved = self._placed.differs(arrays, arrays.updated)
        if not moved and self._frustum is frustum and self._how == how:
            return
        self._placed.forget()  # for if anything below raises
        selection, tested = None, 0
        if frustum is not None:
            selection = np.empty((arrays.count + 63) // 64, np.uint64)
            tested = arrays.select(frustum, how[0], flat, selection)
        self._native.node_boxes_tested = tested
        selected = None if selection is None else selection.tobytes()
        is_same = selected is not None and selected == self._selected
        if moved or anew or not is_same or batching != self._how[2]:
            self._native.place(arrays.count, arrays.columns, selection, frustum, *how, moved)
        self.changes += moved
        self._selected, self._frustum, self._how = selected, frustum, how
        self._placed.done()
