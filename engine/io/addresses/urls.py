"""Reads files at addresses, by the optional package fsspec.

In: an address of any protocol that fsspec knows. Out: its bytes, of limited size, or an error that
names the address and, where a package is missing, how to install it.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ...base.files.confined_reading import why_no_address
from ...base.optional_packages import needed
from ...errors import Engine3DError, FileAccessError, FileFormatError, printable

#: Bytes that a file at an address may have. Assignable.
MAX_FETCHED = 1 << 30
_PIECE = 1 << 20
_SAID = 300


def fetched(url: str) -> bytes:
    """Return the bytes of the file at an address.

    Raises
    ------
    FileAccessError
        fsspec or a package for the protocol is not installed, the file cannot be read, or reading
        is confined to a folder.
    FileFormatError
        It is larger than `MAX_FETCHED`.
    """
    with _errors_of(url):
        system, path = _system(url)
        parts, total = [], 0
        with system.open(path, "rb") as file:
            while piece := file.read(_PIECE):
                parts.append(piece)
                total += len(piece)
                if total > MAX_FETCHED:
                    raise FileFormatError(f"has more than {MAX_FETCHED} bytes, the limit", url)
    return b"".join(parts)


def size_of_url(url: str) -> int | None:
    """Return the size in bytes of the file at an address; None if its server does not tell.

    Raises
    ------
    FileAccessError
    """
    with _errors_of(url):
        system, path = _system(url)
        size: int | None = system.size(path)
    return size


def is_file_at(url: str) -> bool:
    """Return whether there is a file at an address.

    Raises
    ------
    FileAccessError
    """
    with _errors_of(url):
        system, path = _system(url)
        return bool(system.isfile(path))


def _system(url: str) -> tuple[Any, str]:
    """Return fsspec's file system for an address, and the path in it."""
    if reason := why_no_address():
        raise FileAccessError(reason, url)
    try:
        from fsspec.core import url_to_fs
    except ImportError:
        raise FileAccessError(needed("addresses need", "fsspec", "url"), url) from None
    system, path = url_to_fs(url)
    return system, path


@contextmanager
def _errors_of(url: str) -> Iterator[None]:
    """Name the address in errors of fsspec and of the libraries for its protocols."""
    try:
        yield
    except (Engine3DError, MemoryError):
        raise
    except FileNotFoundError as error:
        raise FileAccessError("cannot read: there is no such file", url) from error
    except Exception as error:  # each protocol's library has errors of its own
        said = printable(" ".join(str(error).split())[:_SAID]) or type(error).__name__
        raise FileAccessError(f"cannot read: {said}", url) from error
