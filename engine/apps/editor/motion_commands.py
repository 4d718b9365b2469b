"""Commands on motion: add, change and remove spins, orbits, paths and keyframes of nodes.

In: a document's animator, and its new motions. Out: the nodes at the places that these give them at
the present time; and, undone, where they were before, to the bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...base import linalg
from ...base.language import translated, translated_choice
from ...model.motion.node_motion import NodeMotion
from ...model.motion.orbits import Orbit, check_center, orbit_plane
from ...model.motion.paths import Path
from ...model.scene.animation import Animator, Motions, Spin, Track, motions_of, set_motions
from ...model.scene.nodes import Node
from ...model.scene.placements import Placements
from ...model.scene.scene import Scene
from .history import Command

#: Seconds per turn of new spins, orbits and paths.
USUAL_PERIOD = 4.0
#: Keys nearer in time than this are one.
SAME_TIME = 1e-4
_KINDS = {Spin: "spins", Orbit: "orbits", Path: "paths", Track: "tracks"}
NAMES = {Spin: "spin", Orbit: "orbit", Path: "path", Track: "keyframes"}


class SetMotions(Command):
    """Gives an animator other motions.

    Parameters
    ----------
    animator : Animator
        Of the document.
    scene : Scene
    change : callable
        ``change(motions)`` returns the new ones.
    label : str
    nodes : iterable of Node
        Those whose motions differ.
    """

    def __init__(
        self,
        animator: Animator,
        scene: Scene,
        change: Callable[[Motions], Motions],
        label: str,
        nodes: tuple[Node, ...],
    ) -> None:
        self.label, self.nodes = label, nodes
        self._animator, self._scene = animator, scene
        self._change = change
        self._old = motions_of(animator)
        self._new: Motions | None = None

    def do(self) -> None:
        self._new = self._new or self._change(self._old)
        moving = {motion.node: None for kind in (*self._old, *self._new) for motion in kind}
        there = [node for node in moving if node is not None and node.scene is self._scene]
        self._time, self._places = self._animator.time, Placements(self._scene, there)
        set_motions(self._animator, self._new)
        self._rest_stopped()
        self._animator.seek(self._time)

    def undo(self) -> None:
        set_motions(self._animator, self._old)
        self._places.put(self._scene)
        if self._animator.time != self._time:
            self._animator.seek(self._animator.time)

    def absorb(self, later: Command) -> bool:
        if not (isinstance(later, SetMotions) and later.nodes == self.nodes):
            return False
        self._new = later._new
        return True

    def _rest_stopped(self) -> None:
        """Turn nodes that no longer spin as they were turned before they did."""
        turns = {spin.node for spin in self._new.spins}
        for spin in set(self._old.spins) - set(self._new.spins):
            node = spin.node
            if node is not None and node.scene is self._scene and node not in turns:
                node.rotation = spin.rotation


def added(motion: NodeMotion) -> Callable[[Motions], Motions]:
    """Return the change that adds a motion, in place of one of the same kind of its node."""
    kind = _KINDS[type(motion)]

    def change(motions: Motions) -> Motions:
        held = [each for each in getattr(motions, kind) if each.node is not motion.node]
        made = motions._replace(**{kind: (*held, motion)})
        if isinstance(motion, Orbit):
            check_center(motion, [orbit for orbit in made.orbits if orbit is not motion])
        return made

    return change


def removed(motion: NodeMotion) -> Callable[[Motions], Motions]:
    """Return the change that removes a motion."""
    return lambda motions: motions.kept(lambda each: each is not motion)


def label_of(what: str, motion: NodeMotion) -> str:
    """Return a label such as "Add the orbit of 'Moon'"."""
    node = motion.node
    return translated(
        "{what} the {motion} of {name}",
        what=translated(what),
        motion=translated_choice("motion", NAMES[type(motion)]),
        name=repr("" if node is None else node.name),
    )


# New motions, as the places of nodes suggest


def new_spin(node: Node, time: float) -> Spin:
    """Return a turn about the node's own Y, which leaves it as it is at a time."""
    return Spin(node, node.rotation, (0.0, 1.0, 0.0), USUAL_PERIOD, _phase(-time))


