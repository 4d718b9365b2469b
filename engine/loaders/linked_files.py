"""Finding the files that a file names, without ever leaving the folder of the model.

In: a name as it stands in a file (``mtllib``, ``map_Kd``), written on any system. Out: the path of
a regular file inside the folder, or the reason why there is none. Absolute names, ``..`` and
symbolic links that lead out are refused; devices and FIFOs are never opened.
"""

from __future__ import annotations

import os
import re
import stat

_MAX_NAME = 4096


class LinkedFileError(Exception):
    """The reason, in a few words, why a named file is not read."""


def find_linked_file(name: str, folder: str, root: str | None = None) -> str:
    """Return the path of the file that ``name`` means.

    Parameters
    ----------
    name : str
        Relative name; backslashes count as slashes. Where the letter case differs from that of the
        one on disk, the file is still found.
    folder : str
        The folder that the name is relative to.
    root : str, optional
        The folder that may not be left; ``folder`` if left out.

    Raises
    ------
    LinkedFileError
    """
    name = name.strip().strip('"').replace("\\", "/")
    if not name or "\0" in name or len(name) > _MAX_NAME:
        raise LinkedFileError("not a file name")
    if name.startswith(("/", "~")) or re.match(r"[A-Za-z]:", name):
        raise LinkedFileError("an absolute path is refused")
    path = os.path.join(folder, name)
    inside = os.path.realpath(folder if root is None else root)
    try:
        if not os.path.lexists(path):
            path = _with_other_case(path)
        real = os.path.realpath(path)
        if os.path.commonpath([inside, real]) != inside:
            raise LinkedFileError("a path that leaves the model's folder is refused")
        mode = os.stat(real).st_mode
    except FileNotFoundError:
        raise LinkedFileError("not found") from None
    except (OSError, ValueError) as error:
        raise LinkedFileError(getattr(error, "strerror", None) or "not a file name") from None
    if not stat.S_ISREG(mode):
        raise LinkedFileError("not a regular file")
    return path


def _with_other_case(path: str) -> str:
    """The path with the last part as the folder spells it, if only letter case differs."""
    folder, name = os.path.split(path)
    wanted = name.casefold()
    try:
        for entry in sorted(os.listdir(folder or ".")):
            if entry.casefold() == wanted:
                return os.path.join(folder, entry)
    except OSError:
        pass
    return path
