"""The title of the viewer's window: the model, and its frame times."""

from __future__ import annotations

import time
from collections.abc import Callable

from ...errors import printable

#: Seconds between titles of the same model.
SECONDS = 0.5


class TitleBar:
    """Writes a window's title periodically, and at once for a new model."""

    def __init__(self, window) -> None:
        self._window = window
        self._name = ""
        self._due = 0.0

    def write(self, name: str, told: Callable[[], str], *, at_once: bool) -> None:
        """Write a title if one is due.

        Parameters
        ----------
        name : str
            Of what is shown.
        told : callable
            Returns what frames take.
        at_once : bool
            Whether it is time in any case.
        """
        now = time.monotonic()
        if now < self._due and name == self._name and not at_once:
            return
        self._name, self._due = name, now + SECONDS
        title = printable(" - ".join(filter(None, (name, "engine3d", told()))))
        if title != self._window.title:
            self._window.title = title
