"""The kinds of data sets that manifests name: those that ship, and those of other packages."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

from ...base.numbers import shown
from ...base.plugins.open_choices import OpenChoices
from ...base.plugins.plugin import Plugin, fault
from ...base.plugins.registry import find_plugin, listed
from ...errors import PluginError
from .bop import BopWriter
from .coco import CocoWriter
from .folders import FolderWriter
from .web import WebDatasetWriter
from .writer import DatasetWriter

_WRITERS: dict[str, type[DatasetWriter]] = {
    writer.kind: writer for writer in (BopWriter, CocoWriter, FolderWriter, WebDatasetWriter)
}
#: What ``"writer"`` of a manifest may say.
KINDS = OpenChoices("datasets", _WRITERS)


def shipped_names() -> set[str]:
    """Return the kinds that engine3d itself has."""
    return set(_WRITERS)


def writer_class(kind: str) -> type[DatasetWriter]:
    """Return the writer of a kind, one of `KINDS`.

    Raises
    ------
    PluginError
        It is a plug-in's, which is broken.
    """
    if kind in _WRITERS:
        return _WRITERS[kind]
    plugin = find_plugin("datasets", kind)
    if plugin is None:
        raise KeyError(kind)
    writer: type[DatasetWriter] = plugin.load()
    if getattr(writer, "kind", None) != kind:
        raise fault(plugin, f"has kind = {shown(getattr(writer, 'kind', None))}")
    return writer


def made_writer(kind: str, /, **options: Any) -> DatasetWriter:
    """Return a new writer of a kind, one of `KINDS`.

    Raises
    ------
    InvalidArgumentError, TypeError
        Of the writer, about its options.
    PluginError
        It is a plug-in's, which is broken.
    """
    make = writer_class(kind)
    plugin = None if kind in _WRITERS else find_plugin("datasets", kind)
    with contextlib.nullcontext() if plugin is None else plugin.named_in_errors(TypeError):
        return make(**options)


@contextlib.contextmanager
def named_in_errors(writer: DatasetWriter) -> Iterator[Plugin | None]:
    """Name the plug-in whose writer this is, if it is one's, in errors within the block."""
    plugin = plugin_of(writer)
    with contextlib.nullcontext() if plugin is None else plugin.named_in_errors():
        yield plugin


def plugin_of(writer: DatasetWriter) -> Plugin | None:
    """Return the plug-in whose writer this is, or None."""
    if type(writer).__module__.partition(".")[0] == __name__.partition(".")[0]:
        return None  # of engine3d: no metadata is read
    for plugin in listed():
        if (plugin.group, plugin.name) == ("datasets", writer.kind):
            with contextlib.suppress(PluginError):  # a broken one is nobody's writer
                if plugin.load() is type(writer):
                    return plugin
    return None
