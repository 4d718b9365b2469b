"""A command that assigns: names, switches, objects and colliders of nodes; what materials,
textures, lights, cameras and the scene itself are made of.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ...base.held_values import kept
from ...base.language import translated, translated_count
from ...model.materials.material import Material, put_states_color, states_color
from ...model.scene.cameras import Camera
from ...model.scene.lights import DirectLight
from ...model.scene.nodes import Node
from ...model.scene.placements import Placements
from .history import Command

#: What places a node: set back together, since each changes the others in its last bits.
_PLACE = frozenset(("translation", "rotation", "euler", "scale", "pose"))


class SetEach(Command):
    """Assigns attributes of objects, each its own.

    Parameters
    ----------
    values : iterable of (object, dict of str to object)
        Values by attribute for each Node, Material, Texture, Mesh, light, camera or Scene. What
        must go together, such as near and far planes, is checked once all are assigned.
    label : str, optional
    """

    def __init__(self, values: Iterable[tuple[Any, Mapping[str, Any]]], label: str = "") -> None:
        # The callers may keep modifying their own.
        self._values = tuple((thing, kept(dict(held))) for thing, held in values)
        things = [thing for thing, _ in self._values]
        self.nodes = tuple(thing for thing in things if isinstance(thing, Node))
        names = dict.fromkeys(name for _, held in self._values for name in held)
        self.label = label or translated(
            "Set {values} of {things}", values=", ".join(names), things=_named(things)
        )
        self._old: list[tuple[Any, str, Any, bool]] = []
        self._places: Placements | None = None

    def do(self) -> None:
        self._old = []
        moved = [
            thing
            for thing, values in self._values
            if isinstance(thing, Node) and not _PLACE.isdisjoint(values)
        ]
        self._places = Placements(moved[0].scene, moved) if moved else None
        try:
            for thing, values in self._values:
                for name, value in values.items():
                    stated = isinstance(thing, Material) and states_color(thing)
                    self._old.append((thing, name, kept(getattr(thing, name)), stated))
                    setattr(thing, name, value)
                check(thing)
        except BaseException:
            self.undo()
            raise

    def undo(self) -> None:
        for thing, name, old, stated in reversed(self._old):
            setattr(thing, name, old)
            if isinstance(thing, Material):
                put_states_color(thing, stated)
        if self._places is not None:
            self._places.put(self._places.nodes[0].scene)

    def absorb(self, later: Command) -> bool:
        if not isinstance(later, SetEach) or later._assigned() != self._assigned():
            return False
        self._values = later._values
        return True

    def _assigned(self) -> list[tuple[int, frozenset[str]]]:
        return [(id(thing), frozenset(values)) for thing, values in self._values]


class SetValues(SetEach):
    """Assigns the same attributes to several objects.

    Parameters
    ----------
    things : iterable of Node, Material, Texture, Mesh, light, camera or Scene
    values : dict of str to object
        By attribute, for all of the things.
    label : str, optional
    """

    def __init__(self, things: Iterable[Any], values: Mapping[str, Any], label: str = "") -> None:
        super().__init__(((thing, values) for thing in things), label)


def check(thing: Any) -> None:
    """Raise if an object's values conflict, such as its near and far planes."""
    if isinstance(thing, Camera):
        thing.projection((1, 1))
    elif isinstance(thing, DirectLight):
        thing.check()


def _named(things: Sequence[Any]) -> str:
    if len(things) != 1:
        return translated_count("{count:,} thing", "{count:,} things", len(things))
    name = getattr(things[0], "name", "")
    return repr(name) if name else type(things[0]).__name__
