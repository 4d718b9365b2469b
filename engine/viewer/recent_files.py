"""The files that were opened last, remembered from one run to the next.

They are lines of a file in the user's folder for the state of programs. What cannot be read or
written there is left alone: nothing depends on it.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from pathlib import Path

from ..errors import FileAccessError, FileFormatError
from ..files.atomic_write import atomic_write
from ..files.json_records import read_small

MOST = 12
_LARGEST = 1 << 20  # bytes
NAME = "recent-files"


def state_folder() -> Path:
    """Return the folder, which may not be there yet."""
    if sys.platform == "win32" and os.environ.get("LOCALAPPDATA"):
        return Path(os.environ["LOCALAPPDATA"]) / "engine3d"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "engine3d"
    state = os.environ.get("XDG_STATE_HOME", "")
    root = Path(state) if os.path.isabs(state) else Path.home() / ".local" / "state"
    return root / "engine3d"


def recent_files() -> list[str]:
    """Return the paths of the last files that are still there, the last one first."""
    try:
        text = read_small(state_folder() / NAME, _LARGEST)
    except (RuntimeError, FileAccessError, FileFormatError):
        return []
    paths = [os.fsdecode(line) for line in text.splitlines()]
    return [path for path in paths if os.path.isfile(path)][:MOST]


def remember(paths: Sequence) -> None:
    """Put files at the head of the list."""
    new = [os.path.abspath(os.fsdecode(path)) for path in paths if not hasattr(path, "read")]
    new = [path for path in new if os.path.isfile(path) and "\n" not in path]
    if not new:
        return
    kept = [path for path in recent_files() if path not in new]
    try:
        state_folder().mkdir(parents=True, exist_ok=True)
        with atomic_write(state_folder() / NAME) as file:
            file.write(b"".join(os.fsencode(path) + b"\n" for path in (*new, *kept)[:MOST]))
    except (OSError, RuntimeError, FileAccessError):
        pass
