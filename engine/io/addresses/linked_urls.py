"""Finds the files that a model at an address refers to: beside it, and nowhere else.

In: a name in a file, and the model's address. Out: the address of a file in the model's folder or
below it. Addresses, absolute names and names that lead out of the folder are refused. A folder that
the caller allows (``root``) is on this machine's disk.
"""

from __future__ import annotations

import posixpath

from ..reading.linked_files import LinkedFileError, LinkedFiles, tell_found
from ..reading.linked_names import is_absolute, spellings
from ..reading.sources import Source, read_source
from ..reading.text import shown
from ..reading.warning_list import WarningList
from .url_names import beside, folder_of, is_url
from .urls import is_file_at

# Each missing file costs a question to the server.
_MAX_FAILURES = 100
_MAX_NAME = 1024


def linked_files(source: Source, warnings: WarningList | None = None) -> LinkedFiles:
    """Return the files that a model may refer to, on the disk or beside its address.

    Parameters
    ----------
    source : Source
    warnings : WarningList, optional
        As of `LinkedFiles`.
    """
    if is_url(source.path):
        return LinkedUrls(source.path, source.root, warnings)
    return LinkedFiles(source.folder, source.root, warnings)


class LinkedUrls(LinkedFiles):
    """The files that a model at an address may refer to.

    Parameters
    ----------
    url : str
        The model's address.
    root, warnings
        As of `LinkedFiles`.
    """

    def __init__(
        self, url: str, root: str | None = None, warnings: WarningList | None = None
    ) -> None:
        super().__init__(None, root, warnings)
        self._url, self._top = url, folder_of(url)
        self._missing = 0

    def find(self, name: str, folder: str | None = None) -> str:
        """Return the address of the file that ``name`` refers to, as `LinkedFiles.find`."""
        try:
            url = self._found_url(name, folder)
        except LinkedFileError:
            if not self._has_root:
                raise
            return super().find(name)
        tell_found([url])
        return url

    def find_near(self, name: str, folder: str | None = None) -> tuple[str, str]:
        """Return what `find` returns, and no note: there are no substitutes at addresses."""
        return self.find(name, folder), ""

    def read(self, path: str) -> Source:
        """Read a file that `find` returned."""
        return read_source(path) if is_url(path) else super().read(path)

    def _found_url(self, name: str, folder: str | None) -> str:
        if len(name) > _MAX_NAME or "\0" in name:
            raise LinkedFileError("not a file name")
        inner = "" if folder is None else folder_of(f"{folder}/x").removeprefix(self._top)
        for spelling in spellings(name):
            for place in dict.fromkeys((inner, "")):
                url = beside(self._url, self._top, self._inside(spelling, place))
                if self._missing >= _MAX_FAILURES:
                    raise LinkedFileError("not looked for, too many files are missing")
                if is_file_at(url):
                    return url
                self._missing += 1
        raise LinkedFileError("not found")

    def _inside(self, name: str, place: str) -> str:
        """Return a name relative to the model's folder, checked to stay inside."""
        if not name or is_absolute(name) or is_url(name) or "::" in name:
            raise LinkedFileError(f"{shown(name)} is refused: files beside the model are read")
        path = posixpath.normpath(posixpath.join(place, name))
        if path.split("/")[0] == "..":
            raise LinkedFileError("a path that leaves the model's folder is refused")
        return path
