"""The fields of shapes: which mesh a node has, and the sizes of primitives."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from .....base.language import translated, translated_number
from .....errors import InvalidArgumentError
from .....model.geometry.mesh import Mesh
from .....model.scene.instances import InstancedMesh
from .....model.scene.nodes import Node
from ...new_things.primitive_shapes import (
    PARTS,
    PRIMITIVES,
    arguments_of,
    changed_primitives,
    new_primitive,
    title_of,
)
from ..files import Files
from ..workspace import Workspace
from .fields import MOST_COMPARED, Fields, name_of

#: The most parts that a drag gives: more would take seconds for each step.
MOST_PARTS = {"segments": 512, "subdivisions": 6}
_LEAST_PARTS = {"Sphere": 3, "Cylinder": 3, "Torus": 3, "Plane": 1, "Icosphere": 0}
_LEAST_LENGTH = 1e-6


class ShapeFields:
    """Lays out the shapes of nodes.

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
        """Lay out the shape of nodes that hold a mesh, instances of one, or nothing."""
        if not self._fields.folder("Shape"):
            return
        held = [node.object for node in nodes]
        if not any(isinstance(each, InstancedMesh) for each in held):
            self._draw_choice(nodes, held)
            self._draw_primitives(nodes)
        meshes = [mesh_of(each) for each in held if each is not None]
        if meshes:
            self._draw_counts(held, meshes)

    def _draw_choice(self, nodes: Sequence[Node], held: Sequence[Any]) -> None:
        now = name_of(_name(each) for each in held)
        chosen = self._fields.choice("Mesh", now, self._options())
        mesh, label = chosen, ""
        if isinstance(chosen, str):
            mesh = new_primitive(self._workspace.scene, chosen)
            label = translated("Make {name}", name=translated(chosen).lower())
        if mesh is not None and any(each is not mesh for each in held):
            self._fields.set(nodes, {"object": mesh}, label)
        is_one = len(nodes) == 1
        if is_one and self._fields.button("Load a file ..."):
            self._files.load_mesh(nodes[0])
        if any(each is not None for each in held):
            if self._fields.button("Remove the mesh", beside=is_one):
                self._fields.set(nodes, {"collider": None, "object": None}, "Remove the mesh")

    def _options(self) -> Iterator[tuple[str, Any]]:
        """Return new primitives, and the meshes that there are."""
        yield "New", None
        for title in PRIMITIVES:
            yield translated(title), title
        entries = [e for e in self._workspace.resources.entries() if e.kind == "mesh"]
        if entries:
            yield "In the scene", None
        for entry in entries:
            yield entry.name, entry.thing

    def _draw_primitives(self, nodes: Sequence[Node]) -> None:
        """Lay out the arguments of primitives of one kind."""
        if len(nodes) > MOST_COMPARED or any(node.object is None for node in nodes):
            return
        titles = {title_of(node.object) for node in nodes}
        title = titles.pop() if len(titles) == 1 else None
        if title is None:
            return
        made = [arguments_of(node.object) for node in nodes]
        for name in made[-1]:
            values = [arguments[name] for arguments in made]
            rows = [value if isinstance(value, list) else [value] for value in values]
            if len({len(row) for row in rows}) == 1:
                self._draw_argument(nodes, title, name, rows)

    def _draw_argument(
        self, nodes: Sequence[Node], title: str, name: str, rows: list[list[Any]]
    ) -> None:
        label = _title(name)
        changed: dict[int, Any] | None
        if name in PARTS:
            changed = self._fields.integers(label, rows, _LEAST_PARTS[title], MOST_PARTS[name])
        else:
            speed = 0.01 * max(*rows[-1], _LEAST_LENGTH)
            changed = self._fields.numbers(label, rows, speed, low=_LEAST_LENGTH)
        if changed:
            self._change(nodes, name, changed)

    def _change(self, nodes: Sequence[Node], name: str, changed: dict[int, Any]) -> None:
        """Give each node a primitive with another argument."""
        old = [node.object for node in nodes]
        try:
            new = changed_primitives(self._workspace.scene, old, name, changed)
        except InvalidArgumentError as error:
            self._workspace.console.write_once("error", str(error))
            return
        each = [(node, {"object": mesh}) for node, mesh in zip(nodes, new, strict=True)]
        said = translated(_title(name)).lower()
        self._fields.drag(each, translated("Set the {name}", name=said))

    def _draw_counts(self, held: Sequence[Any], meshes: Sequence[Mesh]) -> None:
        instances = [len(each.poses) for each in held if isinstance(each, InstancedMesh)]
        with self._fields.fold("Counts") as is_open:
            if is_open:
                if instances:
                    self._fields.value("Instances", translated_number(sum(instances), ","))
                vertices = sum(len(mesh.positions) for mesh in meshes)
                triangles = sum(len(mesh.faces) for mesh in meshes)
                self._fields.value("Vertices", translated_number(vertices, ","))
                self._fields.value("Triangles", translated_number(triangles, ","))


def mesh_of(held: Mesh | InstancedMesh) -> Mesh:
    """Return the mesh that a node draws."""
    return held.mesh if isinstance(held, InstancedMesh) else held


def _name(held: Any) -> str:
    """Return how a shape is called."""
    if held is None:
        return translated("none")
    return mesh_of(held).name or translated("unnamed")


def _title(name: str) -> str:
    """Return the title of a primitive's argument."""
    return name.replace("_", " ").capitalize()
