"""Adds plug-ins to the running program, without any package."""

from __future__ import annotations

from typing import Any

from ...errors import InvalidArgumentError
from ..calls import checks_types
from ..numbers import shown
from . import registry
from .groups import group_named
from .plugin import Plugin


@checks_types
def register(group: str, name: str, value: Any) -> None:
    """Add a reader, a writer, … to this process, as an entry point of a package would.

    Parameters
    ----------
    group : {"readers", "writers", "datasets", "commands", "scenes", "looks"}
    name : str
        The entry point's name, such as the extension ``"vox"``. It replaces one of an installed
        package, and one that was registered before.
    value : object
        What the entry point would name; docs/plugins.md has the contract of each group.

    Raises
    ------
    InvalidArgumentError
        engine3d itself has this name, or there is no such group.
    PluginError
        The value demands a newer contract than this engine3d knows.
    """
    row = group_named(group)
    if not row.allows(name):
        raise InvalidArgumentError(f"name must be {row.names} without a dot, not {shown(name)}")
    if name in row.shipped_names():
        raise InvalidArgumentError(f"{name!r} is a name of engine3d's own {row.name}")
    if not row.takes(value):
        raise InvalidArgumentError(
            f"value cannot be registered: {row.name} take {row.value}, not {shown(value)}"
        )
    plugin = Plugin(row.name, name, lambda: value)
    plugin.load()
    registry.add(plugin)


@checks_types
def unregister(group: str, name: str) -> None:
    """Take back what `register` added.

    Raises
    ------
    InvalidArgumentError
        Nothing was registered by this name.
    """
    row = group_named(group)
    if not registry.remove(row.name, name):
        raise InvalidArgumentError(f"{shown(name)} was not registered among the {row.name}")
