"""Folders made for files that are about to be written."""

from __future__ import annotations

import os

from ..errors import FileAccessError


def make_folder_of(path: str | os.PathLike[str]) -> None:
    """Make the folder that a file will be in, and those above it. Raises `FileAccessError`."""
    try:
        os.makedirs(os.path.dirname(path) or os.curdir, exist_ok=True)
    except OSError as error:
        raise FileAccessError(f"cannot write: {error.strerror}", path) from error
