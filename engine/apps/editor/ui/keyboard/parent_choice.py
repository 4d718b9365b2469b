"""The choice of another parent for the selected nodes.

In: the scene. Out: a command.
"""

from __future__ import annotations

from .....base.language import translated
from .....model.scene.nodes import Node, with_below
from ...node_commands import Reparent
from ..workspace import Workspace
from .list_dialog import ListDialog, Option


class ParentChoice:
    """Asks which node the selected ones are to be below.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._dialog = ListDialog("Parent to")

    def open(self) -> None:
        """Ask."""
        self._workspace.hold_keys()
        self._dialog.ask(self._options())

    def draw(self) -> None:
        """Lay the question out, if it is open."""
        self._dialog.draw()

    def _options(self) -> list[Option]:
        """Return the nodes that can be parents, and none."""
        workspace = self._workspace
        moved = workspace.document.selection.topmost()
        below = {each for node in moved for each in with_below(node)}
        top = translated("none: at the top of the tree")
        others = (node for node in workspace.scene.nodes if node not in below)
        return [Option(top, lambda: put_below(workspace, None)), *map(self._option, others)]

    def _option(self, node: Node) -> Option:
        name = node.name or translated("node {number}", number=node.id)
        above = "" if node.parent is None else node.parent.name
        return Option(name, lambda: put_below(self._workspace, node), above)


def put_below(workspace: Workspace, parent: Node | None) -> None:
    """Put the selected nodes below another, or at the top; they stay where they are."""
    selected = workspace.document.selection.topmost()
    if nodes := [node for node in selected if node.parent is not parent]:
        workspace.do(Reparent(workspace.scene, nodes, parent))
    if parent is not None:
        workspace.hierarchy.set_open(parent, True)
