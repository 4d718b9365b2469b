"""Samples the keys of many similar channels together.

In: channels with the same path, interpolation and width; a time for each. Out: a row of values for
each. A value depends on the time alone; the position of the last sample only speeds up the next
search.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .clips import Channel
from .interpolation import spline, straight, turns, unit
from .properties import PropertyChannel


class KeyframeTable:
    """Channels of one kind.

    Attributes
    ----------
    path : str
    channels : tuple of Channel or PropertyChannel
    """

    def __init__(self, channels: Sequence[Channel | PropertyChannel]) -> None:
        self.channels = tuple(channels)
        first = channels[0]
        self.path, self._interpolation = first.path, first.interpolation
        # Channels with the same keys share them.
        keys = {(id(c.times), id(c.values)): c for c in channels}
        counts = np.array([len(channel.times) for channel in keys.values()])
        ends = np.cumsum(counts)
        self._times = np.concatenate([channel.times for channel in keys.values()])
        values = np.concatenate([channel.values for channel in keys.values()])
        row_of = {key: row for row, key in enumerate(keys)}
        rows = np.array([row_of[id(channel.times), id(channel.values)] for channel in channels])
        self._first, self._last = (ends - counts)[rows], (ends - 1)[rows]
        self._at = self._first.copy()
        self._turns = None
        if first.path == "rotation" and first.interpolation == "linear":
            after = np.minimum(np.arange(len(values)) + 1, np.repeat(ends - 1, counts))
            self._turns = turns(values, values[after])
        self._values = values

    def sample(self, times: np.ndarray) -> np.ndarray:
        """Return the values at times (C,), (C, N) float64."""
        at = self._find(times)
        after = np.minimum(at + 1, self._last)
        if self._interpolation == "step":
            return self._values[at]
        spans = self._times[after] - self._times[at]
        with np.errstate(over="ignore"):  # keys may be very close in time
            shares = (times - self._times[at]) / np.where(after > at, spans, 1.0)
        shares = np.where(after > at, np.minimum(np.maximum(shares, 0.0), 1.0), 0.0)
        if self._turns is not None:
            return self._turns.rows(at).at(shares)
        if self._interpolation == "linear":
            return straight(self._values[at], self._values[after], shares)
        value = spline(self._values[at], self._values[after], shares, spans)
        return unit(value) if self.path == "rotation" else value

    def _find(self, times: np.ndarray) -> np.ndarray:
        """Return the last key not after each time, or the first key."""
        at = self._at
        right = (self._times[at] <= times) | (at == self._first)
        right &= (at == self._last) | (times < self._times[np.minimum(at + 1, self._last)])
        wrong = np.flatnonzero(~right)
        if len(wrong):
            at = at.copy()  # another thread may be reading it
            at[wrong] = self._search(times[wrong], self._first[wrong], self._last[wrong])
            self._at = at
        return at

    def _search(self, times: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Search all tables at once by bisection."""
        while (low < high).any():
            middle = (low + high + 1) >> 1
            early = self._times[middle] <= times
            low = np.where(early & (low < high), middle, low)
            high = np.where(early, high, np.maximum(middle - 1, low))
        return low


def tables_of(channels: Sequence[Channel | PropertyChannel]) -> list[KeyframeTable]:
    """Return the channels sorted into tables of one kind each."""
    kinds: dict[tuple[str, str, int], list[Channel | PropertyChannel]] = {}
    for channel in channels:
        kind = channel.path, channel.interpolation, channel.values.shape[-1]
        kinds.setdefault(kind, []).append(channel)
    return [KeyframeTable(group) for group in kinds.values()]
