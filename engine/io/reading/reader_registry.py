"""The list of readers, and the choice among them.

A format is a module of `formats` with a tuple ``READERS``; adding the file registers it. The choice
uses the signature in the first bytes, then the extension, then the look of the text if the
extension is inconclusive. The module named after the extension is tried alone before all are
imported. Readers of other packages are rows beside these, for extensions that none of these has.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from ...base.calls import checks_types
from ...base.plugins.groups import group_named
from ...base.plugins.plugin import Plugin
from ...base.plugins.registry import find_plugin, origins_of, plugin_names
from ...errors import FileFormatError, InvalidArgumentError
from ..formats import modules, named
from ..plugins.plugin_reading import read_with_plugin, up_of
from .sources import Source, endings

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

SNIFFED_BYTES = 4096


class Reader(NamedTuple):
    """One readable format.

    Attributes
    ----------
    name : str
        Short name, such as ``"obj"``.
    description : str
    kind : {"mesh", "image"}
    extensions : tuple of str
        Lower case, with the dot.
    read : callable
        ``read(source, split=False) -> Document`` for meshes: with ``split`` every object of the
        file becomes one of the document, with its pose; otherwise poses are applied. ``read(source)
        -> (H, W, 4) uint8`` for images. Both raise `FileFormatError` if a file is damaged, too
        large, or needs a package that is not installed.
    signature : callable, optional
        ``signature(head) -> bool``: whether the first bytes prove this format.
    resembles : callable, optional
        ``resembles(head, size) -> bool``: whether the first bytes of a file of this size look like
        this format.
    read_linear : callable, optional
        For images whose pixels are light: as ``read``, with codes proportional to light.
    up : str
        The format's usual up axis; empty if each file states its own, in `Document.up`.
    """

    name: str
    description: str
    kind: str
    extensions: tuple[str, ...]
    read: Callable[..., Any]
    signature: Callable[[bytes], bool] | None = None
    resembles: Callable[[bytes, int], bool] | None = None
    read_linear: Callable[[Source], NDArray[np.uint8]] | None = None
    up: str = "+Y"


class Format(NamedTuple):
    """A readable format, for listings."""

    name: str
    description: str
    kind: str
    extensions: tuple[str, ...]


@functools.cache
def readers() -> tuple[Reader, ...]:
    """Return all readers, sorted by name."""
    found = [
        reader for module in modules(writing=False) for reader in getattr(module, "READERS", ())
    ]
    return tuple(sorted(found, key=lambda reader: reader.name))


@checks_types
def formats(kind: str | None = None) -> list[Format]:
    """Return the readable formats.

    Parameters
    ----------
    kind : {"mesh", "image"}, optional
        Return only formats of this kind.
    """
    shipped = [
        Format(reader.name, reader.description, reader.kind, reader.extensions)
        for reader in readers()
        if kind in (None, reader.kind)
    ]
    return shipped + plugin_formats("readers") if kind in (None, "mesh") else shipped


def plugin_formats(group: str) -> list[Format]:
    """Return the formats that plug-ins of a group read or write; none is imported."""
    return [
        Format(name, f"by {origins_of(group, name)}", "mesh", (f".{name}",))
        for name in plugin_names(group)
        if group_named(group).allows(name)
    ]


def shipped_names() -> set[str]:
    """Return the extensions and names of model formats that engine3d itself reads."""
    rows = [reader for reader in readers() if reader.kind == "mesh"]
    return {reader.name for reader in rows}.union(
        extension[1:] for reader in rows for extension in reader.extensions
    )


def find_reader(source: Source, kind: str, name: str | None = None) -> Reader:
    """Return the reader for a file.

    Parameters
    ----------
    source : Source
    kind : {"mesh", "image"}
    name : str, optional
        The format; skips detection.

    Raises
    ------
    FileFormatError
        No format of this kind matches.
    InvalidArgumentError
        No format of this kind has that name.
    """
    head = source.head(SNIFFED_BYTES)
    namesake = _namesake(source.extension, kind)
    if name is None and namesake is not None and _recognises(namesake, head, source.size):
        return namesake
    candidates = [reader for reader in readers() if reader.kind == kind]
    if name is not None:
        return _by_name(candidates, name, kind, source)
    if kind == "mesh" and not any(source.extension in each.extensions for each in candidates):
        found = (find_plugin("readers", end) for end in endings(source.path))
        if (plugin := next(filter(None, found), None)) is not None:
            return _of_plugin(plugin, source)
    for reader in candidates:
        if reader.signature is not None and reader.signature(head):
            return reader
    for reader in candidates:
        if source.extension in reader.extensions:
            return reader
    for reader in candidates:
        if reader.resembles is not None and reader.resembles(head, source.size):
            return reader
    known = ", ".join(sorted(end for row in formats(kind) for end in row.extensions))
    what = repr(source.extension) if source.extension else "without an extension"
    raise FileFormatError(f"unknown {kind} format {what} (known: {known})", source.path)


def _namesake(extension: str, kind: str) -> Reader | None:
    """Return an extension's reader from the module of that name, without importing others."""
    if not extension[1:].isidentifier():
        return None
    module = named(extension[1:])
    for reader in getattr(module, "READERS", ()):
        if reader.kind == kind and extension in reader.extensions:
            return reader
    return None


def _recognises(reader: Reader, head: bytes, size: int) -> bool:
    if reader.signature is not None and reader.signature(head):
        return True
    return reader.resembles is not None and reader.resembles(head, size)


def _by_name(candidates: list[Reader], name: str, kind: str, source: Source) -> Reader:
    wanted = str(name).lower().removeprefix(".")
    for reader in candidates:
        if wanted == reader.name or "." + wanted in reader.extensions:
            return reader
    plugin = find_plugin("readers", wanted) if kind == "mesh" else None
    if plugin is not None:
        return _of_plugin(plugin, source)
    known = ", ".join(row.name for row in formats(kind))
    raise InvalidArgumentError(f"format={name!r} is no {kind} format (known: {known})")


def _of_plugin(plugin: Plugin, source: Source) -> Reader:
    """Return the row of a plug-in, which is imported for it."""
    up = up_of(plugin, source)
    read = functools.partial(read_with_plugin, plugin)
    return Reader(plugin.name, f"by {plugin.origin}", "mesh", (f".{plugin.name}",), read, up=up)
