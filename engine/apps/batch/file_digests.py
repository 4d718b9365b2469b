"""Digests of a picture's input files.

In: paths, as they are read. Out: a hash of each file's bytes, computed once until the file changes.
"""

from __future__ import annotations

import hashlib
import os

from ...base.files.hashing import hash_of_file
from ...base.files.stamps import FileStamp, file_stamp, was_written

_known: dict[str, tuple[FileStamp | None, str | None]] = {}


class InputFiles:
    """The input files of one picture.

    Parameters
    ----------
    folder : str
        What their paths are told relative to.
    """

    def __init__(self, folder: str) -> None:
        self._folder = os.path.realpath(folder)
        self.paths: list[str] = []

    def note(self, path: str | os.PathLike[str]) -> None:
        """Record a path before it is read."""
        path = os.path.realpath(path)
        digest_of(path)
        self.paths.append(path)

    def digests(self) -> dict[str, str | None]:
        """Return the hash of each file by relative path, None for missing files."""
        paths = sorted(set(self.paths))
        return {os.path.relpath(path, self._folder): digest_of(path) for path in paths}


def are_as_before(folder: str, digests: dict[str, str | None]) -> bool:
    """Return whether files still match the result of `InputFiles.digests`."""
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
