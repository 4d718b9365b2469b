"""The contents of a folder, as a file dialog lists them.

In: a path, extensions, a search text. Out: its folders, then its files. Nothing is opened or
followed; an unreadable folder is empty, with a reason.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Collection
from typing import Any, NamedTuple

from ...errors import printable
from ..language import translated

MOST = 10_000


class Item(NamedTuple):
    """An entry of a folder.

    Attributes
    ----------
    name : str
    path : str
    is_folder : bool
    size : int
        Bytes; 0 for folders.
    modified : float
        Seconds since the epoch.
    """

    name: str
    path: str
    is_folder: bool
    size: int
    modified: float


class Listing(NamedTuple):
    """The contents of a folder.

    Attributes
    ----------
    path : str
        Absolute.
    items : tuple of Item
        Folders first, each kind by name; at most 10,000.
    reason : str
        Why the list is empty or incomplete; "" if it is complete.
    """

    path: str
    items: tuple[Item, ...]
    reason: str

    def filtered(
        self, extensions: Collection[str] = (), search: str = "", *, hidden: bool = False
    ) -> tuple[Item, ...]:
        """Return the folders, and the files with given extensions, whose names contain a text.

        Parameters
        ----------
        extensions : collection of str
            In lower case, with the dot, also such as ``.obj.gz``; none for all files.
        search : str
            Case is ignored.
        hidden : bool
            Include names that begin with a dot.
        """
        ends, text = tuple(extensions), search.casefold()
        return tuple(
            item
            for item in self.items
            if (hidden or not item.name.startswith("."))
            and text in item.name.casefold()
            and (item.is_folder or not ends or item.name.lower().endswith(ends))
        )


def list_folder(path: str | os.PathLike[str]) -> Listing:
    """Return the folders and regular files in a folder."""
    folder = os.path.abspath(os.fspath(path))
    items: list[Any] = []
    reason = ""
    try:
        with os.scandir(folder) as entries:
            for entry in entries:
                if len(items) == MOST:
                    reason = translated("only {count:,} entries are shown", count=MOST)
                    break
                items += _item(entry)
    except (OSError, ValueError) as error:
        reason = printable(getattr(error, "strerror", None) or str(error))
    items.sort(key=lambda item: (not item.is_folder, item.name.casefold(), item.name))
    return Listing(folder, tuple(items), reason)


def _item(entry: os.DirEntry[str]) -> list[Item]:
    try:
        status = entry.stat()
    except OSError:  # deleted meanwhile, or a broken link
        return []
    is_folder = stat.S_ISDIR(status.st_mode)
    if not is_folder and not stat.S_ISREG(status.st_mode):
        return []
    size = 0 if is_folder else status.st_size
    return [Item(entry.name, entry.path, is_folder, size, status.st_mtime)]
