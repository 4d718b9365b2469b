"""Names of files that every system takes, and takes for different ones.

In: names that data give to files, and paths of output files. Out: what is wrong with one on some
system; a key that is the same for names that some system takes for one.

Windows has devices by the names ``con`` or ``aux``, also with an ending, and drops dots and spaces
at the end of a name. Windows and macOS tell neither capitals nor the ways to write an accent apart.
Source: Microsoft, "Naming Files, Paths, and Namespaces".
"""

from __future__ import annotations

import ntpath
import re
import sys
import unicodedata

_DEVICE = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[\d¹²³]) *([.:].*)?", re.I | re.S)
_REFUSED = re.compile(r'[\0-\x1f<>:"|?*\\]')
_DROPPED = (".", " ")
_HERE = ("", ".", "..")  # parts of paths that name no file


def is_device(part: str) -> bool:
    """Return whether Windows takes a part of a path for a device, such as ``"aux.1.png"``."""
    return _DEVICE.fullmatch(part) is not None


def fault_of(name: str) -> str | None:
    """Return what is wrong on some system with a relative path, whose folders ``/`` separates."""
    parts = [part for part in name.split("/") if part not in _HERE]
    return next(filter(None, map(_fault_of_part, parts)), None)


def fault_on_windows(path: str) -> str | None:
    """Return why Windows would not write a file with the name in a path, or None.

    A device may be meant by its bare name, such as ``NUL``.
    """
    _, rest = ntpath.splitdrive(path)
    parts = [part for part in re.split(r"[\\/]", rest) if part not in _HERE]
    if len(parts) == 1 and is_device(path) and "." not in path:
        return None
    return next(filter(None, map(_fault_of_part, parts)), None)


def _fault_of_part(part: str) -> str | None:
    if is_device(part):
        return f"{part!r} is a device on Windows"
    if part.endswith(_DROPPED):
        return f"Windows drops the end of {part!r}"
    refused = _REFUSED.search(part)
    return None if refused is None else f"Windows allows no {refused[0]!r} in {part!r}"


def folded(name: str) -> str:
    """Return a text that is the same for names of files that some system takes for one."""
    if name.isascii():
        return name.lower()
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).casefold())


def key_here(name: str) -> str:
    """Return a text that is the same for names of files that this system takes for one."""
    return folded(name) if sys.platform in ("win32", "darwin") else name


def common_name(name: str, other: str) -> str:
    """Return how two names are one, such as ``"the name 'a'"``; they are equal when folded."""
    if name == other:
        return f"the name {name!r}"
    return f"names that are one on Windows and macOS, {other!r} and {name!r}"
