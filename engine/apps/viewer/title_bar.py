"""The title of the viewer's window: what is shown, and what its frames take."""

from __future__ import annotations

import time
from collections.abc import Callable

from ...errors import printable

#: Seconds between two titles of the same model.
SECONDS = 0.5


class TitleBar:
    """Writes the title of a window now and then, and at once where another model is shown."""

    def __init__(self, window) -> None:
        self._window = window
        self._name = ""
        self._due = 0.0

    def write(self, name: str, told: Callable[[], str], *, at_once: bool) -> None:
        """Write a title if it is time for one.

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
