"""Clips: how the nodes of a scene change over time.

In: keys (time and value) for parts of nodes. Out: the same, checked and read-only. Clips also hold
channels of other properties (`properties.py`).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NoReturn, SupportsIndex, get_args

import numpy as np
from numpy.typing import ArrayLike

from ...base.validation import Closed, choose, text
from ...choices import Interpolation, MotionPath
from ...errors import InvalidArgumentError
from ..scene.nodes import Node
from .keys import INTERPOLATIONS, Keyed, check_times, frozen_or_copied
from .properties import PropertyChannel

PATHS = get_args(MotionPath)
_WIDTHS = {"translation": 3, "rotation": 4, "scale": 3}


class Channel(Keyed):
    """Keys of one part of one node; immutable.

    Parameters
    ----------
    node : Node
    path : {"translation", "rotation", "scale", "weights"}
        The part of the node; weights are its ``morph_weights``.
    times : (K,) float
        Seconds, increasing. The value is constant before the first and after the last key.
    values : (K, N) float, or (K, 3, N) for splines
        N is 3, 4 (quaternions x, y, z, w) or the number of morph targets. A spline has the
        in-tangent, the value and the out-tangent of each key, per second.
    interpolation : {"linear", "step", "cubicspline"}
        Rotations turn the shorter way round, at a constant rate.

    Raises
    ------
    InvalidArgumentError
        A shape is wrong, times do not increase, a number is not finite, or a rotation is all 0.
    """

    def __init__(
        self,
        node: Node,
        path: MotionPath,
        times: ArrayLike,
        values: ArrayLike,
        interpolation: Interpolation = "linear",
    ) -> None:
        if not isinstance(node, Node):
            raise InvalidArgumentError(f"node must be a Node, not {type(node).__name__}")
        self._node = node
        self._path = choose(path, PATHS, "path")
        self._interpolation = choose(interpolation, INTERPOLATIONS, "interpolation")
        self._times = check_times(times)
        self._values = _check_values(values, self._path, self._interpolation, len(self._times))

    @property
    def node(self) -> Node:
        return self._node

    @property
    def path(self) -> MotionPath:
        return self._path

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("a Channel belongs to the Scene of its node: it cannot be copied")

    def __repr__(self) -> str:
        return f"Channel({self._node!r}, {self._path!r}, {len(self._times)} keys)"


class AnimationClip(Closed):
    """Channels that play together.

    Parameters
    ----------
    channels : iterable of Channel and PropertyChannel
        Channels of one scene's nodes, and of their materials, cameras and lights.
    name : str

    Raises
    ------
    InvalidArgumentError
        An item is not a channel.
    """

    def __init__(self, channels: Iterable[Channel | PropertyChannel], name: str = "") -> None:
        if not isinstance(channels, Iterable):
            raise InvalidArgumentError(f"channels must be several Channel, not {channels!r}")
        self._channels = tuple(channels)
        for channel in self._channels:
            if not isinstance(channel, (Channel, PropertyChannel)):
                kind = type(channel).__name__
                raise InvalidArgumentError(f"channels must be several Channel, not {kind}")
        self._name = text(name, "name")
        self._duration = max((float(c.times[-1]) for c in self._channels), default=0.0)

    @property
    def channels(self) -> tuple[Channel | PropertyChannel, ...]:
        return self._channels

    @property
    def name(self) -> str:
        return self._name

    @property
    def duration(self) -> float:
        """Seconds from 0 to the last key of all channels."""
        return max(self._duration, 0.0)

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError("an AnimationClip belongs to the Scene of its nodes: it cannot be copied")

    def __repr__(self) -> str:
        return f"AnimationClip({len(self._channels)} channels, {self.duration:g} s, {self._name!r})"


def check_clips(value: Mapping[str, AnimationClip]) -> dict[str, AnimationClip]:
    """Check clips by their names."""
    if not isinstance(value, Mapping):
        raise InvalidArgumentError(f"animations must be a dict of names to clips, not {value!r}")
    for name, clip in value.items():
        if not isinstance(name, str) or not isinstance(clip, AnimationClip):
            raise InvalidArgumentError(
                f"animations must be AnimationClips by their names, not {clip!r} by {name!r}"
            )
    return dict(value)


def _check_values(value: ArrayLike, path: str, interpolation: str, count: int) -> np.ndarray:
    values = frozen_or_copied(value, "values")
    middle = (3,) if interpolation == "cubicspline" else ()
    width = _WIDTHS.get(path, values.shape[-1] if values.ndim else 0)
    if values.shape != (count, *middle, width):
        shape = ", ".join(map(str, (count, *middle, _WIDTHS.get(path, "N"))))
        raise InvalidArgumentError(f"values of {path} must be ({shape}), not {values.shape}")
    if not np.isfinite(values).all():
        raise InvalidArgumentError("values must be finite")
    if path == "rotation":
        keys = values[:, 1] if middle else values
        with np.errstate(over="ignore"):
            squares = (keys * keys).sum(axis=1)
        if not ((squares > 0.0) & (squares < np.inf)).all():
            raise InvalidArgumentError("rotations must not be zero quaternions, nor overflow")
    return values
