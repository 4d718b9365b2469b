"""Simple animation of nodes, spins, keyframes, paths and orbits, as functions of time.

In: nodes, their motions, and the time. Out: their poses. A pose depends only on the time, never on
earlier frames, with the same bits on every machine. All spins are evaluated together.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from ...base import linalg
from ...base.numbers import floats, real, shown
from ...base.validation import finite, flag, frozen_floats, vector3
from ...choices import Forward, PathEnd
from ...errors import InvalidArgumentError
from ..motion.interpolation import slerp
from ..motion.node_motion import NodeMotion
from ..motion.orbits import Orbit, check_center, in_order
from ..motion.paths import Path
from .clock import Clock
from .nodes import Node
from .scene import Scene

_SLOWEST = 6  # far nodes move at least every 2**6 updates


class Animator(Clock):
    """Moves nodes of a scene by spins, keyframes, paths and orbits.

    Parameters
    ----------
    scene : Scene
    full_rate_distance : float
        `advance` moves nodes within this distance of the eye every time, nodes up to twice as far
        every second time, and so on, down to every 64th time. Infinity moves all nodes every time.

    Attributes
    ----------
    time : float
        Seconds, set by `seek` and increased by `advance`.
    paused : bool
        Whether `advance` does nothing.

    Raises
    ------
    InvalidArgumentError
    """

    def __init__(self, scene: Scene, *, full_rate_distance: float = math.inf) -> None:
        super().__init__(scene)
        if not real(full_rate_distance) > 0:
            raise InvalidArgumentError("full_rate_distance must be greater than 0")
        self._full_rate_distance = real(full_rate_distance)
        self._updates = 0
        self._motions = Motions()
        self._moving: _Moving | None = None

    @property
    def full_rate_distance(self) -> float:
        """Distance from the eye within which nodes move at every update, as given."""
        return self._full_rate_distance

    def spin(
        self,
        nodes: Node | Iterable[Node],
        *,
        period: float,
        axis: ArrayLike = (0, 1, 0),
        phase: float = 0.0,
    ) -> None:
        """Rotate nodes at a constant rate, from their current rotations.

        Parameters
        ----------
        nodes : Node or iterable of Node
        period : float
            Seconds per turn; negative reverses the direction.
        axis : (3,) float
            Axis in the node's own space; the turn is counter-clockwise seen from its tip.
        phase : float
            Rotation at time 0, in turns.

        Raises
        ------
        InvalidArgumentError
        """
        given: dict[str, Any] = {"axis": axis, "period": period, "phase": phase}
        nodes = self._scene.select(nodes if isinstance(nodes, Iterable) else [nodes]).nodes
        self._add(Motions(spins=tuple(Spin(node, node.rotation, **given) for node in nodes)))

    def track(
        self,
        node: Node,
        times: ArrayLike,
        *,
        translations: ArrayLike | None = None,
        rotations: ArrayLike | None = None,
        scales: ArrayLike | None = None,
        repeat: bool = True,
    ) -> None:
        """Animate a node by keyframes.

        Parameters
        ----------
        node : Node
        times : (K,) float
            Seconds, increasing.
        translations : (K, 3) float, optional
        rotations : (K, 4) float, optional
            Quaternions x, y, z, w; interpolated along the shorter arc at a constant rate.
        scales : (K, 3) float, optional
        repeat : bool
            Whether to restart after the last keyframe, which shows at its own time, instead of
            holding it.

        Raises
        ------
        InvalidArgumentError
        """
        self._scene.select([node])
        self._add(Motions(tracks=(Track(node, times, translations, rotations, scales, repeat),)))

    def follow(
        self,
        node: Node,
        points: ArrayLike,
        *,
        period: float,
        phase: float = 0.0,
        end: PathEnd = "close",
        smooth: bool = True,
        forward: Forward | None = None,
    ) -> None:
        """Move a node along a path through points, at a constant rate.

        Parameters
        ----------
        node : Node
        points : (K, 3) float
            At least two, in the space of the node's parent.
        period : float
            Seconds for the whole way; for the way there and back if it returns.
        phase : float
            Where it is at time 0, in ways.
        end : {"close", "return", "restart", "stop"}
            After the last point: go on to the first one, go back, jump to the first one, or stay.
        smooth : bool
            Round the corners, still through all points.
        forward : {"+X", "-X", "+Z", "-Z"}, optional
            The axis of the node that faces where it goes; it keeps its rotation if left out, and
            where the path goes straight up or down.

        Raises
        ------
        InvalidArgumentError
        """
        self._scene.select([node])
        self._add(Motions(paths=(Path(node, points, period, phase, end, smooth, forward),)))

    def orbit(
        self,
        node: Node,
        about: Node | None = None,
        *,
        radius: float,
        period: float,
        axis: ArrayLike = (0, 1, 0),
        phase: float = 0.0,
    ) -> None:
        """Move a node around another one on a circle; it keeps its rotation.

        Parameters
        ----------
        node : Node
        about : Node, optional
            The node in the middle, wherever it moves; by default the origin of the parent. One
            that is removed leaves its followers where they are.
        radius : float
            World units; those of the parent around its origin.
        period : float
            Seconds per turn; negative reverses the direction.
        axis : (3,) float
            Axis of the circle in the world, or in the parent's space around its origin; the turn is
            counter-clockwise seen from its tip.
        phase : float
            Place at time 0, in turns.

        Raises
        ------
        InvalidArgumentError
            Also if the node in the middle moves with the node.
        """
        self._scene.select([node])
        if not (about is None or (isinstance(about, Node) and about.scene is self._scene)):
            raise InvalidArgumentError(f"about must be a node of this scene, not {shown(about)}")
        made = Orbit(node, about, radius, axis, period, phase)
        check_center(made, self._motions.orbits)
        self._add(Motions(orbits=(made,)))

    def _copied_to(self, scene: Scene, copy_of: Callable[[Node], Node]) -> Animator:
        """Return an animator of a copied scene; nodes that were removed are left out."""
        made = Animator(scene, full_rate_distance=self.full_rate_distance)
        made._motions = copied_motions(self._motions, copy_of)
        made.time, made.paused, made._updates = self.time, self.paused, self._updates
        return made

    def _add(self, motions: Motions) -> None:
        """Add motions to those of the animator."""
        set_motions(self, self._motions.joined(motions))

    def advance(self, seconds: float, eye: ArrayLike | None = None) -> None:
        """Advance the time and move the nodes, unless paused.

        Parameters
        ----------
        seconds : float
        eye : (3,) float, optional
            World position of the viewer: distant nodes move less often.
        """
        if self._goes_on(seconds):
            self._updates += 1
            self._move(None if eye is None else vector3(eye, "eye"))

    def _move(self, eye: np.ndarray | None = None) -> None:
        if self._moving is None or self._moving.removals != self._scene.data.removals:
            # If only the animator remembers a motion, its node is gone for good.
            self._motions = self._motions.kept(lambda motion: motion.node is not None)
            self._moving = _Moving(self._scene, self._motions)
        moving = self._moving
        moving.spins.move(self.time, self._due(moving.spins.rows, eye))
        self._move_each(moving.tracks, eye)
        self._move_each(moving.paths, eye)
        self._move_each(in_order(moving.orbits), eye)

    def _move_each(self, motions: Sequence[Track | Path | Orbit], eye: np.ndarray | None) -> None:
        """Move the nodes of some motions, one after the other."""
        if not motions:
            return
        rows = self._scene.data.slots_of(map(_node_of, motions))
        for number in self._due(rows, eye).tolist():
            motions[number].move(self.time)

    def _due(self, rows: np.ndarray, eye: np.ndarray | None) -> np.ndarray:
        """Return the indices of those slots whose nodes move this time."""
        if eye is None or math.isinf(self._full_rate_distance):
            return np.arange(len(rows))
        self._scene.data.update()
        offsets = self._scene.data.arrays.world_poses(rows)[:, :3, 3] - eye
        distances = linalg.length(offsets)
        steps = np.ones(len(rows), np.int64)
        for power in range(_SLOWEST):
            steps[distances > self._full_rate_distance * 2.0**power] *= 2
        return np.flatnonzero((self._updates + rows) % steps == 0)


class Motions(NamedTuple):
    """The motions of an animator, in the order in which those of a kind were added.

    Attributes
    ----------
    spins, tracks, paths, orbits : tuple
    """

    spins: tuple[Spin, ...] = ()
    tracks: tuple[Track, ...] = ()
    paths: tuple[Path, ...] = ()
    orbits: tuple[Orbit, ...] = ()

    def joined(self, more: Motions) -> Motions:
        """Return these and other motions."""
        return Motions(
            self.spins + more.spins,
            self.tracks + more.tracks,
            self.paths + more.paths,
            self.orbits + more.orbits,
        )

    def kept(self, keeps: Callable[[NodeMotion], bool]) -> Motions:
        """Return those motions for which a function is true."""
        return Motions(
            tuple(filter(keeps, self.spins)),
            tuple(filter(keeps, self.tracks)),
            tuple(filter(keeps, self.paths)),
            tuple(filter(keeps, self.orbits)),
        )

    def of(self, node: Node) -> tuple[NodeMotion, ...]:
        """Return the motions of a node."""
        return tuple(motion for kind in self for motion in kind if motion.node is node)


#: The names of the kinds of motions.
MOTION_KINDS = ("spins", "tracks", "paths", "orbits")


def motions_of(animator: Animator) -> Motions:
    """Return all motions, including those of nodes currently out of the scene."""
    return animator._motions


def set_motions(animator: Animator, motions: Motions) -> None:
    """Replace all motions of an animator."""
    animator._motions = Motions(*motions)
    animator._moving = None


Motion = TypeVar("Motion", bound=NodeMotion)


def copied_motions(motions: Motions, copy_of: Callable[[Node], Node]) -> Motions:
    """Return motions for the copies of their nodes."""
    return Motions(
        _copied(motions.spins, copy_of),
        _copied(motions.tracks, copy_of),
        _copied(motions.paths, copy_of),
        _copied(motions.orbits, copy_of),
    )


def _copied(motions: Iterable[Motion], copy_of: Callable[[Node], Node]) -> tuple[Motion, ...]:
    made = (motion.copied(copy_of) for motion in motions)
    return tuple(motion for motion in made if motion is not None)


def _node_of(motion: NodeMotion) -> Node:
    """Return the node of a motion; the scene holds it."""
    return cast("Node", motion.node)


class Spin(NodeMotion):
    """A rotation of one node at a constant rate.

    Attributes
    ----------
    rotation : (4,) float64
        The rotation at phase 0.
    axis, period, phase
        As given to `Animator.spin`.
    """

    def __init__(
        self, node: Node, rotation: np.ndarray, axis: ArrayLike, period: float, phase: float
    ) -> None:
        super().__init__(node)
        self.axis, self.period = frozen_floats(axis, "axis", (3,)), finite(period, "period")
        if not self.axis.any() or abs(self.period) < 1e-300:
            raise InvalidArgumentError("a spin needs an axis and a period other than 0")
        self.phase, self.rotation = finite(phase, "phase"), rotation
        self.direction, self.rate = linalg.normalize(self.axis), 1.0 / self.period


class _Moving:
    """The motions whose nodes are in the scene."""

    def __init__(self, scene: Scene, motions: Motions) -> None:
        self.removals = scene.data.removals  # also grows when a node comes back
        spins, self.tracks, self.paths, self.orbits = motions.kept(
            lambda motion: motion.node is not None and motion.node.scene is scene
        )
        self.spins = _Spins(scene, spins)


class _Spins:
    """All spins of an animator as arrays."""

    def __init__(self, scene: Scene, spins: Sequence[Spin]) -> None:
        self.rows = scene.data.slots_of(map(_node_of, spins))
        self._arrays = scene.data.arrays
        self._axes = np.array([spin.direction for spin in spins]).reshape(-1, 3)
        self._rates = np.array([spin.rate for spin in spins])
        self._phases = np.array([spin.phase for spin in spins])
        self._first = np.array([spin.rotation for spin in spins]).reshape(-1, 4)

    def move(self, time: float, due: np.ndarray) -> None:
        if len(due) == 0:
            return
        with np.errstate(over="ignore", invalid="ignore"):
            turns = time * self._rates[due] + self._phases[due]
        turns[~np.isfinite(turns)] = 0.0  # the time overflowed
        half = math.pi * (turns - np.floor(turns))
        turn = np.empty((len(due), 4))
        turn[:, :3] = self._axes[due] * linalg.sin(half)[:, np.newaxis]
        turn[:, 3] = linalg.cos(half)
        rotations = linalg.quaternion_multiply(self._first[due], turn)
        self._arrays.set_many_parts(self.rows[due], rotations, None)


class Track(NodeMotion):
    """Keyframes of one node: arrays as given to `Animator.track`, or None."""

    def __init__(
        self,
        node: Node,
        times: ArrayLike,
        translations: ArrayLike | None,
        rotations: ArrayLike | None,
        scales: ArrayLike | None,
        repeat: bool,
    ) -> None:
        super().__init__(node)
        self.times = _keys(() if times is None else times, "times", ())
        if not len(self.times) or not (np.diff(self.times) > 0).all():
            raise InvalidArgumentError("times must increase")
        count = len(self.times)
        self.translations = _optional_keys(translations, "translations", 3, count)
        self.rotations = _optional_keys(rotations, "rotations", 4, count)
        self.scales = _optional_keys(scales, "scales", 3, count)
        if self.rotations is not None:
            with np.errstate(over="ignore"):
                squares = (self.rotations * self.rotations).sum(axis=1)
            if not ((squares > 0.0) & (squares < math.inf)).all():
                raise InvalidArgumentError("rotations must not be zero quaternions, nor overflow")
        self.repeat = flag(repeat, "repeat")

    def move(self, time: float) -> None:
        first, last = float(self.times[0]), float(self.times[-1])
        # At the last keyframe the node is where it was set to, and only then starts again.
        if self.repeat and last > first and not first <= time <= last:
            turns = (time - first) / (last - first)
            turns = turns if math.isfinite(turns) else 0.0
            time = first + (turns - math.floor(turns)) * (last - first)
        after = int(np.searchsorted(self.times, time, side="right"))
        after = min(max(after, 1), len(self.times) - 1) if len(self.times) > 1 else 0
        before = max(after - 1, 0)
        span = float(self.times[after] - self.times[before]) or 1.0
        share = min(max((time - float(self.times[before])) / span, 0.0), 1.0)
        node = self.node
        if node is None:
            return
        if self.translations is not None:
            node.translation = _between(self.translations, before, after, share)
        if self.scales is not None:
            node.scale = _between(self.scales, before, after, share)
        if self.rotations is not None:
            node.rotation = slerp(self.rotations[before], self.rotations[after], share)


def _between(values: np.ndarray, before: int, after: int, share: float) -> np.ndarray:
    return values[before] * (1.0 - share) + values[after] * share


def _optional_keys(value: ArrayLike | None, what: str, width: int, count: int) -> np.ndarray | None:
    return None if value is None else _keys(value, what, (width,), count)


def _keys(
    value: ArrayLike, what: str, row: tuple[int, ...], count: int | None = None
) -> np.ndarray:
    array = floats(value, what)
    if array.ndim != 1 + len(row) or array.shape[1:] != row:
        raise InvalidArgumentError(f"{what} must have shape (K, {row})" if row else "times: (K,)")
    if count is not None and len(array) != count:
        raise InvalidArgumentError(f"{what} has {len(array)} rows for {count} times")
    if not np.isfinite(array).all():
        raise InvalidArgumentError(f"{what} must be finite")
    return array
