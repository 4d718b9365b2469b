"""The scene that a picture of an agent's objects shows.

In: parts of objects, and objects that are lights alone. Out: a `Shown`, which tells what the IDs of
frames stand for.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...stage.near_origin import moved_near
from ...stage.viewed_scene import ViewedScene
from ..sheet.visible import Shown as Counted
from ..sheet.visible import count_by_key
from .indirect_light import joined
from .things import Part, Thing

#: Ambient light of scenes without lights: that of a look replaces it.
_NO_LIGHT = (0, 0, 0)


class Shown(NamedTuple):
    """Parts in a scene of their own.

    Attributes
    ----------
    viewed : ViewedScene
    owners : dict of int to (Thing, Part)
        By the IDs of nodes.
    lamps : sequence of Thing
        Objects without parts, whose lights shine on the others.
    """

    viewed: ViewedScene
    owners: dict[int, tuple[Thing, Part]]
    lamps: Sequence[Thing] = ()

    @property
    def origin(self) -> NDArray[np.float64]:
        """Where the scene's origin is in the objects' coordinates, (3,)."""
        return np.array(self.viewed.origin, np.float64)

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The box around the parts in the objects' coordinates, (2, 3)."""
        return np.asarray(self.viewed.scene.bounds, np.float64) + self.origin

    def nodes_of(self, parts: list[tuple[Thing, Part]]) -> list[Node]:
        """Return the nodes of some parts."""
        wanted = {id(part) for _, part in parts}
        nodes = self.viewed.scene.nodes
        return [n for n in nodes if n.id in self.owners and id(self.owners[n.id][1]) in wanted]

    def own_pixels(self, frame: Frame) -> NDArray[np.bool_]:
        """Return where a frame shows parts, (H, W), and not the ground or the background."""
        most = max(self.owners, default=-1)
        return (frame.object_id >= 0) & (frame.object_id <= most)

    def visible(self, frame: Frame) -> list[tuple[str, Counted]]:
        """Return the parts that show, with the pixels and the box of each, largest first."""
        counted = count_by_key(frame.object_id, self.own_pixels(frame))
        named = [(self.label(one.key), one) for one in counted]
        return sorted(named, key=lambda pair: (-pair[1].pixels, pair[0]))

    def label(self, node: int) -> str:
        """Return the name of the part with a node's ID."""
        thing, part = self.owners[node]
        return thing.label(part)


def shown_scene(parts: list[tuple[Thing, Part]], lamps: Sequence[Thing] = ()) -> Shown:
    """Return a scene of parts, with the lights of their objects and of lamps."""
    scene = Scene(ambient=_NO_LIGHT)
    owners = {}
    for thing, part in parts:
        node = scene.add(part.drawn, name=thing.label(part), pose=part.pose)
        owners[node.id] = thing, part
    things = list(dict.fromkeys(thing for thing, _ in parts))
    light_scene(scene, parts, lamps)
    viewed = ViewedScene(
        scene,
        ", ".join(thing.name for thing in things) or "nothing",
        up=things[0].up if things else "+Y",
        themed=True,
        appearance={"cull": "auto"},
        model_edges=bool(things) and all(thing.model_edges for thing in things),
        unit=things[0].unit if len({thing.unit for thing in things}) == 1 else "",
    )
    return Shown(moved_near(viewed), owners, lamps)


def light_scene(scene: Scene, parts: list[tuple[Thing, Part]], lamps: Sequence[Thing] = ()) -> None:
    """Give a scene the light of the objects of parts, and of lamps.

    Where they have lights, their ambient light shines, too: that of several is the larger one in
    each channel. Without lights, the look's light takes its place. Of environments it is the first.
    """
    lights = lights_of(parts, lamps)
    for light, pose in lights:
        scene.add(light, pose=pose)
    indirect = joined([thing.indirect for thing in _shining(parts, lamps)])
    indirect.put(scene, with_ambient=bool(lights))


def lights_of(
    parts: list[tuple[Thing, Part]], lamps: Sequence[Thing] = ()
) -> list[tuple[Any, NDArray[np.float64]]]:
    """Return the lights of the objects of parts, and of lamps, with their poses."""
    return [light for thing in _shining(parts, lamps) for light in thing.lights]


def _shining(parts: list[tuple[Thing, Part]], lamps: Sequence[Thing]) -> list[Thing]:
    return list(dict.fromkeys([*(thing for thing, _ in parts), *lamps]))
