"""Finds the files that a file refers to, without leaving the model's folder.

In: a name in a file (``mtllib``, ``map_Kd``, a URI), written on any system. Out: the path of a
regular file inside the folder, or the reason why there is none. Absolute names, ``..`` and symbolic
links that lead out are refused, unless they stay in a root given by the caller; devices and FIFOs
are never read. Even if the folder changes meanwhile, only regular files inside it at opening time
are read. `confined_reading` narrows all that further. linked_names.py handles the spellings of
names.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from ...base.files.confined_reading import is_inside, why_not_at
from ...base.numbers import shown as shown_value
from ...errors import FileAccessError, InvalidArgumentError
from .linked_names import ends, is_absolute, match_key, spellings
from .open_files import opened_below, unreadable
from .sources import Source, opened_source, unpacked
from .text import shown
from .warning_list import WarningList

_MAX_NAME = 4096
# Decoding the escapes of a longer name would take many times its memory.
_MAX_SPELT = 3 * _MAX_NAME
# A file that causes more failed lookups than this only wants to keep the disk busy.
_MAX_FAILURES = 16_000
_NOT_FOUND = "not found"

_listeners: ContextVar[tuple[Callable[[str], object], ...]] = ContextVar("listeners", default=())


@contextmanager
def found_files(note: Callable[[str], object]) -> Iterator[None]:
    """Call ``note`` with each path found within the block, before it is read."""
    token = _listeners.set((*_listeners.get(), note))
    try:
        yield
    finally:
        _listeners.reset(token)


def tell_found(paths: Iterable[str]) -> None:
    """Report paths found elsewhere to the function given to `found_files`."""
    for path in paths:
        for note in _listeners.get():
            note(path)


def checked_root(root: str | os.PathLike[str] | None) -> str | None:
    """Return the path of a folder that may contain files named in a model.

    Raises
    ------
    InvalidArgumentError
        The argument is not a path.
    FileAccessError
        The folder does not exist.
    """
    if root is None:
        return None
    try:
        path = os.fspath(root)
    except TypeError:
        path = None
    if not isinstance(path, str):
        raise InvalidArgumentError(f"root must be the path of a folder, not {shown_value(root)}")
    if not os.path.isdir(path):
        raise FileAccessError("root: there is no such folder", path)
    return path


class LinkedFileError(Exception):
    """A short reason why a named file is not read."""


class LinkedFiles:
    """The files that one model may refer to.

    Parameters
    ----------
    folder : str or None
        The model's folder, which no name may leave; None if the model is not a file.
    root : str, optional
        Another folder that names may lead into.
    warnings : WarningList, optional
        Gets the notes of `find_uri` about substitute files.
    """

    def __init__(
        self, folder: str | None, root: str | None = None, warnings: WarningList | None = None
    ) -> None:
        places = [place for place in (folder, root) if place is not None]
        self._places = list(dict.fromkeys(places))
        self._has_root = root is not None
        self._roots = [os.path.realpath(place) for place in self._places]
        self._warnings = warnings
        self._listings: dict[str, dict[str, str]] = {}
        self._failures = 0

    def find(self, name: str, folder: str | None = None) -> str:
        """Return the path of the file that ``name`` refers to.

        Parameters
        ----------
        name : str
            Backslashes count as slashes. Files are also found if the letter case or encoding of the
            name differs from the disk's.
        folder : str, optional
            The folder to search first; then the model's, then the root.

        Raises
        ------
        LinkedFileError
        """
        if len(name) > _MAX_SPELT:
            raise LinkedFileError("not a file name")
        places = self._places_from(folder)
        path = self._first_found(spellings(name), places)
        tell_found([path])
        return path

    def find_near(self, name: str, folder: str | None = None) -> tuple[str, str]:
        """Return the path of the file for ``name``, or of a substitute.

        Files often contain paths of another machine. The file that matches the most trailing parts
        of such a path is the substitute.

        Returns
        -------
        path : str
        note : str
            A note about a substitute; empty if the file was found as named.

        Raises
        ------
        LinkedFileError
        """
        try:
            return self.find(name, folder), ""
        except LinkedFileError as error:
            reason = error
        if len(name) > _MAX_SPELT:
            raise reason
        try:
            path = self._first_found(ends(name), self._places_from(folder))
        except LinkedFileError:
            raise reason from None
        tell_found([path])
        return path, f"{reason}; {path} is used"

    def find_uri(self, uri: str) -> str:
        """Return the path of the file for a URI or plain name, as `find_near`.

        Raises
        ------
        LinkedFileError
        """
        path, note = self.find_near(uri)
        if note and self._warnings is not None:
            self._warnings.add(f"{shown(uri)}: {note}")
        return path

    def _places_from(self, folder: str | None) -> list[str]:
        """Return the folders that a name may be relative to, most likely first."""
        if not self._places:
            raise LinkedFileError("not looked for, the model is in no folder")
        return self._places if folder is None else list(dict.fromkeys([folder, *self._places]))

    def _first_found(self, names: Iterable[str], places: list[str]) -> str:
        """Return the first file with any of the names in any of the folders.

        If there is none, return the most specific reason.
        """
        reason = LinkedFileError(_NOT_FOUND)
        for name in names:
            for place in places:
                if self._failures >= _MAX_FAILURES:
                    raise LinkedFileError("not looked for, too many files are missing")
                try:
                    return self._found(name, place)
                except LinkedFileError as error:
                    self._failures += 1
                    if str(reason) == _NOT_FOUND:
                        reason = error
        raise reason

    def read(self, path: str) -> Source:
        """Read a file that `find` returned.

        It is located again, opened once, and read from that handle: a link that has since replaced
        the file or a folder on its path leads nowhere.

        Raises
        ------
        FileAccessError, FileFormatError
        """
        try:
            handle = self._opened(path)
        except LinkedFileError as error:
            raise FileAccessError(str(error), path) from None
        except (OSError, ValueError) as error:
            raise unreadable(path, error) from error
        return unpacked(opened_source(path, handle))

    def _opened(self, path: str) -> int:
        real = self._real_path(path)
        return opened_below(next(root for root in self._roots if is_inside(real, root)), real)

    def _real_path(self, path: str) -> str:
        """Return the path without links, checked to be inside."""
        real = os.path.realpath(path)
        if reason := why_not_at(real):
            raise LinkedFileError(reason)
        if not any(is_inside(real, root) for root in self._roots):
            raise LinkedFileError(
                "a path that leaves the model's folder is refused; root=FOLDER allows another"
            )
        return real

    def _found(self, name: str, folder: str) -> str:
        """Return the path of the file with one name in one folder."""
        if not name or "\0" in name or len(name) > _MAX_NAME:
            raise LinkedFileError("not a file name")
        if is_absolute(name) and not (self._has_root and os.path.isabs(name)):
            raise LinkedFileError("an absolute path is refused")
        path = os.path.join(folder, name)
        try:
            if os.path.isabs(name):
                self._real_path(path)  # whether there are files outside is not told
            if not os.path.lexists(path):
                path = self._as_on_disk(folder, name)
            mode = os.stat(self._real_path(path)).st_mode
        except FileNotFoundError:
            raise LinkedFileError(_NOT_FOUND) from None
        except (OSError, ValueError) as error:
            raise LinkedFileError(getattr(error, "strerror", None) or "not a file name") from None
        if not stat.S_ISREG(mode):
            raise LinkedFileError("not a regular file")
        return path

    def _as_on_disk(self, folder: str, name: str) -> str:
        """Return the path in the folders' spelling, matching parts by `match_key`."""
        path = folder
        for part in name.split("/"):
            inner = os.path.join(path, part)
            if part not in ("", ".", "..") and not os.path.lexists(inner):
                self._real_path(path)  # no folder outside is listed
                inner = os.path.join(path, self._listing(path).get(match_key(part), part))
            path = inner
        return path

    def _listing(self, folder: str) -> dict[str, str]:
        if folder not in self._listings:
            try:
                entries = sorted(os.listdir(folder or "."), reverse=True)
            except OSError:
                entries = []
            self._listings[folder] = {match_key(entry): entry for entry in entries}
        return self._listings[folder]
