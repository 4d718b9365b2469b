"""The objects of an agent's scene: immutable, so that undoing an edit is taking the old ones.

In: opened models. Out: a `Thing` for each, whose parts are the meshes of the model's nodes.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base.near_words import meant
from ...base.numbers import shown
from ...errors import InvalidArgumentError, printable
from ...model.geometry.mesh import Mesh
from ...model.materials.colors import check_color
from ...model.materials.material import Material
from ...model.scene.instances import InstancedMesh
from ...model.scene.lights import LIGHTS
from ...model.scene.shown import placing_pose, shown_object
from ...stage.painting import painted
from ...stage.viewed_scene import ViewedScene
from ...stage.visibility import mesh_of
from .indirect_light import IndirectLight, indirect_light_of

Drawable = Mesh | InstancedMesh


@dataclass(frozen=True, eq=False)
class Part:
    """A mesh of an object at its place.

    Attributes
    ----------
    name : str
        Unique within the object.
    drawn : Mesh or InstancedMesh
    pose : (4, 4) ndarray of float64
        world-from-mesh.
    color : str or None
        Replaces the materials.
    visible : bool
    """

    name: str
    drawn: Drawable
    pose: NDArray[np.float64]
    color: str | None = None
    visible: bool = True

    @property
    def triangles(self) -> int:
        times = len(self.drawn.poses) if isinstance(self.drawn, InstancedMesh) else 1
        return len(mesh_of(self.drawn).faces) * times

    def colored(self, color: str) -> Part:
        """Return this part in one colour."""
        check_color(color, "color")
        drawn = painted(self.drawn, Material(color=color, name="color"))
        return replace(self, drawn=drawn, color=color)


@dataclass(frozen=True, eq=False)
class Thing:
    """An object: what was loaded from one file, or made by one script.

    Attributes
    ----------
    name : str
        Unique in the scene.
    parts : tuple of Part
    lights : tuple of (light, pose)
        They shine while a part shows; those of an object without parts, while ``shines``.
    indirect : IndirectLight
        Shines as long as they do.
    source : str
        The file's name below the root; empty for scripts.
    format, unit : str
        Empty if unknown.
    up : str
        A key of `UP_DIRECTIONS`.
    warnings : tuple of str
    model_edges : bool
        As of `ViewedScene`.
    shines : bool
    """

    name: str
    parts: tuple[Part, ...]
    lights: tuple[tuple[Any, NDArray[np.float64]], ...] = ()
    source: str = ""
    format: str = ""
    unit: str = ""
    up: str = "+Y"
    warnings: tuple[str, ...] = field(default=())
    model_edges: bool = False
    shines: bool = True
    indirect: IndirectLight = IndirectLight()

    @property
    def triangles(self) -> int:
        return sum(part.triangles for part in self.parts)

    def label(self, part: Part) -> str:
        """Return what agents call a part: the object's name, and the part's if it has several."""
        return self.name if len(self.parts) == 1 else f"{self.name}/{part.name}"


def thing_of(viewed: ViewedScene, name: str, source: str = "") -> Thing:
    """Return the object of an opened model, whose nodes show as they do now."""
    parts: list[Part] = []
    lights = []
    taken: set[str] = set()
    viewed.scene.data.update()
    for node in viewed.scene.nodes:
        drawn = shown_object(node) if node.shown else None
        if isinstance(drawn, Drawable):
            own = printable(node.name or mesh_of(drawn).name or "part").replace("/", "_")
            parts.append(Part(unused(own, taken), drawn, placing_pose(node)))
            taken.add(parts[-1].name)
        elif isinstance(drawn, LIGHTS):
            lights.append((drawn, placing_pose(node)))
    return Thing(
        name,
        tuple(parts),
        tuple(lights),
        source,
        viewed.format or "",
        viewed.unit,
        viewed.up,
        tuple(printable(str(line)) for line in viewed.warnings),
        viewed.model_edges,
        indirect=indirect_light_of(viewed.scene),
    )


def unused(name: str, taken: Iterable[str]) -> str:
    """Return a name that is not taken: with the first free number, if need be."""
    taken, number, found = set(taken), 2, name
    while found in taken:
        found, number = f"{name}-{number}", number + 1
    return found


class Things(dict[str, Thing]):
    """The objects of a scene by name, in the order in which they came."""

    def find(
        self, names: str | Iterable[str], what: str = "objects", *, with_lamps: bool = False
    ) -> list[tuple[Thing, Part]]:
        """Return the parts that names stand for: all those of an object, or one of them.

        Raises
        ------
        InvalidArgumentError
            There is no such object; the error suggests one. Or it has no part; with ``with_lamps``
            it then stands for none.
        """
        found: dict[int, tuple[Thing, Part]] = {}
        for name in _checked_names(names, what):
            pairs = self._named(name)
            if name in self and not (pairs or with_lamps):
                raise InvalidArgumentError(f"{what}: {shown(name)} has no mesh")
            if not (pairs or name in self):
                known = [*self, *(thing.label(part) for thing, part in self.all_parts())]
                listed = ", ".join(dict.fromkeys(known[:20])) or "none yet: load a file first"
                raise InvalidArgumentError(
                    f"{what}: there is no {shown(name)}{meant(name, known)} (there are: {listed})"
                )
            found.update({id(part): (thing, part) for thing, part in pairs})
        return list(found.values())

    def _named(self, name: str) -> list[tuple[Thing, Part]]:
        if name in self:
            return [(self[name], part) for part in self[name].parts]
        return [pair for pair in self.all_parts() if pair[0].label(pair[1]) == name]

    def lamps(self, names: Any = (), hidden: Any = ()) -> list[Thing]:
        """Return the objects without parts whose lights shine, of some names or of all."""
        names, hidden = (
            _checked_names(names or list(self), "objects"),
            _checked_names(hidden or (), "hide"),
        )
        return [
            thing
            for name, thing in self.items()
            if not thing.parts and name in names and name not in hidden and thing.shines
        ]

    def all_parts(self) -> list[tuple[Thing, Part]]:
        return [(thing, part) for thing in self.values() for part in thing.parts]

    def with_parts(self, changed: dict[int, Part | None]) -> Things:
        """Return these objects with other parts in place of some, by identity; None removes."""
        found = Things()
        for name, thing in self.items():
            parts = tuple(
                part for old in thing.parts if (part := changed.get(id(old), old)) is not None
            )
            if parts or not thing.parts:
                found[name] = replace(thing, parts=parts)
        return found

    def without(self, name: str) -> Things:
        """Return these objects without one."""
        return Things({key: thing for key, thing in self.items() if key != name})


def _checked_names(names: str | Iterable[str], what: str) -> list[str]:
    names = [names] if isinstance(names, str) else names
    if not isinstance(names, (list, tuple)) or not all(isinstance(n, str) for n in names):
        raise InvalidArgumentError(f"{what} must be names of objects, not {shown(names)}")
    return list(names)
