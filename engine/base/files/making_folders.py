"""Creates folders for output files."""

from __future__ import annotations

import itertools
import os

from ...errors import FileAccessError
from ..system import sync_folder
from .atomic_write import path_below
from .folders_above import folders_above


def make_folder_of(path: str | os.PathLike[str], *, below: str | None = None) -> None:
    """Create the folder of a file, and the folders above it.

    Raises `FileAccessError`, also if links lead out of the folder ``below``, as `atomic_write`
    does.
    """
    folder = os.path.dirname(path) or os.curdir
    try:
        if below is not None:
            folder = os.path.dirname(path_below(os.fspath(path), below))
        lacking = _lacking(folder)
        os.makedirs(folder, exist_ok=True)
        for made in lacking:
            sync_folder(os.path.dirname(made))
    except FileAccessError:
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise FileAccessError(f"cannot write: {reason}", path) from error


def _lacking(folder: str) -> list[str]:
    """Return a folder and its ancestors, as far as they do not exist yet."""
    lacks = itertools.takewhile(lambda above: not os.path.isdir(above), folders_above(folder))
    return [above for above in lacks if above]  # the empty path is the current folder
