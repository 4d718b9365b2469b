"""The summary of a batch.

In: outcomes, one by one. Out: counts, the failures by name, a hash of everything that was written.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from ...base.calls import shows_annotations
from ...base.files.atomic_write import atomic_write

SUMS = "SHA256SUMS"


@shows_annotations
class Failure(NamedTuple):
    """A picture that could not be drawn.

    Attributes
    ----------
    name : str
        Of the task.
    error : str
        On one line.
    """

    name: str
    error: str


@dataclass
class Summary:
    """The summary of a batch.

    Attributes
    ----------
    drawn, done_before : int
        Pictures that were drawn now, and those that were there.
    failures : list of Failure
        In the order of the tasks.
    seconds : float
        The sum of what each picture took.
    hash : str
        SHA-256 of the file ``SHA256SUMS``, which lists all files with theirs: equal for equal sets.
    plugins : list of str
        The packages whose plug-ins took part in the pictures, with their versions.
    """

    drawn: int = 0
    done_before: int = 0
    failures: list[Failure] = field(default_factory=list)
    seconds: float = 0.0
    hash: str = ""
    plugins: list[str] = field(default_factory=list)


def write_sums(folder: str, hashes: Iterable[tuple[str, str]]) -> str:
    """Write the list for ``sha256sum -c``; return its own hash.

    Parameters
    ----------
    folder : str
    hashes : iterable of (path, SHA-256)
    """
    lines = [f"{digest}  {path}\n" for path, digest in hashes]
    data = "".join(sorted(lines, key=lambda line: line[66:])).encode("utf-8")
    with atomic_write(os.path.join(folder, SUMS), below=folder) as file:
        file.write(data)
    return hashlib.sha256(data).hexdigest()
