"""What the last frames took, stage by stage, as a panel plots it.

In: each frame that was drawn, and how long it took until it was shown. Out: times of the last
frames, the oldest first, and the counts of the last one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..rendering.frame import Frame

FRAMES = 240


class FrameHistory:
    """The last 240 frames.

    Attributes
    ----------
    stats : dict
        ``frame.stats`` of the last one.
    """

    def __init__(self) -> None:
        self.stats: dict[str, Any] = {}
        self._times: dict[str, NDArray[np.float32]] = {}
        self._count = 0

    def add(self, frame: Frame, seconds: float) -> None:
        """Note a frame, and how long it took in all."""
        self.stats = frame.stats
        stages = {
            name.removeprefix("ms_"): value
            for name, value in self.stats.items()
            if name.startswith("ms_")
        }
        row = self._count % FRAMES
        for name, value in {"frame": 1e3 * seconds, **stages}.items():
            times = self._times.setdefault(name, np.zeros(FRAMES, np.float32))
            times[row] = value
        self._count += 1

    def times(self) -> dict[str, NDArray[np.float32]]:
        """Return milliseconds of each stage, and of whole frames as "frame": (N,) float32 each."""
        if self._count <= FRAMES:
            return {name: times[: self._count].copy() for name, times in self._times.items()}
        first = self._count % FRAMES
        return {name: np.roll(times, -first) for name, times in self._times.items()}

    def mean(self, frames: int = 60) -> dict[str, float]:
        """Return the mean milliseconds of each stage over the last frames; none without any."""
        return {name: float(times[-frames:].mean()) for name, times in self.times().items()}

    @property
    def frames_per_second(self) -> float:
        """What the mean of the last 60 frames comes to; 0 without any."""
        mean = self.mean().get("frame", 0.0)
        return 1e3 / mean if mean > 0 else 0.0
