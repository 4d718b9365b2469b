"""Actions on materials for panels and menus; each is one undoable step.

In: the workspace. Out: commands.
"""

from __future__ import annotations

from collections.abc import Iterable

from .....base.language import translated, translated_choice, translated_count
from .....errors import InvalidArgumentError
from .....model.materials.material import Material
from .....model.scene.nodes import Node
from ...history import Command
from ...material_commands import DiscardMaterial, Dress, KeepMaterial, mesh_of, new_material
from ...picking import Pick
from ...value_commands import SetValues
from ..translated_imgui import imgui
from ..workspace import Workspace

#: What a dragged material is called.
PAYLOAD = "material"
#: What materials are: with the values of Blinn and Phong, or of the metallic-roughness model.
KINDS = ("simple", "physical")
_PHYSICAL, _SIMPLE = {"metallic": 0.0, "roughness": 0.5}, {"metallic": None, "roughness": None}


def add(workspace: Workspace, like: Material | None = None) -> Material:
    """Make a material, or a copy of one, and list it; return it."""
    material = new_material(workspace.resources, like)
    what = translated("Add" if like is None else "Duplicate as")
    workspace.do(KeepMaterial(workspace.resources, material, f"{what} {material.name!r}"))
    return material


def add_to_selected(workspace: Workspace) -> None:
    """Make a material, and give it to the selected nodes, if there are any, in one step."""
    nodes = workspace.document.selection.nodes
    if any(mesh_of(node) is not None for node in nodes):
        material = new_material(workspace.resources)
        workspace.do(Dress(workspace.resources, nodes, material, is_new=True))
    else:
        add(workspace)


def give(workspace: Workspace, material: Material, nodes, slot: int | None = None) -> None:
    """Give a material to nodes."""
    _try(workspace, lambda: Dress(workspace.resources, nodes, material, slot))


def discard(workspace: Workspace, material: Material) -> None:
    """Take a material that nobody uses from the list."""
    _try(workspace, lambda: DiscardMaterial(workspace.resources, material))


def rename(workspace: Workspace, material: Material, name: str) -> None:
    """Give a material another name."""
    if name != material.name:
        label = translated("Rename to {name}", name=repr(name))
        workspace.do(SetValues([material], {"name": name}, label))


def set_physical(workspace: Workspace, materials: Iterable[Material], is_physical: bool) -> None:
    """Make those materials physical, or simple, that are not."""
    others = [material for material in materials if material.is_physical != is_physical]
    if others:
        values = _PHYSICAL if is_physical else _SIMPLE
        kind = translated_choice("surface", "physical" if is_physical else "simple")
        name = repr(others[0].name or translated("unnamed"))
        if len(others) > 1:
            name = translated_count("{count:,} material", "{count:,} materials", len(others))
        workspace.do(
            SetValues(others, values, translated("Make {name} {kind}", name=name, kind=kind))
        )


def drag(material: Material) -> None:
    """Let the mouse drag a material from the last item."""
    if imgui.begin_drag_drop_source():
        imgui.set_drag_drop_payload_py_id(PAYLOAD, id(material))
        imgui.text(material.name or translated("unnamed"))
        imgui.end_drag_drop_source()


def accept(workspace: Workspace, node: Node | None, found: Pick | None = None) -> None:
    """Take a material that is dropped on the last item, within its own target.

    Parameters
    ----------
    workspace : Workspace
    node : Node or None
        Gets it.
    found : Pick, optional
        What is under the mouse: only the material of this face is replaced.
    """
    payload = imgui.accept_drag_drop_payload_py_id(PAYLOAD)
    material = None if payload is None else _dragged(workspace, payload.data_id)
    if material is None or node is None:
        return
    mesh, slot = mesh_of(node), None
    if mesh is not None and found is not None and found.material in mesh.materials:
        slot = mesh.materials.index(found.material)
    selection = workspace.document.selection
    chosen = selection.nodes if node in selection and found is None else (node,)
    give(workspace, material, chosen, slot)


def _dragged(workspace: Workspace, number: int) -> Material | None:
    entries = workspace.resources.entries()
    things = (entry.thing for entry in entries if entry.kind == "material")
    return next((thing for thing in things if id(thing) == number), None)


def _try(workspace: Workspace, make) -> None:
    """Run the command that a function returns; tell why there is none."""
    try:
        command: Command = make()
    except InvalidArgumentError as error:
        workspace.console.write("error", str(error))
        return
    workspace.do(command)
