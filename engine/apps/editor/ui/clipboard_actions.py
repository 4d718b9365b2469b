"""Copy, cut and paste, by the clipboard of the window system.

In: the selection, the clipboard's text. Out: commands; text for this and other windows.
"""

from __future__ import annotations

from ....base.language import translated
from ....errors import Engine3DError
from ....model.scene.nodes import Node
from ..node_commands import DeleteNodes, counted
from .translated_imgui import imgui
from .workspace import Workspace


def copy(workspace: Workspace) -> bool:
    """Copy the selected nodes; return whether there were any."""
    nodes = workspace.document.selection.nodes
    if not nodes:
        return False
    text, told = workspace.clipboard.copy(nodes)
    imgui.set_clipboard_text(text)
    for message in told:
        workspace.console.write("warning", translated("Copy: {message}", message=message))
    copied = counted(translated("Copy"), workspace.document.selection.topmost())
    workspace.console.write("message", copied)
    return True


def cut(workspace: Workspace) -> None:
    """Copy the selected nodes, and delete them."""
    if copy(workspace):
        command = DeleteNodes(workspace.scene, workspace.document.selection.nodes)
        command.label = counted(translated("Cut"), command.nodes)
        workspace.do(command)


def paste_below(workspace: Workspace) -> None:
    """Add the nodes of the clipboard as children of the active node."""
    parent = workspace.document.selection.active
    paste(workspace, parent)
    if parent is not None:
        workspace.hierarchy.set_open(parent, True)


def paste(workspace: Workspace, parent: Node | None = None) -> None:
    """Add the nodes of the clipboard, where they were copied; they are selected."""
    try:
        with workspace.console.warnings_noted():
            text = imgui.get_clipboard_text()
            command = workspace.clipboard.paste(workspace.scene, text, parent)
    except Engine3DError as error:
        workspace.console.write("error", translated("Paste: {reason}", reason=error))
        return
    workspace.do(command)
