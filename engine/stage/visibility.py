"""Hides objects and materials of a scene in the viewer.

In: a scene; the parts that the user hides, shows, or isolates. Out: a staged scene without the
hidden nodes, and with meshes that lack the faces of hidden materials; the scene itself is
unchanged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, TypeAlias, TypeVar

import numpy as np

from ..base.language import translated
from ..model.geometry.mesh import Mesh
from ..model.geometry.vertex_attributes import attributes_of
from ..model.materials.linear_colors import floats_are_linear
from ..model.materials.material import Material
from ..model.scene.instances import InstancedMesh
from ..model.scene.nodes import Node
from ..model.scene.staged_scene import StagedScene
from ..rendering.frame import Frame
from .inspection.cut_faces import hatching
from .painting import painted

DRAWABLE = (Mesh, InstancedMesh)
Drawable: TypeAlias = Mesh | InstancedMesh
#: Key of a material: its name, or its identity if it has none.
MaterialKey: TypeAlias = str | int
Key = TypeVar("Key")


class Entry(NamedTuple):
    """An object or material: its name, its number of triangles, and whether it is visible."""

    name: str
    triangles: int
    shown: bool


class Visibility:
    """Hides parts of a scene in its staged scene, and paints the others.

    Parameters
    ----------
    staged : StagedScene
    shown_as : callable, optional
        Returns what is drawn for a `Mesh` or `InstancedMesh`, with its faces in the same order.
    paint : Material, optional
        The scene is drawn in this material instead of its own.
    """

    def __init__(
        self,
        staged: StagedScene,
        shown_as: Callable[[Any], Drawable] | None = None,
        paint: Material | None = None,
    ) -> None:
        self._staged = staged
        self._shown_as = shown_as
        self._paint = paint
        nodes = staged.scene.nodes
        self._nodes = [node for node in nodes if isinstance(node.object, DRAWABLE)]
        used = [material for mesh in self._meshes() for material in mesh.materials]
        self._materials = list(dict.fromkeys(map(_key, used)))
        self._hidden_nodes: set[Node] = set()
        self._hidden_materials: set[MaterialKey] = set()
        if shown_as is not None or paint is not None:
            self._apply()

    def _meshes(self) -> Iterator[Mesh]:
        return (mesh_of(thing) for thing in self._things())

    def _things(self) -> Iterator[Mesh | InstancedMesh]:
        things = (node.object for node in self._nodes)
        return (thing for thing in things if isinstance(thing, DRAWABLE))

    def objects(self) -> list[Entry]:
        """Return the objects in scene order."""
        return [
            Entry(
                node.name or translated("object {number}", number=node.id),
                _triangles(node.object) if isinstance(node.object, DRAWABLE) else 0,
                node not in self._hidden_nodes,
            )
            for node in self._nodes
        ]

    def materials(self) -> list[Entry]:
        """Return the materials; materials with the same name are one entry."""
        counts = dict.fromkeys(self._materials, 0)
        for thing in self._things():
            mesh = mesh_of(thing)
            times = len(thing.poses) if isinstance(thing, InstancedMesh) else 1
            faces = np.bincount(mesh.material_ids, minlength=len(mesh.materials))
            for material, count in zip(mesh.materials, faces.tolist(), strict=False):
                counts[_key(material)] = counts.get(_key(material), 0) + count * times
        names = [key if isinstance(key, str) else translated("unnamed") for key in self._materials]
        shown = [key not in self._hidden_materials for key in self._materials]
        return list(map(Entry, names, counts.values(), shown))

    def toggle_object(self, number: int, alone: bool = False) -> None:
        """Hide or show one of `objects`; or isolate it, and then show all again."""
        self._hidden_nodes = _toggled(self._hidden_nodes, self._nodes, number, alone)
        self._apply()

    def toggle_material(self, number: int, alone: bool = False) -> None:
        """Hide or show one of `materials`; or isolate it, and then show all again."""
        self._hidden_materials = _toggled(self._hidden_materials, self._materials, number, alone)
        self._apply()

    def take_over(self, other: Visibility) -> None:
        """Hide what another scene with the same parts hides."""
        self._hidden_materials = set(other._hidden_materials)
        if len(self._nodes) == len(other._nodes):
            both = zip(self._nodes, other._nodes, strict=True)
            self._hidden_nodes = {mine for mine, node in both if node in other._hidden_nodes}
        if self._hidden_materials or self._hidden_nodes:
            self._apply()

    @property
    def hidden_nodes(self) -> frozenset[Node]:
        """The nodes that are hidden."""
        return frozenset(self._hidden_nodes)

    def tell_whole_face(self, frame: Frame, x: int, y: int) -> None:
        """Map a pixel's face ID from the drawn part to the whole mesh."""
        face = int(frame.face_id[y, x])
        if face < 0 or not self._hidden_materials:
            return
        number = int(frame.object_id[y, x])
        node = next((node for node in self._nodes if node.id == number), None)
        if node is not None:
            kept = self._kept(mesh_of(node.object))
            frame.face_id[y, x] = np.flatnonzero(kept)[face]

    def _apply(self) -> None:
        changes = self._hidden_materials or self._shown_as or self._paint
        self._staged.hide(self._hidden_nodes, self._drawn_part if changes else None)

    def _drawn_part(self, thing: Drawable) -> Drawable:
        """Return what is drawn of a mesh, or of instances of one."""
        part = self._visible_part(thing)
        if self._paint is None or mesh_of(part).materials[0] is hatching():
            return part
        return painted(part, self._paint)

    def _kept(self, mesh: Mesh) -> np.ndarray:
        """Return which faces of a mesh have visible materials."""
        hidden = [_key(material) in self._hidden_materials for material in mesh.materials]
        return ~np.array(hidden, bool)[mesh.material_ids]

    def _visible_part(self, thing: Drawable) -> Drawable:
        """Return a mesh, or instances of one, without the faces of hidden materials."""
        kept = self._kept(mesh_of(thing))
        thing = thing if self._shown_as is None else self._shown_as(thing)
        if kept.all():
            return thing
        part = _with_faces(mesh_of(thing), kept)
        if isinstance(thing, InstancedMesh):
            return InstancedMesh(part, thing.poses, colors=thing.colors)
        return part


