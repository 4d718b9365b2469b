"""How many samples per pixel the next frame takes: few in motion, if it must be, more at rest.

In: how long frames took to draw. Out: a number of samples. What moves keeps up `MOTION_FPS` frames
a second where one sample per pixel allows it; what rests is drawn again with `AT_REST`.
"""

from __future__ import annotations

import math
import time
from collections import deque

AT_REST = 4
MOTION_FPS = 30.0
#: Nothing moves any more when nothing has been drawn for so long.
REST_SECONDS = 0.15
#: More samples are taken again when they would surely be in time.
SURE = 0.75
#: Frames by which the time is judged; the shortest counts, as others were disturbed.
JUDGED = 3
#: The time of `AT_REST` samples over that of one, until it is measured.
USUAL_RATIO = 3.0


class Sampling:
    """Chooses the number of samples.

    Parameters
    ----------
    fixed : int, optional
        Always this many.
    """

    def __init__(self, fixed: int | None = None):
        self.fixed = fixed
        self.start_anew()

    def start_anew(self) -> None:
        """Forget what frames took: another scene is drawn, whose first frame tells nothing."""
        self._seconds = {count: deque(maxlen=JUDGED) for count in (1, AT_REST)}
        self._ratio = USUAL_RATIO
        self._in_motion = AT_REST
        self._last: tuple[int, float] | None = None
        self._drawn_at = math.inf

    def add(self, samples: int, seconds: float) -> None:
        """Take in that a frame with so many samples took so long to draw."""
        self._drawn_at = time.monotonic()
        if samples in self._seconds:
            if self._last is not None:
                self._seconds[samples].append(seconds)
                self._compare(samples, seconds)
            self._last = samples, seconds

    def _compare(self, samples: int, seconds: float) -> None:
        """Learn from a frame and the one before what more samples cost."""
        before, others = self._last
        if before != samples:
            many, one = (seconds, others) if samples == AT_REST else (others, seconds)
            self._ratio = max(1.0, many / max(one, 1e-6))

    def in_motion(self) -> int:
        """Return how many samples a frame takes while something moves."""
        if self.fixed is not None:
            return self.fixed
        budget = 1.0 / MOTION_FPS
        recent = self._seconds[self._in_motion]
        if recent and self._in_motion == AT_REST and min(recent) > budget:
            self._in_motion = 1
        elif recent and self._in_motion == 1 and min(recent) * self._ratio < SURE * budget:
            self._in_motion = AT_REST
            self._seconds[AT_REST].clear()
        return self._in_motion

    def at_rest(self) -> int:
        """Return how many samples a frame takes while nothing moves."""
        return self.fixed or AT_REST

    def until_rest(self) -> float:
        """Return in how many seconds the last frame is to be drawn better; infinity if it isn't."""
        if self._last is None or self.fixed is not None or self._last[0] == AT_REST:
            return math.inf
        return max(0.0, self._drawn_at + REST_SECONDS - time.monotonic())
