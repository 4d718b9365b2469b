"""The ``--verbose`` report on standard error: loading, drawing and times."""

from __future__ import annotations

import sys
import time

from ...errors import printable, warn
from ...stage.blank import Reason
from ...stage.overlays.draw_counts import count_line


def warn_of_nothing(view_renderer) -> Reason | None:
    """Print, and return, why no picture so far has shown anything; None if one has."""
    reason = view_renderer.why_blank()
    if reason is not None:
        warn(f"{view_renderer.viewed.title}: nothing shows: {reason.sentence}")
    return reason


class Report:
    """Prints progress on request; times count from its creation.

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
        """Print the contents of the viewed scene."""
        details = ", ".join(" ".join(line.split()) for line in viewed.details)
        self.line(f"loaded {viewed.path or viewed.title}" + (f": {details}" if details else ""))

    def frame(self, frame) -> None:
        """Print the culling counts of a frame, and its time."""
        self._frames += 1
        milliseconds = frame.stats["ms_total"]
        self.line(f"frame {self._frames}: {milliseconds:.1f} ms; {count_line(frame.stats)}")

    def drawn(self, view_renderer, frame) -> None:
        """Print the backend of a frame, and its statistics."""
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
