"""``--quiet``: print only errors, and a command's actual result.

The switch is global for the process, since warnings and progress come from everywhere.
"""

from __future__ import annotations

import sys

from .said import say

_quiet = False


def set_quiet(quiet: bool) -> None:
    """Switch quietness on or off."""
    global _quiet
    _quiet = quiet


def is_quiet() -> bool:
    """Return whether warnings and remarks are suppressed."""
    return _quiet


def remark(text: str) -> None:
    """Print a line on standard error, unless quiet."""
    if not _quiet:
        say(text)


def shows_progress() -> bool:
    """Return whether progress bars may be shown: on a terminal, unless quiet."""
    return not _quiet and sys.stderr.isatty()
