"""Messages at the bottom of the viewer's window: temporary, or until a problem is solved."""

from __future__ import annotations

import math
import time

from ...errors import printable

MESSAGE_SECONDS = 2.5
#: Characters of a message read per second.
READ_A_SECOND = 15.0


class Messages:
    """A temporary message, and a lasting problem.

    Attributes
    ----------
    said : str
        What is said for the moment; empty if nothing is.
    trouble : str
        What is wrong until it is mended; empty if nothing is.
    """

    def __init__(self) -> None:
        self.said = ""
        self.trouble = ""
        self._ends = 0.0

    def say(self, text: str) -> None:
        """Show a message for a time that depends on its length."""
        self.said = printable(text)
        self._ends = time.monotonic() + max(MESSAGE_SECONDS, len(text) / READ_A_SECOND)

    def pass_by(self) -> bool:
        """End an expired message; return whether one ended."""
        if not self.said or time.monotonic() < self._ends:
            return False
        self.said = ""
        return True

    def remaining(self) -> float:
        """Return the seconds until the message ends; infinity if there is none."""
        return max(0.0, self._ends - time.monotonic()) if self.said else math.inf

    def lines(self) -> list[str]:
        """Return the messages to show now."""
        return [line for line in (self.trouble, self.said) if line]
