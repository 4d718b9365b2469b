"""Actions on the selection for menus, keys and panels; each is one undoable step."""

from __future__ import annotations

from ....base.language import translated
from ....model.scene.nodes import Node
from ..gizmo import on_ground
from ..new_things.adding import add_new
from ..node_commands import (
    AddNodes,
    DeleteNodes,
    DuplicateNodes,
    GroupNodes,
    MoveNodes,
    counted,
)
from ..value_commands import SetValues
from .workspace import Workspace


def add(workspace: Workspace, what: str, parent: Node | None = None) -> None:
    """Add a new thing in view, on the ground, at the top of the tree or below a node."""
    label = translated("Add {name}", name=translated(what).lower())
    workspace.do(
        AddNodes(workspace.scene, lambda scene: add_new(scene, what, workspace.view, parent), label)
    )
    if parent is not None:
        workspace.hierarchy.set_open(parent, True)


def _do_to_selected(workspace: Workspace, command) -> None:
    """Run a command class on the scene and the selected nodes, if there are any."""
    nodes = workspace.document.selection.nodes
    if nodes:
        workspace.do(command(workspace.scene, nodes))


def delete(workspace: Workspace) -> None:
    """Delete the selected nodes."""
    _do_to_selected(workspace, DeleteNodes)


def duplicate(workspace: Workspace) -> None:
    """Copy the selected nodes; the copies are selected."""
    _do_to_selected(workspace, DuplicateNodes)


def group(workspace: Workspace) -> None:
    """Put the selected nodes below a new one."""
    _do_to_selected(workspace, GroupNodes)


def put_on_ground(workspace: Workspace) -> None:
    """Drop the selected nodes onto what is below them."""
    nodes = workspace.document.selection.nodes
    if nodes:
        move = on_ground(workspace.scene, workspace.view.up)
        label = counted(translated("Put on the ground"), nodes)
        workspace.do(MoveNodes(workspace.scene, nodes, move, label))


def toggle_visible(workspace: Workspace) -> None:
    """Hide or show the selected nodes."""
    nodes = workspace.document.selection.nodes
    if nodes:
        visible = not workspace.document.selection.active.visible
        workspace.do(SetValues(nodes, {"visible": visible}))


def select_all(workspace: Workspace) -> None:
    """Select all nodes, or none if all are selected."""
    selection, nodes = workspace.document.selection, workspace.scene.nodes
    selection.set(() if len(selection) == len(nodes) else nodes)
