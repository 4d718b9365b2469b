"""Paths: nodes that go along a line through points at a constant rate.

In: points in the space of the node's parent, and the time. Out: the node's translation, and its
rotation if it faces where it goes. Curves are cubic Hermite splines with the tangents of Catmull
and Rom (1974); a point is reached after a share of the period as the distances say.
"""

from __future__ import annotations

import math
from typing import Any, cast, get_args

import numpy as np
from numpy.typing import ArrayLike

from ..._native.loaders import frozen
from ...base import linalg
from ...base.numbers import floats
from ...base.validation import choose, finite, flag, positive
from ...choices import Forward, PathEnd
from ...errors import InvalidArgumentError
from ..scene.nodes import Node
from .interpolation import spline
from .node_motion import NodeMotion, turns_at

ENDS = get_args(PathEnd)
FORWARDS = get_args(Forward)
_STEEPEST = 1.0 - 1e-9  # cosine from +Y, above which a direction has no heading


#: What a path is made of, besides its node, in the order of its parameters.
PATH_VALUES = ("points", "period", "phase", "end", "smooth", "forward")


class Path(NodeMotion):
    """A line that one node follows.

    Attributes
    ----------
    points : (K, 3) float64
        Read-only.
    period, phase, end, smooth, forward
        As given to `Animator.follow`.
    shares : (N,) float64
        The share of the way at which each distinct point is reached, from 0 to 1.
    """

    def __init__(
        self,
        node: Node,
        points: ArrayLike,
        period: float,
        phase: float = 0.0,
        end: PathEnd = "close",
        smooth: bool = True,
        forward: Forward | None = None,
    ) -> None:
        super().__init__(node)
        self.points = _checked_points(points)
        self.period, self.phase = positive(period, "period"), finite(phase, "phase")
        self.end: PathEnd = choose(end, ENDS, "end")
        self.smooth = flag(smooth, "smooth")
        self.forward: Forward | None = (
            None if forward is None else choose(forward, FORWARDS, "forward")
        )
        self._knots, self.shares = _knots(self.points, self.end == "close")
        self._tangents = _tangents(self._knots, self.shares, self.smooth, self.end == "close")

    def changed(self, **values: Any) -> Path:
        """Return the path with some of `PATH_VALUES` replaced."""
        held = {name: getattr(self, name) for name in PATH_VALUES} | values
        return Path(cast("Node", self.node), *held.values())

    def move(self, time: float) -> None:
        """Place the node."""
        node = self.node
        if node is None:
            return
        share, backwards = self._share(time)
        place, direction = self.at(share)
        if not np.isfinite(place).all():
            return
        node.translation = place
        rotation = None if self.forward is None else facing(direction, self.forward, backwards)
        if rotation is not None:
            node.rotation = rotation

    def _share(self, time: float) -> tuple[float, bool]:
        """Return the share of the way that is done, and whether it is the way back."""
        turns = turns_at(time, 1.0 / self.period, self.phase)
        if self.end == "stop":
            return min(max(turns, 0.0), 1.0), False
        share = turns - math.floor(turns)
        if self.end == "return":
            return (2.0 * share, False) if share <= 0.5 else (2.0 - 2.0 * share, True)
        return share, False

    def at(self, share: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the place at a share of the way, and the direction: (3,) float64 each."""
        times = self.shares
        after = min(max(int(np.searchsorted(times, share, side="right")), 1), len(times) - 1)
        before = after - 1
        span = float(times[after] - times[before])
        part = min(max((share - float(times[before])) / span, 0.0), 1.0)
        start, end = self._knots[before], self._knots[after]
        if not self.smooth:
            return start * (1.0 - part) + end * part, end - start
        first, last = self._tangents[before], self._tangents[after]
        rows = (np.array([[first, start, first]]), np.array([[last, end, last]]))
        place = spline(*rows, np.array([part]), np.array([span]))[0]
        # The derivative of the spline, over the span.
        speed = (6.0 * part * (part - 1.0) / span) * (start - end)
        speed = speed + (3.0 * part * part - 4.0 * part + 1.0) * first
        return place, speed + (3.0 * part * part - 2.0 * part) * last


def facing(direction: np.ndarray, forward: Forward, backwards: bool = False) -> np.ndarray | None:
    """Return the rotation that turns an axis of a node in a direction, with +Y up; None if none.

    Parameters
    ----------
    direction : (3,) float64
    forward : {"+X", "-X", "+Z", "-Z"}
        The axis.
    backwards : bool
        Whether the direction counts the other way.
    """
    size = float(linalg.length(direction))
    if not 0.0 < size < math.inf:
        return None
    unit = np.asarray(direction, np.float64) / (-size if backwards else size)
    if abs(float(unit[1])) > _STEEPEST:
        return None
    pose = linalg.look_at((0.0, 0.0, 0.0), unit, (0.0, 1.0, 0.0))  # turns -Z in the direction
    sign = 1.0 if forward[0] == "-" else -1.0
    right, back = sign * pose[:3, 0], sign * pose[:3, 2]
    pose[:3, 0], pose[:3, 2] = (right, back) if forward[1] == "Z" else (back, -right)
    return linalg.matrix_to_quaternion(pose)


def _checked_points(points: ArrayLike) -> np.ndarray:
    array = floats(points, "points")
    if array.ndim != 2 or array.shape[1:] != (3,) or len(array) < 2:
        raise InvalidArgumentError("points must have shape (K, 3) with at least 2 rows")
    if not np.isfinite(array).all():
        raise InvalidArgumentError("points must be finite")
    if (array == array[0]).all():
        raise InvalidArgumentError("points must not all be the same")
    return frozen(array)


def _knots(points: np.ndarray, closes: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the distinct points in turn, and the share of the way at which each is reached."""
    if closes:
        points = np.concatenate([points, points[:1]])
    moved = np.append(True, (points[1:] != points[:-1]).any(axis=1))
    knots = points[moved]
    with np.errstate(over="ignore", invalid="ignore"):
        lengths = linalg.length(knots[1:] - knots[:-1])
        reached = np.append(0.0, np.cumsum(lengths))
        shares = reached / reached[-1]
    if not (np.diff(shares) > 0.0).all():
        raise InvalidArgumentError("points must be neither too far from one another nor too near")
    return knots, shares


def _tangents(knots: np.ndarray, times: np.ndarray, smooth: bool, closes: bool) -> np.ndarray:
    """Return the velocity at each knot, per whole way; zeros if the line has corners."""
    tangents = np.zeros_like(knots)
    if not smooth:
        return tangents
    tangents[1:-1] = (knots[2:] - knots[:-2]) / (times[2:] - times[:-2])[:, np.newaxis]
    if closes:
        span = times[1] + (1.0 - times[-2])
        tangents[0] = tangents[-1] = (knots[1] - knots[-2]) / span
    else:
        tangents[0] = (knots[1] - knots[0]) / (times[1] - times[0])
        tangents[-1] = (knots[-1] - knots[-2]) / (times[-1] - times[-2])
    return tangents
