"""A progress bar for loading, on a terminal, if it takes longer than a second.

In: fractions from ``load_mesh(..., progress=)``. Out: a line on standard error, removed at the end.
Without a terminal, nothing.
"""

from __future__ import annotations

import time

from . import quietness

_PATIENCE = 1.0


class LoadingBar:
    """A context manager; its value is called with fractions from 0 to 1."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._bar = None
        self._task = None

    def __enter__(self) -> LoadingBar:
        return self

    def __call__(self, fraction: float) -> None:
        """Show a fraction, once a second has passed."""
        if self._bar is None:
            if time.monotonic() - self._start < _PATIENCE or not quietness.shows_progress():
                return
            self._begin()
        self._bar.update(self._task, completed=fraction)

    def __exit__(self, *error) -> None:
        if self._bar is not None:
            self._bar.stop()

    def _begin(self) -> None:
        from rich.console import Console
        from rich.progress import Progress

        self._bar = Progress(console=Console(stderr=True), transient=True)
        self._task = self._bar.add_task("loading", total=1.0)
        self._bar.start()
