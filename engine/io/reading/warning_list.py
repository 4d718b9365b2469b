"""Collects the warnings of a reader: one line each, with their places."""

from __future__ import annotations

from ...errors import located

_MAX = 30


class WarningList:
    """Warnings about one file; beyond a limit they are only counted.

    Attributes
    ----------
    path : str
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self._messages: list[str] = []
        self._left_out = 0
        self._once: set[str] = set()

    def add(self, message: str, line: int | None = None, path: str | None = None) -> None:
        """Add a warning about a line of the file, or of another file that it names."""
        if len(self._messages) >= _MAX:
            self._left_out += 1
            return
        self._messages.append(located(message, path or self.path, line))

    def add_once(self, message: str) -> None:
        """Add a warning about the file, unless it exists already."""
        if message not in self._once:
            self._once.add(message)
            self.add(message)

    def messages(self) -> list[str]:
        """Return the warnings, and a last one that counts the omitted ones."""
        if not self._left_out:
            return list(self._messages)
        return [*self._messages, f"{self.path}: and {self._left_out} more warnings"]
