"""The editor's log: messages, warnings, errors and actions.

In: lines of text, also from other threads. Out: entries, oldest first, and those that match a
filter.
"""

from __future__ import annotations

import contextlib
import time
import warnings
from collections import deque
from collections.abc import Collection, Iterator
from typing import NamedTuple

from ...errors import printable

#: Kinds of entries.
LEVELS = ("action", "message", "warning", "error", "input", "output")
_MOST = 10_000


class Entry(NamedTuple):
    """A line of the log.

    Attributes
    ----------
    number : int
        Counts up from 0.
    time : float
        Seconds since the epoch.
    level : str
        One of `LEVELS`.
    text : str
        One line that steers no terminal.
    """

    number: int
    time: float
    level: str
    text: str


class Console:
    """A log; beyond 10,000 entries the oldest are dropped.

    Attributes
    ----------
    version : int
        Grows with every entry.
    """

    def __init__(self) -> None:
        self.version = 0
        self._entries: deque[Entry] = deque(maxlen=_MOST)
        self._filtered: tuple | None = None

    @property
    def entries(self) -> tuple[Entry, ...]:
        """All entries, oldest first."""
        return tuple(self._entries)

    def write(self, level: str, text: str) -> None:
        """Add entries, one for each line of the text."""
        for line in str(text).splitlines() or [""]:
            shown = printable(line.expandtabs())
            self._entries.append(Entry(self.version, time.time(), level, shown))
            self.version += 1

    def write_once(self, level: str, text: str) -> None:
        """Add an entry, unless it is the same as the last one."""
        if not self._entries or self._entries[-1][2:] != (level, printable(text)):
            self.write(level, text)

    def clear(self) -> None:
        """Forget all entries."""
        self._entries.clear()
        self.version += 1

    def filtered(self, levels: Collection[str] = LEVELS, search: str = "") -> tuple[Entry, ...]:
        """Return the entries of some levels that contain a text, ignoring case; cached."""
        key = self.version, frozenset(levels), search.casefold()
        if self._filtered is None or self._filtered[0] != key:
            found = tuple(
                entry
                for entry in self.entries
                if entry.level in key[1] and key[2] in entry.text.casefold()
            )
            self._filtered = key, found
        return self._filtered[1]

    @contextlib.contextmanager
    def warnings_noted(self) -> Iterator[None]:
        """Turn warnings within the block into entries."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                yield
            finally:
                for warning in caught:
                    self.write("warning", str(warning.message))
