"""Actions on the selection for menus, keys and panels; each is one undoable step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ....base.language import translated
from ....model import primitives
from ....model.scene.ambient_lights import HemisphereLight
from ....model.scene.cameras import PerspectiveCamera
from ....model.scene.lights import DIRECT_LIGHTS
from ....model.scene.nodes import Node
from ..gizmo import on_ground
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

#: Things that can be added, by menu label.
ADDED: dict[str, Callable[[], Any]] = {
    "Empty": lambda: None,
    "Box": primitives.box,
    "Sphere": primitives.uv_sphere,
    "Icosphere": primitives.icosphere,
    "Cylinder": primitives.cylinder,
    "Torus": primitives.torus,
    "Plane": primitives.plane,
    **{f"{name.capitalize()} light": light for name, light in DIRECT_LIGHTS.items()},
    "Hemisphere light": HemisphereLight,
    "Camera": PerspectiveCamera,
}


def add(workspace: Workspace, what: str, parent: Node | None = None) -> None:
    """Add a node with a new object, at the camera's target, or below a node."""
    name = what.lower()
    place = (0.0, 0.0, 0.0) if parent is not None else workspace.view.target

    def add_one(scene):
        scene.add(ADDED[what](), name=name, parent=parent, translation=place)

    workspace.do(
        AddNodes(workspace.scene, add_one, translated("Add {name}", name=translated(what).lower()))
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
        workspace.do(
            MoveNodes(workspace.scene, nodes, move, counted(translated("Put down"), nodes))
        )


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
