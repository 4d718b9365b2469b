"""Recovery copies: unsaved work left behind by a crashed editor."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import NamedTuple

from ...base.files import json_records


def root_of(system: str, environment: Mapping[str, str]) -> str:
    """Return what paths in a copy are relative to, so that it may be stored anywhere.

    On Windows, "/" alone is of the working folder's drive, which may be another one later. What is
    on other drives than the system's is in the copy as a whole.
    """
    return f"{environment.get('SYSTEMDRIVE') or 'C:'}/" if system == "nt" else "/"


ROOT = root_of(os.name, os.environ)
_LARGEST = 1 << 40  # bytes


class Recovery(NamedTuple):
    """A copy left behind by a crashed editor.

    Attributes
    ----------
    path : str
        Of the copy.
    document : str or None
        The file of which it is a later state; None if it never had one.
    time : float
        When it was made, in seconds since the epoch.
    """

    path: str
    document: str | None
    time: float


def content_of(copy: Recovery) -> tuple[str, bytes]:
    """Return the base of the paths in a copy, and the copy's scene.

    Raises
    ------
    FileAccessError, FileFormatError
    """
    data = json_records.read_small(copy.path, _LARGEST)  # a scene may be large
    return os.path.join(ROOT, os.path.basename(copy.path)), b"{" + data.partition(b"\n")[2]