def new_orbit(
    node: Node, about: Node | None, *, time: float, reach: float, axis=(0.0, 1.0, 0.0)
) -> Orbit:
    """Return a circle on which a node is now.

    Parameters
    ----------
    node : Node
    about : Node or None
        What is in the middle.
    time : float
        The present time.
    reach : float
        The radius if the node stands in the middle.
    axis : (3,) float
    """
    if about is None:
        offset = np.asarray(node.translation)
    else:
        offset = node.world_pose[:3, 3] - about.world_pose[:3, 3]
    across, along = orbit_plane(axis)
    x, y = float(linalg.dot(offset, across)), float(linalg.dot(offset, along))
    radius = math.sqrt(x * x + y * y)
    if not radius > 1e-9 * max(reach, 1.0):
        return Orbit(node, about, reach, axis, USUAL_PERIOD, 0.0)
    turn = float(linalg.atan2(y, x)) / (2.0 * math.pi)
    return Orbit(node, about, radius, axis, USUAL_PERIOD, _phase(turn * USUAL_PERIOD - time))


def new_path(node: Node, *, time: float, reach: float) -> Path:
    """Return a way through the corners of a square, the first of which is where a node is now."""
    offsets = np.array([(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)], np.float64)
    return Path(node, node.translation + offsets * reach, USUAL_PERIOD, _phase(-time))


def _phase(seconds: float) -> float:
    """Return the share of a usual period that seconds are, from 0 to 1."""
    turns = seconds / USUAL_PERIOD
    return turns - math.floor(turns) + 0.0  # not -0.0


# Keyframes


def with_key(node: Node, track: Track | None, time: float) -> Track:
    """Return keyframes with one of where a node is now, at a time; all its parts if it is new."""
    parts = {"translations": node.translation, "rotations": node.rotation, "scales": node.scale}
    if track is None:
        return Track(node, [time], *([value] for value in parts.values()), True)
    place = int(np.searchsorted(track.times, time - SAME_TIME))
    replaces = place < len(track.times) and abs(track.times[place] - time) <= SAME_TIME
    rows = slice(place, place + replaces)
    return _rebuilt(
        track,
        _spliced(track.times, rows, time),
        lambda name, held: _spliced(held, rows, parts[name]),
    )


def without_key(track: Track, number: int) -> Track | None:
    """Return keyframes without one; None if it was the last."""
    if len(track.times) == 1:
        return None
    drop = lambda rows: np.delete(rows, number, axis=0)  # noqa: E731
    return _rebuilt(track, drop(track.times), lambda _, rows: drop(rows))


def with_key_at(track: Track, number: int, time: float) -> Track:
    """Return keyframes with one moved in time, but not past another."""
    times = track.times.copy()
    low = times[number - 1] + SAME_TIME if number else 0.0
    high = times[number + 1] - SAME_TIME if number + 1 < len(times) else math.inf
    times[number] = min(max(time, low), max(high, low))
    return _rebuilt(track, times, lambda _, rows: rows)


def with_repeat(track: Track, repeat: bool) -> Track:
    """Return keyframes that start again after the last one, or don't."""
    return _rebuilt(track, track.times, lambda _, rows: rows, repeat)


def key_near(track: Track, time: float) -> int | None:
    """Return the number of the key at a time."""
    number = int(np.argmin(np.abs(track.times - time)))
    return number if abs(float(track.times[number]) - time) <= SAME_TIME else None


def _rebuilt(
    track: Track,
    times: np.ndarray,
    part: Callable[[str, np.ndarray], np.ndarray],
    repeat: bool | None = None,
) -> Track:
    held = {name: getattr(track, name) for name in ("translations", "rotations", "scales")}
    rows = {name: None if now is None else part(name, now) for name, now in held.items()}
    return Track(track.node, times, *rows.values(), track.repeat if repeat is None else repeat)


def _spliced(rows: np.ndarray, where: slice, row) -> np.ndarray:
    """Return an array with some rows replaced by one."""
    return np.concatenate([rows[: where.start], np.asarray(row)[np.newaxis], rows[where.stop :]])
