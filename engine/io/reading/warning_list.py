"""The warnings that a reader gathers: one line each, with the place they speak of."""

from __future__ import annotations

from ...errors import located

_MAX = 30


class WarningList:
    """Warnings about one file; a flood of them is cut off and counted.

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
        """Note a warning about a line of the file, or of another file that it names."""
        if len(self._messages) >= _MAX:
            self._left_out += 1
            return
        self._messages.append(located(message, path or self.path, line))

    def add_once(self, message: str) -> None:
        """Note a warning about the file, unless it was noted before."""
        if message not in self._once:
            self._once.add(message)
            self.add(message)

    def messages(self) -> list[str]:
        """Return the warnings, with a last one that tells how many more there were."""
        if not self._left_out:
            return list(self._messages)
        return [*self._messages, f"{self.path}: and {self._left_out} more warnings"]
