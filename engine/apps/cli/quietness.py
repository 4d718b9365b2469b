"""``--quiet``: nothing is printed but errors, and what a command is there to print.

One switch for the process, since warnings and progress come from everywhere.
"""

from __future__ import annotations

import sys

from .said import say

_quiet = False


def set_quiet(quiet: bool) -> None:
    """Be quiet from now on, or not."""
    global _quiet
    _quiet = quiet


def is_quiet() -> bool:
    """Return whether warnings and remarks are left out."""
    return _quiet


def remark(text: str) -> None:
    """Print a line on standard error, unless quiet."""
    if not _quiet:
        say(text)


def shows_progress() -> bool:
    """Return whether bars may show how far work is: on a terminal, unless quiet."""
    return not _quiet and sys.stderr.isatty()
