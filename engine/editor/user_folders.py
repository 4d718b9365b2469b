"""Where an editor keeps what outlives it: folders of the user's, by the XDG Base Directory
Specification (freedesktop.org, 2021).
"""

from __future__ import annotations

import os
from pathlib import Path


def state_folder() -> Path:
    """Return the folder for what an editor remembers; it need not be there yet."""
    return _folder("XDG_STATE_HOME", ".local/state")


def cache_folder() -> Path:
    """Return the folder for what can be made again, and for what was not saved."""
    return _folder("XDG_CACHE_HOME", ".cache")


def _folder(variable: str, usual: str) -> Path:
    given = os.environ.get(variable, "")
    # The specification has relative paths ignored.
    base = Path(given) if os.path.isabs(given) else Path(os.path.expanduser("~")) / usual
    return base / "engine3d"
