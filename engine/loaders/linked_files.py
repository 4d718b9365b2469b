"""Finding the files that a file names, without ever leaving the folder of the model.

In: a name as it stands in a file (``mtllib``, ``map_Kd``), written on any system. Out: the path of
a regular file inside the folder, or the reason why there is none. Absolute names, ``..`` and
symbolic links that lead out are refused; devices and FIFOs are never read. Whatever becomes of the
folder meanwhile, what is read is a regular file that was inside it when it was opened.
"""

from __future__ import annotations

import os
import re
import stat
from collections.abc import Callable, Iterable
from contextlib import contextmanager
from contextvars import ContextVar
from urllib.parse import unquote

from .._support.system import FOLDER, NO_LINK
from ..errors import FileAccessError
from .open_files import unreadable
from .sources import READING, Source, opened_source, unpacked

_MAX_NAME = 4096
_LONGEST_ESCAPE = 3  # letters
# A file that names more missing ones than this only wants to keep the disk busy.
_MAX_FAILURES = 2000

_listeners: ContextVar[tuple[Callable[[str], object], ...]] = ContextVar("listeners", default=())


@contextmanager
def found_files(note: Callable[[str], object]):
    """Call ``note`` with each path that is found within the block, before it is read."""
    token = _listeners.set((*_listeners.get(), note))
    try:
        yield
    finally:
        _listeners.reset(token)


def tell_found(paths: Iterable[str]) -> None:
    """Call what `found_files` was given with paths that were found elsewhere."""
    for path in paths:
        for note in _listeners.get():
            note(path)


class LinkedFileError(Exception):
    """The reason, in a few words, why a named file is not read."""


class LinkedFiles:
    """The files that one model may name.

    Parameters
    ----------
    root : str or None
        The model's folder, which no name may leave; None if it has none, being no file.
    """

    def __init__(self, root: str | None) -> None:
        self.root = root
        self._real_root = None if root is None else os.path.realpath(root)
        self._listings: dict[str, dict[str, str]] = {}
        self._failures = 0

    def find(self, name: str, folder: str | None = None) -> str:
        """Return the path of the file that ``name`` means.

        Parameters
        ----------
        name : str
            Relative name; backslashes count as slashes. Where the letter case differs from that
            of the one on disk, the file is still found.
        folder : str, optional
            The folder that the name is relative to; the model's if left out.

        Raises
        ------
        LinkedFileError
        """
        if self.root is None:
            raise LinkedFileError("not looked for, the model is in no folder")
        if self._failures >= _MAX_FAILURES:
            raise LinkedFileError("not looked for, too many files are missing")
        try:
            path = self._find(name, self.root if folder is None else folder)
            tell_found([path])
            return path
        except LinkedFileError:
            self._failures += 1
            raise

    def read(self, path: str) -> Source:
        """Read a file that `find` returned.

        It is looked for anew, opened once, and what was opened is read: a link that has taken the
        place of the file, or of a folder on the way to it, since then leads nowhere.

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
        """Go from the root to the file, folder by folder, following no link."""
        real = self._real_path(path)
        if not FOLDER:  # a system that opens no folders
            return os.open(real, READING)
        *folders, name = os.path.relpath(real, self._real_root).split(os.sep)
        handle = os.open(self._real_root, FOLDER)
        try:
            for folder in folders:
                outer, handle = handle, os.open(folder, FOLDER | NO_LINK, dir_fd=handle)
                os.close(outer)
            return os.open(name, READING | NO_LINK, dir_fd=handle)
        finally:
            os.close(handle)

    def _real_path(self, path: str) -> str:
        """The path without links, which must be inside."""
        real = os.path.realpath(path)
        if os.path.commonpath([self._real_root, real]) != self._real_root:
            raise LinkedFileError("a path that leaves the model's folder is refused")
        return real

    def find_uri(self, uri: str) -> str:
        """Return the path of the file beside the model that a URI, or a plain name, means.

        Raises
        ------
        LinkedFileError
        """
        try:
            return self.find(uri)
        except LinkedFileError:
            if len(uri) > _LONGEST_ESCAPE * _MAX_NAME:
                raise  # taking the escapes apart takes many times its memory
            plain = unquote(uri)
            if plain == uri:
                raise
            return self.find(plain)

    def _find(self, name: str, folder: str) -> str:
        name = name.strip().strip('"').replace("\\", "/")
        if not name or "\0" in name or len(name) > _MAX_NAME:
            raise LinkedFileError("not a file name")
        if name.startswith(("/", "~")) or re.match(r"[A-Za-z]:", name):
            raise LinkedFileError("an absolute path is refused")
        path = os.path.join(folder, name)
        try:
            if not os.path.lexists(path):
                path = self._with_other_case(path)
            mode = os.stat(self._real_path(path)).st_mode
        except FileNotFoundError:
            raise LinkedFileError("not found") from None
        except (OSError, ValueError) as error:
            raise LinkedFileError(getattr(error, "strerror", None) or "not a file name") from None
        if not stat.S_ISREG(mode):
            raise LinkedFileError("not a regular file")
        return path

    def _with_other_case(self, path: str) -> str:
        """The path with the last part as the folder spells it, if only letter case differs."""
        folder, name = os.path.split(path)
        if folder not in self._listings:
            try:
                entries = sorted(os.listdir(folder or "."), reverse=True)
            except OSError:
                entries = []
            self._listings[folder] = {entry.casefold(): entry for entry in entries}
        return os.path.join(folder, self._listings[folder].get(name.casefold(), name))