def mesh_of(thing: Any) -> Mesh:
    """Return the mesh of a node's object."""
    return thing.mesh if isinstance(thing, InstancedMesh) else thing


def _key(material: Material) -> MaterialKey:
    """Return a material's key: its name, or its identity if it has none."""
    return material.name or id(material)


def _triangles(thing: Drawable) -> int:
    count = len(mesh_of(thing).faces)
    return count * len(thing.poses) if isinstance(thing, InstancedMesh) else count


def _toggled(hidden: set[Key], everything: list[Key], number: int, alone: bool) -> set[Key]:
    one = everything[number]
    if not alone:
        return hidden ^ {one}
    others = set(everything) - {one}
    return set() if hidden == others else others


def _with_faces(mesh: Mesh, kept: np.ndarray) -> Mesh:
    mesh = mesh.with_creases()  # the remaining faces keep their normals
    edges = mesh.edge_visible
    attributes: dict[str, Any] = attributes_of(mesh)
    with floats_are_linear():
        return Mesh(
            mesh.positions,
            mesh.faces[kept],
            normals=mesh.normals,
            materials=mesh.materials,
            material_ids=mesh.material_ids[kept],
            lines=mesh.lines,
            points=mesh.points,
            edge_visible=None if edges is None else edges[kept],
            position_ids=mesh.position_ids,
            joints=mesh.joints,
            weights=mesh.weights,
            morph_targets=mesh.morph_targets,
            name=mesh.name,
            **attributes,
        )
