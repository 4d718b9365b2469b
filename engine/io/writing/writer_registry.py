"""The list of writers, and the choice among them by extension or name.

A format is a module ``NAME_writer`` of `formats` with a tuple ``WRITERS``; adding the file
registers it. Writers of other packages are rows beside these, for other extensions.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable
from typing import Any, NamedTuple

from ...base.plugins.plugin import Plugin
from ...base.plugins.registry import find_plugin
from ...errors import InvalidArgumentError
from ..formats import modules
from ..plugins.plugin_writing import options_of, write_with_plugin
from ..reading.reader_registry import Format, plugin_formats
from ..reading.sources import endings

#: The extension of engine3d's own scene files, which `save_scene` writes.
SCENE_EXTENSION = ".json"


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
    of_scenes : bool
        Whether ``write`` takes a scene instead of a mesh.
    """

    name: str
    description: str
    extensions: tuple[str, ...]
    write: Callable[..., Any]
    options: tuple[str, ...] = ()
    of_scenes: bool = False


@functools.cache
def writers() -> tuple[Writer, ...]:
    """Return all writers, sorted by name."""
    found = [
        writer for module in modules(writing=True) for writer in getattr(module, "WRITERS", ())
    ]
    return tuple(sorted(found, key=lambda writer: writer.name))


def formats() -> list[Format]:
    """Return the writable formats."""
    shipped = [Format(w.name, w.description, "mesh", w.extensions) for w in writers()]
    return shipped + plugin_formats("writers")


def shipped_names() -> set[str]:
    """Return the extensions and names of formats that engine3d itself writes."""
    ends = {end[1:] for writer in writers() for end in writer.extensions}
    return {SCENE_EXTENSION[1:], *ends, *(writer.name for writer in writers())}


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
    plugin = plugin_writer(path, wanted)
    if plugin is not None:
        return plugin
    known = ", ".join(end for row in formats() for end in row.extensions)
    what = f"format={name!r}" if name is not None else f"{path}: the extension {extension!r}"
    raise InvalidArgumentError(f"{what} is none of those that can be written ({known})")


def plugin_writer(path: str, name: str | None = None) -> Writer | None:
    """Return the writer of a plug-in for a file, or for a name; None if there is none.

    Raises
    ------
    PluginError
        It cannot be imported.
    """
    names = endings(path) if name is None else [name]
    plugin = next(filter(None, (find_plugin("writers", each) for each in names)), None)
    return None if plugin is None else _of_plugin(plugin)


def _of_plugin(plugin: Plugin) -> Writer:
    """Return the row of a plug-in, which is imported for it."""
    options = options_of(plugin)
    write = functools.partial(write_with_plugin, plugin)
    about, ends = f"by {plugin.origin}", (f".{plugin.name}",)
    return Writer(plugin.name, about, ends, write, options, of_scenes=True)
