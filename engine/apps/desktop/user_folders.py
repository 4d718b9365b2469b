"""The user's folders for lasting data of programs, on each system.

Windows and macOS have their own conventions; others follow the XDG Base Directory Specification
(freedesktop.org, 2021).
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Literal, NamedTuple

#: User settings, remembered state, and data that can be recreated or was not saved.
Kind = Literal["config", "state", "cache"]


class _Place(NamedTuple):
    """Environment variables for a folder, and its default."""

    xdg: str
    usual: str  # below the home folder
    windows: str
    macos: str  # below the home folder's Library


_PLACES: dict[Kind, _Place] = {
    "config": _Place("XDG_CONFIG_HOME", ".config", "APPDATA", "Application Support"),
    "state": _Place("XDG_STATE_HOME", ".local/state", "LOCALAPPDATA", "Application Support"),
    "cache": _Place("XDG_CACHE_HOME", ".cache", "LOCALAPPDATA", "Caches"),
}


def user_path(kind: Kind, name: str) -> Path:
    """Return the path of a user's file or folder, which need not exist yet.

    On Windows and macOS, a file that exists only in the XDG place stays there: earlier editors used
    it on all systems.
    """
    path, other = _of_system(_PLACES[kind]) / name, _of_xdg(_PLACES[kind]) / name
    return other if os.path.lexists(other) and not os.path.lexists(path) else path


def _of_system(place: _Place) -> Path:
    if sys.platform == "win32" and os.environ.get(place.windows):
        return Path(os.environ[place.windows]) / "engine3d"
    if sys.platform == "darwin":
        return _home() / "Library" / place.macos / "engine3d"
    return _of_xdg(place)


def _of_xdg(place: _Place) -> Path:
    given = os.environ.get(place.xdg, "")
    # The specification says to ignore relative paths.
    root = Path(given) if os.path.isabs(given) else _home() / place.usual
    return root / "engine3d"


def _home() -> Path:
    return Path(os.path.expanduser("~"))
