"""The fields of materials: what most need first, the rest folded."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from typing import Any

from .....base.language import translated, translated_count
from .....model.geometry.mesh import Mesh
from .....model.geometry.twins import twin_of
from .....model.materials.material import PARAMETERS, Material, copy_of, textures_of
from .....model.materials.parameters import FLAG, Parameter, TextureSlot
from .....model.materials.textures import Texture
from .....model.scene.instances import InstancedMesh
from .....model.scene.nodes import Node
from ...material_commands import free_name
from ..files import Files
from ..materials.material_actions import KINDS, set_physical
from ..translated_imgui import imgui
from ..workspace import Workspace
from .fields import DIFFERS, Fields, name_of
from .shape_fields import mesh_of

#: Always shown, of those that count.
_FIRST = ("color", "texture", "metallic", "roughness", "specular", "shininess", "emissive")
_EXTENSION = "KHR_materials_"


class MaterialFields:
    """Lays out the materials of meshes.

    Parameters
    ----------
    workspace : Workspace
    files : Files
        Asks for those that are to be loaded.
    fields : Fields
    """

    def __init__(self, workspace: Workspace, files: Files, fields: Fields) -> None:
        self._workspace, self._files, self._fields = workspace, files, fields

    def draw(self, nodes: Sequence[Node]) -> None:
        """Lay out the materials of nodes that hold meshes, or instances of one."""
        meshes = list(dict.fromkeys(mesh_of(node.object) for node in nodes))
        count = len(meshes[-1].materials)
        if any(len(mesh.materials) != count for mesh in meshes):
            if self._fields.folder("Materials"):
                self._fields.note("The objects have different numbers of materials: select one.")
            return
        for number in range(count):
            materials = list(dict.fromkeys(mesh.materials[number] for mesh in meshes))
            name = name_of(material.name for material in materials)
            title = translated("Material {number}", number=number + 1)
            if count == 1:
                title = translated("Material")
            title += f": {name}" if name else ""
            if self._fields.folder(f"{title}###material {number}"):
                imgui.push_id(number)
                self._draw_use(nodes, meshes, number, materials)
                self._draw_kind(materials)
                self.draw_values(materials)
                imgui.pop_id()

    def _draw_use(
        self,
        nodes: Sequence[Node],
        meshes: Sequence[Mesh],
        number: int,
        materials: Sequence[Material],
    ) -> None:
        """Lay out which material is used, and by how many others."""
        now = name_of(material.name or translated("unnamed") for material in materials)
        entries = self._workspace.resources.entries()
        options = ((entry.name, entry.thing) for entry in entries if entry.kind == "material")
        chosen = self._fields.choice("Use", now, options)
        if chosen is not None and [chosen] != list(materials):
            each = [
                (mesh, {"materials": _replaced(mesh.materials, number, chosen)}) for mesh in meshes
            ]
            self._fields.set_each(each, "Use a material")
        others = sum(entry.users for entry in entries if entry.thing in materials) - len(nodes)
        if others > 0:
            self._fields.note(
                translated_count(
                    "Also used by {count:,} other object.",
                    "Also used by {count:,} other objects.",
                    others,
                )
            )
            if self._fields.button("Make a copy of its own"):
                self._make_own(nodes)

    def _draw_kind(self, materials: Sequence[Material]) -> None:
        """Lay out whether materials are simple or physical."""
        now = name_of(KINDS[material.is_physical] for material in materials)
        chosen = self._fields.choice("Kind", now, [(kind, kind) for kind in KINDS], "surface")
        if chosen is not None:
            set_physical(self._workspace, materials, chosen == "physical")

    def _make_own(self, nodes: Sequence[Node]) -> None:
        """Give nodes a mesh with materials that no other node uses; they share among themselves."""
        materials: dict[Material, Material] = {}
        meshes: dict[Mesh, Mesh] = {}
        for node in nodes:
            mesh = mesh_of(node.object)
            for old in mesh.materials:
                if old not in materials:
                    materials[old] = self._copied(old, node)
            own = [materials[old] for old in mesh.materials]
            meshes.setdefault(mesh, twin_of(mesh, own, mesh.name))
        each = [(node, {"object": _with_mesh(node.object, meshes)}) for node in nodes]
        self._fields.set_each(each, "Make a material of its own")

    def _copied(self, material: Material, node: Node) -> Material:
        """Return a copy for a node; one without a name is called as the node, to be told apart."""
        copy = copy_of(material)
        copy.name = copy.name or free_name(self._workspace.resources, node.name)
        return copy

    def draw_values(self, materials: Sequence[Material]) -> None:
        """Lay out what materials are made of."""
        rows = dict(_affecting(materials[0].is_physical))
        if len({material.is_physical for material in materials}) > 1:
            others = _affecting(not materials[0].is_physical)
            rows = {name: row for name, row in rows.items() if name in others}
        for name in _FIRST:
            if name in rows:
                self._draw_parameter(materials, name, rows.pop(name))
        parts: dict[str, dict[str, Parameter]] = {}
        for name, row in rows.items():
            if row.kind is FLAG or row.kind.width or isinstance(row, TextureSlot):
                parts.setdefault(_part(row), {})[name] = row
        for part, held in parts.items():
            with self._fields.fold(part) as is_open:
                if is_open:
                    for name, row in held.items():
                        self._draw_parameter(materials, name, row)

    def _draw_parameter(self, materials: Sequence[Material], name: str, row: Parameter) -> None:
        kind, fields = row.kind, self._fields
        if isinstance(row, TextureSlot):
            self._draw_slot(materials, name, row.title)
        elif kind is FLAG:
            fields.flag(materials, name, row.title)
        elif kind.width > 1:
            fields.color(materials, name, row.title)
        elif kind.high == 1.0:
            if all(getattr(material, name) is not None for material in materials):
                fields.share(materials, name, row.title)
        elif kind.high > 1.0:
            speed = 0.01 * max(getattr(materials[-1], name), 1.0)
            fields.number(materials, name, row.title, speed, max(kind.low, -1e9))

    def _draw_slot(self, materials: Sequence[Material], slot: str, label: str) -> None:
        held = [textures_of(material).get(slot) for material in materials]
        now = name_of(_name(each) for each in held)
        imgui.push_id(slot)
        chosen = self._fields.choice(label, now, self._textures())
        if chosen is not None and any(chosen[0] is not each for each in held):
            self._fields.set(materials, {slot: chosen[0]})
        if self._fields.button("Load an image ..."):
            self._files.load_texture(materials, slot)
        if held[-1] is not None and now != DIFFERS:
            height, width = held[-1].pixels.shape[:2]
            self._fields.note(f"{width} x {height}")
        imgui.pop_id()

    def _textures(self) -> Iterator[tuple[str, tuple[Any]]]:
        """Yield the textures to choose from, each in a tuple, and none."""
        yield _name(None), (None,)
        for entry in self._workspace.resources.entries():
            if entry.kind == "texture":
                yield entry.name, (entry.thing,)


def _name(texture: Texture | None) -> str:
    """Return how a texture is called."""
    return translated("none") if texture is None else texture.name or translated("unnamed")


def _replaced(materials: Sequence[Material], number: int, chosen: Material) -> list[Material]:
    return [*materials[:number], chosen, *materials[number + 1 :]]


def _with_mesh(held: Mesh | InstancedMesh, meshes: dict[Mesh, Mesh]) -> Mesh | InstancedMesh:
    if isinstance(held, InstancedMesh):
        return InstancedMesh(meshes[held.mesh], held.poses, colors=held.colors)
    return meshes[held]


@functools.cache
def _affecting(is_physical: bool) -> dict[str, Parameter]:
    """Return the parameters that affect a material: most of glTF's need a physical one."""
    if is_physical:
        return {k: row for k, row in PARAMETERS.items() if row.gltf or not row.kind.width}
    return {k: row for k, row in PARAMETERS.items() if not row.part.startswith(_EXTENSION)}


def _part(row: Parameter) -> str:
    """Return the title of the fold that a parameter lies in."""
    if not row.part.startswith(_EXTENSION):
        return "More textures" if isinstance(row, TextureSlot) else "More"
    return row.part.removeprefix(_EXTENSION).replace("_", " ").capitalize()
