"""Animation layers: clips that play together, and the cross-fade between layers.

In: clips with the rows they animate, and a time. Out: values of all rows.
"""

from __future__ import annotations

from typing import cast

import numpy as np

from ...choices import Loop
from .animated_parts import PROPERTIES, AnimatedParts, Values, row_of
from .clips import AnimationClip
from .interpolation import straight, turns
from .keyframes import tables_of
from .properties import PropertyChannel


class Layer:
    """Clips that play together.

    Attributes
    ----------
    clips : tuple of AnimationClip
    masks : dict of str to (rows,) bool
        The rows that the clips animate, by path.
    fade : float
        Seconds of the cross-fade from the layers before.
    since : float
        Seconds it had played when the newest layer began.
    """

    def __init__(
        self,
        clips: tuple[AnimationClip, ...],
        offsets: np.ndarray,
        parts: AnimatedParts,
        fade: float,
    ) -> None:
        self.clips, self.fade, self.since = clips, fade, 0.0
        self._parts = parts
        last = {row_of(c): (k, c) for k, clip in enumerate(clips) for c in clip.channels}
        number_of = {id(channel): number for number, channel in last.values()}
        self._tables = tables_of([channel for _, channel in last.values()])
        self._rows, self._durations, self._offsets, self._paths = [], [], [], []
        self.masks = parts.none()
        durations = np.array([clip.duration for clip in clips])
        for table in self._tables:
            path = row_of(table.channels[0])[0]
            rows = np.array([parts.rows[path][row_of(c)[1]] for c in table.channels])
            numbers = [number_of[id(channel)] for channel in table.channels]
            self._rows.append(rows)
            self._durations.append(durations[numbers])
            self._offsets.append(offsets[numbers])
            self._paths.append(path)
            self.masks[path][rows] = True

    def values(self, time: float, loop: Loop) -> Values:
        """Return the values of all rows, at a time counted from the newest layer's start."""
        values = {path: rest.copy() for path, rest in self._parts.rest.items()}
        time = self.since + time
        for k, table in enumerate(self._tables):
            moments = looped(time + self._offsets[k], self._durations[k], loop)
            sampled = table.sample(moments)
            path, rows = self._paths[k], self._rows[k]
            if path == "weights":
                for row, weights in zip(rows.tolist(), sampled, strict=True):
                    values["weights"][row] = weights
            elif path == PROPERTIES:
                channels = cast("tuple[PropertyChannel, ...]", table.channels)
                for channel, row, numbers in zip(channels, rows.tolist(), sampled, strict=True):
                    values[PROPERTIES][row] = channel._within(numbers)
            else:
                values[path][rows] = sampled
        return values

    def share(self, time: float) -> float:
        """Return the layer's weight in the cross-fade from earlier ones, 0 … 1."""
        played = abs(self.since + time)
        return 1.0 if played >= self.fade else played / self.fade


def looped(times: np.ndarray, durations: np.ndarray, loop: Loop) -> np.ndarray:
    """Return the times of clips (C,) looped into their durations."""
    if loop == "once":
        return np.minimum(np.maximum(times, 0.0), durations)
    spans = np.where(durations > 0.0, durations, 1.0)
    with np.errstate(over="ignore"):
        laps = times / spans
    laps = np.where(np.isfinite(laps), laps, 0.0)
    if loop == "repeat":
        return np.where(durations > 0.0, (laps - np.floor(laps)) * spans, 0.0)
    half = laps * 0.5
    there = 2.0 * (half - np.floor(half))  # 0 … 2
    return np.where(durations > 0.0, np.where(there > 1.0, 2.0 - there, there) * spans, 0.0)


def mixed(layers: list[Layer], time: float, loop: Loop) -> Values:
    """Return the values of cross-fading layers, the newest last."""
    shares = [layer.share(time) for layer in layers]
    first = max((k for k, share in enumerate(shares) if share >= 1.0), default=0)
    values = layers[first].values(time, loop)
    for layer, share in zip(layers[first + 1 :], shares[first + 1 :], strict=True):
        values = _between(values, layer.values(time, loop), share)
    return values


def _between(some: Values, others: Values, share: float) -> Values:
    shares = {path: np.full(len(some[path]), share) for path in ("translation", "scale")}
    values: Values = {path: straight(some[path], others[path], s) for path, s in shares.items()}
    ways = turns(some["rotation"], others["rotation"])
    values["rotation"] = ways.at(np.full(len(some["rotation"]), share))
    for path in ("weights", PROPERTIES):
        pairs = zip(some[path], others[path], strict=True)
        values[path] = [a * (1.0 - share) + b * share for a, b in pairs]
    return values
