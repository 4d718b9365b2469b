"""Finds plug-ins by group and name: those of the running program, and of installed packages.

What ships has the first word, then what the program registered, then installed packages. Callers
look among their own rows first: until a name is unknown to them, no metadata is read.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...errors import PluginError
from .discovery import installed_plugins
from .groups import group_named
from .plugin import Plugin

_registered: dict[tuple[str, str], Plugin] = {}


def add(plugin: Plugin) -> None:
    """Add a plug-in of this program; it replaces one of the same name."""
    _registered[plugin.group, plugin.name] = plugin


def remove(group: str, name: str) -> bool:
    """Take back what `add` added; return whether there was something."""
    return _registered.pop((group, name), None) is not None


def listed() -> tuple[Plugin, ...]:
    """Return all plug-ins: those that were registered, and those of installed packages.

    None is imported. One whose name engine3d itself has is among them, but is never used.
    """
    return (*_registered.values(), *installed_plugins())


def plugin_names(group: str) -> list[str]:
    """Return the names that plug-ins add to a group, sorted, without those that ship."""
    names = {plugin.name for plugin in listed() if plugin.group == group}
    return sorted(names - group_named(group).shipped_names()) if names else []


def origins_of(group: str, name: str) -> str:
    """Return the packages that add a name, with their versions, for listings."""
    found = (one.origin for one in listed() if (one.group, one.name) == (group, name))
    return " and ".join(dict.fromkeys(found))


def are_here(stamps: Iterable[list[str]]) -> bool:
    """Return whether the plug-ins with these stamps are the ones that would be used now."""
    known = {(group, name): found for group, name, *found in (one.stamp for one in listed())}
    return all(known.get((group, name)) == found for group, name, *found in stamps)


def find_plugin(group: str, name: str) -> Plugin | None:
    """Return the plug-in for a name that does not ship, or None.

    Raises
    ------
    PluginError
        Several packages add this name.
    """
    if (group, name) in _registered:
        return _registered[group, name]
    found = [one for one in installed_plugins() if (one.group, one.name) == (group, name)]
    if len(found) > 1:
        both = " and ".join(map(str, found))
        raise PluginError(f"{both} both add {name!r}: uninstall one of them")
    return found[0] if found else None
