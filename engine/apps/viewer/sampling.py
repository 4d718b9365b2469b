"""Chooses the samples per pixel of the next frame: few in motion if necessary, more at rest.

In: drawing times of frames. Out: a number of samples. Motion keeps `MOTION_FPS` frames a second if
one sample per pixel allows it; at rest the frame is redrawn with `AT_REST`.
"""

from __future__ import annotations

import math
import time
from collections import deque

AT_REST = 4
MOTION_FPS = 30.0
#: The scene is at rest if nothing was drawn for this time.
REST_SECONDS = 0.15
#: Samples increase only if they would surely be in time.
SURE = 0.75
#: Frames that are judged; the shortest counts, as others were disturbed.
JUDGED = 3
#: Time of `AT_REST` samples relative to one, until it is measured.
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
        """Forget measured times: a new scene's first frame tells nothing."""
        self._seconds = {count: deque(maxlen=JUDGED) for count in (1, AT_REST)}
        self._ratio = USUAL_RATIO
        self._in_motion = AT_REST
        self._last: tuple[int, float] | None = None
        self._drawn_at = math.inf

    def add(self, samples: int, seconds: float) -> None:
        """Record the drawing time of a frame with a number of samples."""
        self._drawn_at = time.monotonic()
        if samples in self._seconds:
            if self._last is not None:
                self._seconds[samples].append(seconds)
                self._compare(samples, seconds)
            self._last = samples, seconds

    def _compare(self, samples: int, seconds: float) -> None:
        """Update the cost of more samples from two consecutive frames."""
        before, others = self._last
        if before != samples:
            many, one = (seconds, others) if samples == AT_REST else (others, seconds)
            self._ratio = max(1.0, many / max(one, 1e-6))

    def in_motion(self) -> int:
        """Return the samples of a frame in motion."""
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
        """Return the samples of a frame at rest."""
        return self.fixed or AT_REST

    def until_rest(self) -> float:
        """Return the seconds until the last frame should be refined; infinity if never."""
        if self._last is None or self.fixed is not None or self._last[0] == AT_REST:
            return math.inf
        return max(0.0, self._drawn_at + REST_SECONDS - time.monotonic())
