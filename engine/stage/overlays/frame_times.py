"""Recent frame times, for the title and the statistics.

In: for each frame, its drawing time and the time until it was shown. Out: means over the last
second. Frames from before a pause don't count.
"""

from __future__ import annotations

import time
from collections import deque

from ...base.language import translated

#: How long frames count, and how many at most.
RECENT_SECONDS = 1.0
RECENT_FRAMES = 120


class FrameRate:
    """The number of pictures shown in the last second."""

    def __init__(self) -> None:
        self._shown: deque[float] = deque()

    def add(self) -> None:
        """Count a picture shown now."""
        self._shown.append(time.monotonic())
        self._forget()

    def _forget(self) -> None:
        oldest = time.monotonic() - RECENT_SECONDS
        while self._shown and self._shown[0] < oldest:
            self._shown.popleft()

    @property
    def value(self) -> float:
        """Pictures per second; 0 if fewer than two are recent."""
        self._forget()
        if len(self._shown) < 2:
            return 0.0
        return (len(self._shown) - 1) / max(self._shown[-1] - self._shown[0], 1e-9)


class FrameTimes:
    """Durations of the recent frames.

    `seconds` counts the wait for the screen's refresh, `drawing_seconds` doesn't, and
    `core_seconds` only what the C core does of the drawing.
    """

    def __init__(self) -> None:
        self._frames: deque[tuple[float, float, float, float]] = deque(maxlen=RECENT_FRAMES)

    def add(self, drawing: float, shown: float, core: float = 0.0) -> None:
        """Add a frame that took so many seconds to draw, until it was shown, and in the core."""
        now = time.monotonic()
        while self._frames and self._frames[0][0] < now - RECENT_SECONDS:
            self._frames.popleft()
        self._frames.append((now, drawing, shown, core))

    def last(self) -> FrameTimes:
        """Return the times of the last frame alone."""
        times = FrameTimes()
        times._frames.extend(list(self._frames)[-1:])
        return times

    @property
    def count(self) -> int:
        """Number of recent frames."""
        return len(self._frames)

    @property
    def seconds(self) -> float:
        """Mean time to draw and show a recent frame; 0 if there is none."""
        return self._mean(2)

    @property
    def rate(self) -> float:
        """Frames per second; 0 if fewer than two are recent, or none took any time."""
        return 1.0 / self.seconds if self.count > 1 and self.seconds > 0.0 else 0.0

    @property
    def drawing_seconds(self) -> float:
        """Mean time to draw a recent frame; 0 if there is none."""
        return self._mean(1)

    @property
    def core_seconds(self) -> float:
        """Mean time of a recent frame in the core; 0 if there is none."""
        return self._mean(3)

    def _mean(self, column: int) -> float:
        frames = self._frames
        return sum(frame[column] for frame in frames) / len(frames) if frames else 0.0

    def text(self, idle: bool) -> str:
        """Return the text for a title: for the recent frames, or the last one if none is recent."""
        if not self._frames:
            return ""
        if idle:
            return translated("idle, last frame {ms:.1f} ms", ms=self._frames[-1][1] * 1000)
        rate = 1.0 / max(self.seconds, 1e-6)
        return translated(
            "{ms:.1f} ms to draw, {rate:.0f} fps", ms=self.drawing_seconds * 1000, rate=rate
        )
