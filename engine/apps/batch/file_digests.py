"""What a picture was made from: the digests of its input files, and the plug-ins that took part.

In: paths, as they are read. Out: a hash of each file's bytes, computed once until the file changes.
"""

from __future__ import annotations

import hashlib
import os

from ...base.files.hashing import hash_of_file
from ...base.files.stamps import FileStamp, file_stamp, was_written
from ...base.plugins.plugin import Plugin

_known: dict[str, tuple[FileStamp | None, str | None]] = {}


class Inputs:
    """The input files of one picture, and the plug-ins that took part in it.

    Parameters
    ----------
    folder : str
        What their paths are told relative to.
    """

    def __init__(self, folder: str) -> None:
        self._folder = os.path.realpath(folder)
        self.paths: list[str] = []
        self._plugins: list[list[str]] = []

    def note(self, path: str | os.PathLike[str]) -> None:
        """Record a path before it is read."""
        path = os.path.realpath(path)
        digest_of(path)
        self.paths.append(path)

    def note_plugin(self, plugin: Plugin) -> None:
        """Record a plug-in that is used."""
        if plugin.stamp not in self._plugins:
            self._plugins.append(plugin.stamp)

    def plugins(self) -> list[list[str]]:
        """Return the stamps of the plug-ins."""
        return sorted(self._plugins)

    def digests(self) -> dict[str, str | None]:
        """Return the hash of each file by relative path, None for missing files."""
        paths = sorted(set(self.paths))
        return {_path_from(self._folder, path): digest_of(path) for path in paths}


def _path_from(folder: str, path: str) -> str:
    """Return a path relative to a folder, with slashes; or itself, if it is on another drive."""
    try:
        return os.path.relpath(path, folder).replace(os.sep, "/")
    except ValueError:
        return path


def are_as_before(folder: str, digests: dict[str, str | None]) -> bool:
    """Return whether files still match the result of `Inputs.digests`."""
    return all(
        digest_of(os.path.normpath(os.path.join(os.path.realpath(folder), path))) == digest
        for path, digest in digests.items()
    )


def digest_of(path: str) -> str | None:
    """Return the hash of a file's content; None if it cannot be read."""
    stamp = file_stamp(path)
    before = _known.get(path)
    if before is not None and not was_written(before[0], stamp):
        return before[1]
    try:
        digest = hash_of_file(path, hashlib.blake2b(digest_size=20))
    except OSError:
        digest = None
    _known[path] = stamp, digest
    return digest
