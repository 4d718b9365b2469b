"""The way of the selection through the rows of the tree, by clicks and by keys.

In: rows, and keys from ImGui. Out: selected nodes, and nodes opened and closed.
"""

from __future__ import annotations

from .....model.scene.nodes import Node
from ...hierarchy import Rows
from ..translated_imgui import imgui
from ..workspace import Workspace
from .owned_keys import ENTER, STEPS, own, pressed

_SIDEWAYS = ("left_arrow", "right_arrow")


class TreeCursor:
    """Selects rows of the tree.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._anchor: Node | None = None
        self._seen = -1

    def click(self, node: Node, rows: Rows) -> None:
        """Select a node; with Shift all from the last one on, with Ctrl it alone in addition."""
        io = imgui.get_io()
        if io.key_ctrl and not io.key_shift:
            self._workspace.document.selection.toggle(node)
            self._anchor = node
        else:
            self._go(node, rows)

    def press_keys(self, rows: Rows) -> None:
        """Follow the arrow keys, in the window of the rows while it has the keyboard."""
        io = imgui.get_io()
        if not imgui.is_window_focused() or io.want_text_input or io.key_ctrl or io.key_alt:
            return
        own("tree", (*STEPS, *_SIDEWAYS, *ENTER))
        imgui.set_nav_cursor_visible(False)  # Space plays, and acts on no row
        for key, step in STEPS.items():
            if pressed(key):
                self._step(rows, step)
        active = self._workspace.document.selection.active
        place = None if active is None else rows.place(active)
        if place is None:
            return
        if pressed("left_arrow"):
            self._fold(rows, place)
        if pressed("right_arrow"):
            self._unfold(rows, place)
        if any(pressed(key, again=False) for key in ENTER):
            self._workspace.go_to("Properties")

    def _go(self, node: Node, rows: Rows) -> None:
        """Select a node, with Shift all rows from the anchor to it; it is the active one."""
        selection = self._workspace.document.selection
        anchor = self._anchor
        if imgui.get_io().key_shift and anchor is not None and rows.place(anchor) is not None:
            between = rows.between(anchor, node)
            selection.set([*(each for each in between if each is not node), node])
        else:
            selection.set([node])
            self._anchor = node
        self._seen = selection.version

    def _step(self, rows: Rows, step: int) -> None:
        if not rows:
            return
        selection = self._workspace.document.selection
        active = selection.active
        if selection.version != self._seen:
            self._anchor = active  # it was selected elsewhere
        place = None if active is None else rows.place(active)
        if place is None:
            place = -1 if step > 0 else len(rows)
            step = 1 if step > 0 else -1
        self._go(rows[min(max(place + step, 0), len(rows) - 1)].node, rows)

    def _fold(self, rows: Rows, place: int) -> None:
        """Close a node, or go to the one above it."""
        row = rows[place]
        if row.is_open and not self._workspace.hierarchy.search:
            self._workspace.hierarchy.set_open(row.node, False)
        elif row.node.parent is not None:
            self._go(row.node.parent, rows)

    def _unfold(self, rows: Rows, place: int) -> None:
        """Open a node, or go to the first one below it."""
        row = rows[place]
        if row.is_open:
            # A search shows a node without those below it that it does not find.
            if place + 1 < len(rows) and rows[place + 1].node.parent is row.node:
                self._go(rows[place + 1].node, rows)
        elif row.has_children:
            below = imgui.get_io().key_shift
            self._workspace.hierarchy.set_open(row.node, True, below=below)
