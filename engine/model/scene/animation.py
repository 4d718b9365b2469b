"""Simple animation of nodes, spins and keyframes, as functions of time.

In: nodes, their motions, and the time. Out: their poses. A pose depends only on the time, never on
earlier frames, with the same bits on every machine. All spins are evaluated together.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterable
from typing import Any, TypeAlias, TypeVar, cast
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike

from ...base import linalg
from ...base.numbers import floats, real
from ...base.validation import finite, flag, frozen_floats, vector3
from ...errors import InvalidArgumentError
from ..motion.interpolation import slerp
from .clock import Clock
from .nodes import Node
from .scene import Scene

_SLOWEST = 6  # far nodes move at least every 2**6 updates


class Animator(Clock):
    """Moves nodes of a scene by spins and keyframes.

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
        self._spins: list[Spin] = []
        self._tracks: list[Track] = []
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
        self._add([Spin(node, node.rotation, **given) for node in nodes], [])

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
            Whether to restart after the last keyframe instead of holding it.

        Raises
        ------
        InvalidArgumentError
        """
        self._scene.select([node])
        self._add([], [Track(node, times, translations, rotations, scales, repeat)])

    def _copied_to(self, scene: Scene, copy_of: Callable[[Node], Node]) -> Animator:
        """Return an animator of a copied scene; nodes that were removed are left out."""
        made = Animator(scene, full_rate_distance=self.full_rate_distance)
        made._spins, made._tracks = _copied(self._spins, copy_of), _copied(self._tracks, copy_of)
        made.time, made.paused, made._updates = self.time, self.paused, self._updates
        return made

    def _add(self, spins: list[Spin], tracks: list[Track]) -> None:
        """Add motions to those of the animator."""
        self._spins += spins
        self._tracks += tracks
        self._moving = None

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
            # If only the animator remembers a spin, its node is gone for good.
            self._spins = [spin for spin in self._spins if spin.node is not None]
            self._tracks = [track for track in self._tracks if track.node is not None]
            self._moving = _Moving(self._scene, self._spins, self._tracks)
        moving = self._moving
        moving.spins.move(self.time, self._due(moving.spins.rows, eye))
        rows = self._scene.data.slots_of(map(_node_of, moving.tracks))
        for number in self._due(rows, eye).tolist():
            moving.tracks[number].move(self.time)

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


Motions: TypeAlias = "tuple[tuple[Spin, ...], tuple[Track, ...]]"


def motions_of(animator: Animator) -> Motions:
    """Return all spins and keyframes, including those of nodes currently out of the scene."""
    return tuple(animator._spins), tuple(animator._tracks)


def set_motions(animator: Animator, motions: Motions) -> None:
    """Replace all motions of an animator."""
    spins, tracks = motions
    animator._spins, animator._tracks = list(spins), list(tracks)
    animator._moving = None


class _Described:
    """The motion of one node, which may have been removed.

    A removed node may come back (`Scene.restore`), so its motion is kept as long as the node
    exists.
    """

    def __init__(self, node: Node) -> None:
        self._node = ref(node)

    @property
    def node(self) -> Node | None:
        return self._node()


Motion = TypeVar("Motion", bound=_Described)


def _copied(motions: Iterable[Motion], copy_of: Callable[[Node], Node]) -> list[Motion]:
    """Return motions for the copies of their nodes."""
    made = []
    for motion in motions:
        node = motion.node
        if node is not None and copy_of(node) is not node:
            copied = copy.copy(motion)
            copied._node = ref(copy_of(node))
            made.append(copied)
    return made


def _node_of(described: _Described) -> Node:
    """Return the node of a motion; the scene holds it."""
    return cast("Node", described.node)


class Spin(_Described):
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

    def __init__(self, scene: Scene, spins: list[Spin], tracks: list[Track]) -> None:
        self.removals = scene.data.removals  # also grows when a node comes back
        self.spins = _Spins(scene, [spin for spin in spins if _is_in(scene, spin)])
        self.tracks = [track for track in tracks if _is_in(scene, track)]


def _is_in(scene: Scene, described: _Described) -> bool:
    node = described.node
    return node is not None and node.scene is scene


class _Spins:
    """All spins of an animator as arrays."""

    def __init__(self, scene: Scene, spins: list[Spin]) -> None:
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


class Track(_Described):
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
        if self.repeat and last > first:
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
