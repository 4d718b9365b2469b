"""Commands on materials: make, copy and discard them, and give them to nodes.

In: a document's resources, nodes, a material. Out: undoable steps. A mesh that other nodes show as
well is not changed for one of them: the node gets another mesh over the same arrays.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...base.language import translated
from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.geometry.twins import twin_of
from ...model.materials.material import Material, copy_of
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from .history import Command
from .new_things.free_names import FreeNames
from .node_commands import named
from .resource_list import ResourceList
from .value_commands import SetEach, SetValues


class KeepMaterial(Command):
    """Lists a material, whether nodes use it or not.

    Parameters
    ----------
    resources : ResourceList
    material : Material
    label : str
    """

    def __init__(self, resources: ResourceList, material: Material, label: str) -> None:
        self.label = label
        self._resources, self._material = resources, material

    def do(self) -> None:
        self._kept = self._resources.kept
        self._resources.keep(self._material)

    def undo(self) -> None:
        self._resources.kept = self._kept


class DiscardMaterial(Command):
    """Takes a material that nodes do not use from the list."""

    def __init__(self, resources: ResourceList, material: Material) -> None:
        if resources.users(material):
            raise InvalidArgumentError("nodes use this material")
        self.label = translated("Delete the material {name}", name=repr(material.name))
        self._resources, self._material = resources, material

    def do(self) -> None:
        self._kept = self._resources.kept
        self._resources.drop(self._material)

    def undo(self) -> None:
        self._resources.kept = self._kept


class Dress(Command):
    """Gives nodes a material; replaced ones that have names stay in the list.

    Parameters
    ----------
    resources : ResourceList
    nodes : iterable of Node
        Those without a mesh are left as they are.
    material : Material
    slot : int, optional
        The number of the mesh's material that it replaces; all if left out.
    is_new : bool
        Whether to list the material, too: the step makes it.

    Raises
    ------
    InvalidArgumentError
        None of the nodes has a mesh.
    """

    def __init__(
        self,
        resources: ResourceList,
        nodes: Iterable[Node],
        material: Material,
        slot: int | None = None,
        *,
        is_new: bool = False,
    ) -> None:
        self.nodes = tuple(node for node in nodes if mesh_of(node) is not None)
        if not self.nodes:
            raise InvalidArgumentError("a material needs a node with a mesh")
        name = material.name or translated("a material")
        self.label = translated("Give {name} to {things}", name=name, things=named(self.nodes))
        self._resources, self._material, self._slot = resources, material, slot
        self._new = [material] if is_new else []
        self._steps: list[SetEach] | None = None

    def do(self) -> None:
        self._kept = self._resources.kept
        if self._steps is None:
            self._steps = self._made()
            self._listed = [*self._new, *self._named()]
        for step in self._steps:
            step.do()
        for material in self._listed:
            self._resources.keep(material)

    def undo(self) -> None:
        for step in reversed(self._steps or []):
            step.undo()
        self._resources.kept = self._kept

    def _named(self) -> list[Material]:
        """Return the materials with names that may be replaced."""
        meshes = dict.fromkeys(mesh for node in self.nodes if (mesh := mesh_of(node)) is not None)
        return [each for mesh in meshes for each in mesh.materials if each.name]

    def _made(self) -> list[SetEach]:
        """Return a step for each mesh, whose nodes go on sharing what they get."""
        by_mesh: dict[Mesh, list[Node]] = {}
        for node in self.nodes:
            mesh = mesh_of(node)
            if mesh is not None:
                by_mesh.setdefault(mesh, []).append(node)
        return [self._step(mesh, nodes) for mesh, nodes in by_mesh.items()]

    def _step(self, mesh: Mesh, nodes: list[Node]) -> SetEach:
        materials = [self._material] * len(mesh.materials)
        if self._slot is not None and self._slot < len(materials):
            materials = list(mesh.materials)
            materials[self._slot] = self._material
        users = set(self._resources.users(mesh))
        is_shared = not users <= set(nodes)
        if is_shared:
            twin = twin_of(mesh, materials, mesh.name)
            return SetEach((node, {"object": _showing(node.object, twin)}) for node in nodes)
        return SetValues([mesh], {"materials": materials})


def _showing(held: object, mesh: Mesh) -> Mesh | InstancedMesh:
    """Return a mesh as a node held another one: once, or at the same places."""
    if isinstance(held, InstancedMesh):
        return InstancedMesh(mesh, held.poses, colors=held.colors)
    return mesh


def mesh_of(node: Node | None) -> Mesh | None:
    """Return the mesh that a node shows, once or many times; None if it shows none."""
    held = getattr(node, "object", None)
    held = held.mesh if isinstance(held, InstancedMesh) else held
    return held if isinstance(held, Mesh) else None


def new_material(resources: ResourceList, like: Material | None = None) -> Material:
    """Return a material under a name of its own: a plain one, or a copy of another."""
    material = Material() if like is None else copy_of(like)
    material.name = free_name(resources, "material" if like is None else like.name or "material")
    return material


def free_name(resources: ResourceList, name: str) -> str:
    """Return a name that no material has: "red", then "red 2"."""
    taken = {entry.name for entry in resources.entries() if entry.kind == "material"}
    return FreeNames(taken).free(name)
