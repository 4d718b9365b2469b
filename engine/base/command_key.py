"""The key that is held for commands: Ctrl; on macOS Cmd as well, which texts name there.

In: the system, and texts that name Ctrl. Out: whether Cmd counts; the texts with the name of the
key. Ctrl keeps counting on macOS: the system itself takes some keys with Cmd.
"""

from __future__ import annotations

import re
import sys

# Cmd+M minimises a window of macOS.
_CONTROL = re.compile(r"\bCtrl\b(?!\+M\b)")


def has_cmd() -> bool:
    """Return whether keyboards of this system have Cmd, which commands are typed with."""
    return sys.platform == "darwin"


def with_command_key(text: str) -> str:
    """Return a text, such as ``"Ctrl+Shift+Z"``, with the name of the key on this system."""
    return _CONTROL.sub("Cmd", text) if has_cmd() else text
