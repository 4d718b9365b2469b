"""Confines reading to one folder, as a server does that reads files for others.

In: a folder and a size. Out: within a block, why a file may not be read: it lies outside, it is at
an address, or it is too large. Whatever opens files for readers asks here, so that files named in
a model are refused as the model itself is, whichever format names them.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple

_MEGABYTE = 1 << 20


class Confinement(NamedTuple):
    """What may be read.

    Attributes
    ----------
    folder : str
        The real path of the folder that holds all files that may be read.
    most_bytes : int
        Of each file.
    option : str
        What sets the size, for messages.
    """

    folder: str
    most_bytes: int
    option: str

    def why_not_at(self, real: str) -> str:
        """Return why a file at a real path must not be read; empty if it may be."""
        return "" if is_inside(real, self.folder) else "outside of the root folder"

    def why_not_of_size(self, size: int) -> str:
        """Return why a file of this many bytes must not be read; empty if it may be."""
        if size <= self.most_bytes:
            return ""
        return f"larger than {self.most_bytes // _MEGABYTE} MB, the limit ({self.option})"


_confinement: ContextVar[Confinement | None] = ContextVar("_confinement", default=None)


@contextmanager
def confined_reading(to: Confinement | None) -> Iterator[None]:
    """Let only files that a confinement allows be read within the block; None allows all."""
    token = _confinement.set(to)
    try:
        yield
    finally:
        _confinement.reset(token)


def confinement() -> Confinement | None:
    """Return what reading is confined to; None if it is not."""
    return _confinement.get()


def why_not_at(path: str) -> str:
    """Return why a file or a folder must not be looked at; empty if it may be."""
    confined = _confinement.get()
    return "" if confined is None else confined.why_not_at(os.path.realpath(path))


def why_not_of_size(size: int) -> str:
    """Return why a file of this many bytes must not be read; empty if it may be."""
    confined = _confinement.get()
    return "" if confined is None else confined.why_not_of_size(size)


def why_no_address() -> str:
    """Return why addresses must not be read; empty if they may be."""
    if _confinement.get() is None:
        return ""
    return "an address: only files in the root folder are read"


def is_inside(path: str, folder: str) -> bool:
    """Return whether a real path is that of a folder, or below it."""
    try:
        return os.path.commonpath([folder, path]) == folder
    except ValueError:  # on another drive
        return False
