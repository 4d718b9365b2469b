"""The report of ``--verbose`` on standard error: what was loaded and drawn, in which time."""

from __future__ import annotations

import sys
import time

from ...errors import printable, warn
from ...stage.blank import Reason
from ...stage.overlays.draw_counts import count_line


def warn_of_nothing(view_renderer) -> Reason | None:
    """Say, and return, why no picture has shown anything, if that is so."""
    reason = view_renderer.why_blank()
    if reason is not None:
        warn(f"{view_renderer.viewed.title}: nothing shows: {reason.sentence}")
    return reason


class Report:
    """Prints progress if asked to; times count from when it was made.

    Parameters
    ----------
    verbose : bool
        Whether to print anything.
    """

    def __init__(self, verbose: bool):
        self._verbose = verbose
        self._start = time.perf_counter()
        self._frames = 0

    def line(self, text: str) -> None:
        """Print one line with the seconds since the start."""
        if self._verbose:
            print(
                f"[{time.perf_counter() - self._start:7.3f} s] {printable(text)}", file=sys.stderr
            )

    def loaded(self, viewed) -> None:
        """Say what is shown."""
        details = ", ".join(" ".join(line.split()) for line in viewed.details)
        self.line(f"loaded {viewed.path or viewed.title}" + (f": {details}" if details else ""))

    def frame(self, frame) -> None:
        """Say how much of the scene a frame had to draw, and how long it took."""
        self._frames += 1
        milliseconds = frame.stats["ms_total"]
        self.line(f"frame {self._frames}: {milliseconds:.1f} ms; {count_line(frame.stats)}")

    def drawn(self, view_renderer, frame) -> None:
        """Say what drew a frame, and the frame's statistics."""
        if not self._verbose:
            return
        width, height = view_renderer.size
        self.line(f"drew {width}x{height} with {view_renderer.renderer.backend}")
        for name, value in frame.stats.items():
            print(
                f"            {name:<24} {value:.3f}"
                if isinstance(value, float)
                else f"            {name:<24} {value}",
                file=sys.stderr,
            )
