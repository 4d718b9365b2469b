"""Messages at the bottom of the viewer's window: for a moment, or until a problem is over."""

from __future__ import annotations

import math
import time

from ...errors import printable

MESSAGE_SECONDS = 2.5
#: Characters of a message that one reads in a second.
READ_A_SECOND = 15.0


class Messages:
    """A message that passes, and a trouble that stays.

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
        """Show a message for a moment, which is longer for more words."""
        self.said = printable(text)
        self._ends = time.monotonic() + max(MESSAGE_SECONDS, len(text) / READ_A_SECOND)

    def pass_by(self) -> bool:
        """Let a message end whose moment is over; return whether one did."""
        if not self.said or time.monotonic() < self._ends:
            return False
        self.said = ""
        return True

    def remaining(self) -> float:
        """Return in how many seconds the message ends; infinity if there is none."""
        return max(0.0, self._ends - time.monotonic()) if self.said else math.inf

    def lines(self) -> list[str]:
        """Return what is to be seen now."""
        return [line for line in (self.trouble, self.said) if line]
