"""Orbits: nodes that circle others at a constant rate, or the origin of their parent.

In: a node, what it circles, and the time. Out: the node's translation. Nodes that circle nodes
which circle others are moved after these, so that a moon follows its planet.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, cast
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike

from ...base import linalg
from ...base.validation import finite, frozen_floats, not_negative
from ...errors import InvalidArgumentError
from ..scene.nodes import Node
from .node_motion import NodeMotion, turns_at

if TYPE_CHECKING:
    from typing_extensions import Self


#: What an orbit is made of, besides its node, in the order of its parameters.
ORBIT_VALUES = ("about", "radius", "axis", "period", "phase")


class Orbit(NodeMotion):
    """A circle of one node at a constant rate; it keeps the node's rotation.

    Attributes
    ----------
    axis, radius, period, phase
        As given to `Animator.orbit`.
    rate : float
        Turns per second.
    """

    def __init__(
        self,
        node: Node,
        about: Node | None,
        radius: float,
        axis: ArrayLike,
        period: float,
        phase: float,
    ) -> None:
        super().__init__(node)
        self._about = None if about is None else ref(about)
        self.axis, self.period = frozen_floats(axis, "axis", (3,)), finite(period, "period")
        if not self.axis.any() or abs(self.period) < 1e-300:
            raise InvalidArgumentError("an orbit needs an axis and a period other than 0")
        self.radius, self.phase = not_negative(radius, "radius"), finite(phase, "phase")
        self.rate = 1.0 / self.period
        self._plane = orbit_plane(self.axis)

    @property
    def about(self) -> Node | None:
        """The node that is circled; None for the origin of the parent, or if it is gone."""
        return None if self._about is None else self._about()

    @property
    def is_about_node(self) -> bool:
        """Whether it circles a node, which may be gone."""
        return self._about is not None

    def place(self, time: float) -> np.ndarray:
        """Return the offset from the centre at a time, (3,) float64."""
        turns = turns_at(time, self.rate, self.phase)
        angle = 2.0 * math.pi * (turns - math.floor(turns))
        across, along = self._plane
        return self.radius * (across * linalg.cos(angle) + along * linalg.sin(angle))

    def move(self, time: float) -> None:
        """Place the node; without its centre, or in a flat parent, it stays where it is."""
        node = self.node
        if node is None:
            return
        offset = self.place(time)
        if self._about is None:
            node.translation = offset
            return
        about = self._about()
        if about is None or about.scene is not node.scene:
            return
        place = about.world_pose[:3, 3] + offset
        if node.parent is not None:
            try:
                into = linalg.inverse(node.parent.world_pose)
            except InvalidArgumentError:
                return
            place = linalg.transform_points(into, place[np.newaxis])[0]
        if np.isfinite(place).all():
            node.translation = place

    def changed(self, **values: Any) -> Orbit:
        """Return the orbit with some of `ORBIT_VALUES` replaced."""
        held = {name: getattr(self, name) for name in ORBIT_VALUES} | values
        made = Orbit(cast("Node", self.node), *held.values())
        if "about" not in values:
            made._about = self._about  # also of a node that is gone
        return made

    def copied(self, copy_of: Callable[[Node], Node]) -> Self | None:
        made = super().copied(copy_of)
        if made is not None and self.about is not None:
            made._about = ref(copy_of(self.about))
        return made

    def waits_for(self) -> Iterator[Node]:
        """Yield the nodes whose places decide where this one comes to stand."""
        node = self.node
        above = None if node is None else node.parent
        for start in (self.about, above):
            while start is not None:
                yield start
                start = start.parent


def orbit_plane(axis: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """Return the directions at phase 0 and at a quarter turn about an axis: unit vectors."""
    direction = linalg.normalize(axis)
    sizes = np.abs(direction)
    least = 2 - int(np.argmin(sizes[::-1]))  # the last of the least: +X for +Y
    across = linalg.normalize(linalg.cross(direction, np.eye(3)[least]))
    return across, linalg.cross(direction, across)


def in_order(orbits: Iterable[Orbit]) -> list[Orbit]:
    """Return orbits such that those which others wait for come first."""
    return _sorted(orbits)[0]


def circling(orbits: Iterable[Orbit]) -> Orbit | None:
    """Return an orbit about what moves with its own node; None if there is none."""
    return _sorted(orbits)[1]


def check_center(orbit: Orbit, others: Iterable[Orbit]) -> None:
    """Raise `InvalidArgumentError` if what a node circles moves with it, given other orbits."""
    node = orbit.node
    if node is not None and circling([*others, orbit]) is not None:
        raise InvalidArgumentError(f"{node.name!r} cannot circle what moves with it")


def _sorted(orbits: Iterable[Orbit]) -> tuple[list[Orbit], Orbit | None]:
    """Return orbits as `in_order`, and one that waits for itself; such circles break somewhere."""
    waiting = list(orbits)
    of_node: dict[Node, list[Orbit]] = {}
    for orbit in waiting:
        if orbit.node is not None:
            of_node.setdefault(orbit.node, []).append(orbit)
    done: dict[Orbit, None] = {}
    begun: set[Orbit] = set()
    circle = None
    stack = waiting[::-1]
    while stack:
        orbit = stack.pop()
        if orbit in begun:
            done.setdefault(orbit)
            continue
        begun.add(orbit)
        before = [each for node in orbit.waits_for() for each in of_node.get(node, ())]
        if any(each in begun and each not in done for each in before):
            circle = circle or orbit
        stack += [orbit, *(each for each in before if each not in begun)]
    return list(done), circle
