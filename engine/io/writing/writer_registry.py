"""The list of writers, and the choice among them by extension or name.

A format is a module ``NAME_writer`` of `formats` with a tuple ``WRITERS``; adding the file
registers it.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable
from typing import Any, NamedTuple

from ...errors import InvalidArgumentError
from ..formats import modules
from ..reading.reader_registry import Format


class Writer(NamedTuple):
    """One writable format.

    Attributes
    ----------
    name : str
        Short name, such as ``"obj"``.
    description : str
    extensions : tuple of str
        Lower case, with the dot.
    write : callable
        ``write(mesh, path, files, **options) -> list of str``: a line for each loss. ``files`` is
        an `AtomicFiles`, or a `StreamFiles`, which takes one file only.
    options : tuple of str
        The names of its options.
    """

    name: str
    description: str
    extensions: tuple[str, ...]
    write: Callable[..., Any]
    options: tuple[str, ...] = ()


@functools.cache
def writers() -> tuple[Writer, ...]:
    """Return all writers, sorted by name."""
    found = [
        writer for module in modules(writing=True) for writer in getattr(module, "WRITERS", ())
    ]
    return tuple(sorted(found, key=lambda writer: writer.name))


def formats() -> list[Format]:
    """Return the writable formats."""
    return [Format(w.name, w.description, "mesh", w.extensions) for w in writers()]


def find_writer(path: str, name: str | None = None) -> Writer:
    """Return the writer for a file.

    Raises
    ------
    InvalidArgumentError
        No format has this extension or name.
    """
    wanted = name.lower().removeprefix(".") if name is not None else None
    extension = os.path.splitext(path)[1].lower() if wanted is None else "." + wanted
    for writer in writers():
        if wanted == writer.name or extension in writer.extensions:
            return writer
    known = ", ".join(e for writer in writers() for e in writer.extensions)
    what = f"format={name!r}" if name is not None else f"{path}: the extension {extension!r}"
    raise InvalidArgumentError(f"{what} is none of those that can be written ({known})")
