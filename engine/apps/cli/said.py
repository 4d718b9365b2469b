"""Messages on standard error.

In: text that may contain external names. Out: one line each, which cannot control a terminal.
"""

from __future__ import annotations

import sys

from ...errors import printable


def say(text: str) -> None:
    """Print a line that begins with the program's name."""
    print(f"engine3d: {printable(' '.join(text.split()))}", file=sys.stderr)
