"""The list of meshes, materials and textures for a panel: used by the scene, or unused.

In: a scene, and unused objects. Out: one entry each, recomputed only when nodes get other objects,
or an object changes.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

import numpy as np

from ...base.language import translated
from ...io.resources import size_of
from ...model.geometry.mesh import Mesh
from ...model.geometry.origins import FileOrigin, origin_of
from ...model.materials.material import Material, textures_of
from ...model.materials.textures import Texture, image_file_of
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...model.scene.usage import users_of, uses_in

Thing: TypeAlias = Mesh | Material | Texture


class Entry(NamedTuple):
    """A resource that nodes use, or may use.

    Attributes
    ----------
    name : str
        "unnamed" if it has none.
    kind : {"mesh", "material", "texture"}
    thing : Mesh, Material or Texture
    size : int
        Bytes of its arrays; 0 of materials.
    path : str or None
        The file that it is of.
    users : int
        How many nodes use it.
    """

    name: str
    kind: str
    thing: Thing
    size: int
    path: str | None
    users: int


class ResourceList:
    """The list of a scene's resources.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._kept: dict[Thing, None] = {}
        self._entries: tuple[Entry, ...] = ()
        self._objects: np.ndarray | None = None
        self._versions: tuple = ()

    def keep(self, thing: Thing) -> None:
        """Keep a resource in the list even if no node uses it."""
        self._kept[thing] = None

    @property
    def kept(self) -> tuple[Thing, ...]:
        """What is kept, in the order in which files hold it; assignable."""
        return tuple(self._kept)

    @kept.setter
    def kept(self, things: Iterable[Thing]) -> None:
        self._kept = dict.fromkeys(things)

    @property
    def kept_materials(self) -> tuple[Material, ...]:
        """The kept materials: files hold them even if no node uses them."""
        return tuple(thing for thing in self._kept if isinstance(thing, Material))

    def drop(self, thing: Thing) -> None:
        """Remove a resource from the list when no node uses it."""
        self._kept.pop(thing, None)

    def entries(self) -> tuple[Entry, ...]:
        """Return all entries by kind and name: the same object until an entry changes."""
        arrays = self._scene.data.arrays
        objects = arrays.columns["object"][: arrays.count]
        same = self._objects is not None and np.array_equal(objects, self._objects)
        versions = self._found_versions()
        if not same or versions != self._versions:
            self._entries = self._found()
            self._objects, self._versions = objects.copy(), self._found_versions()
        return self._entries

    def find(self, name: str, kind: str | None = None) -> Thing | None:
        """Return the first resource with a name, and optionally of a kind, or None."""
        for entry in self.entries():
            if entry.name == name and kind in (None, entry.kind):
                return entry.thing
        return None

    def users(self, thing: Thing) -> tuple[Node, ...]:
        """Return the nodes that use a resource."""
        return users_of(self._scene, thing)

    def _found_versions(self) -> tuple:
        """Return versions that differ if an entry changes, appears or disappears."""
        things = (entry.thing for entry in self._entries)
        names = tuple((id(thing), thing.version, thing.name) for thing in things)
        return (
            names,
            self._scene.data.objects.version,
            self._scene.data.removals,
            tuple(map(id, self._kept)),
        )

    def _found(self) -> tuple[Entry, ...]:
        uses = dict.fromkeys(self._with_parts(), 0) | uses_in([self._scene])
        entries = [_entry(thing, count) for thing, count in uses.items()]
        return tuple(sorted(entries, key=lambda entry: (entry.kind, entry.name.casefold())))

    def _with_parts(self) -> list[Thing]:
        """Return the kept resources with the resources they refer to."""
        found: list[Thing] = []
        for thing in self._kept:
            materials = thing.materials if isinstance(thing, Mesh) else [thing]
            found.append(thing)
            for material in materials:
                if isinstance(material, Material):
                    found += [material, *textures_of(material).values()]
        return found


def _entry(thing: Thing, users: int) -> Entry:
    name = thing.name or translated("unnamed")
    if isinstance(thing, Material):
        return Entry(name, "material", thing, 0, None, users)
    if isinstance(thing, Texture):
        return Entry(name, "texture", thing, size_of(thing), image_file_of(thing).path, users)
    came = origin_of(thing)
    is_of_file = came is not None and isinstance(came.origin, FileOrigin)
    return Entry(
        name, "mesh", thing, size_of(thing), came.origin.path if is_of_file else None, users
    )
