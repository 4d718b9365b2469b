"""The groups of entry points: what packages can add, and where the rows that ship stand."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from ...errors import InvalidArgumentError
from ..near_words import meant

#: The contract between engine3d and plug-ins: what docs/plugins.md says of each group. It grows
#: when a plug-in of the new contract would not work with an older engine3d.
API = 1
_PREFIX = "engine3d."


class Group(NamedTuple):
    """A row of the table of groups.

    Attributes
    ----------
    name : str
        The group's name without ``engine3d.``.
    names : str
        What the name of an entry point is.
    value : str
        What a plug-in's value must be.
    takes : callable
        Whether a value is that.
    home : str
        The module whose ``shipped_names()`` are taken: a plug-in cannot replace what ships.
    """

    name: str
    names: str
    value: str
    takes: Callable[[Any], bool]
    home: str

    @property
    def entry_points(self) -> str:
        """The name of the group in the metadata of packages."""
        return _PREFIX + self.name

    def allows(self, name: str) -> bool:
        """Return whether a name can be asked for: files' extensions are compared in lower case."""
        plain = name.isprintable() and name == name.strip().removeprefix(".")
        of_files = name == name.lower() and not set(name) & {"/", "\\"}
        return bool(name) and plain and (of_files or self.names != _EXTENSION)

    def shipped_names(self) -> set[str]:
        """Return the names that engine3d itself has."""
        names: set[str] = import_module(f"engine3d.{self.home}").shipped_names()
        return names


def _is_writer(value: Any) -> bool:
    kind = import_module("engine3d.apps.datasets.writer").DatasetWriter
    return isinstance(value, type) and issubclass(value, kind)


def _is_look(value: Any) -> bool:
    return isinstance(value, import_module("engine3d.stage.look").Look)


_EXTENSION, _FUNCTION = "the extension of a file in lower case,", "a function"
GROUPS = {
    group.name: group
    for group in (
        Group("readers", _EXTENSION, _FUNCTION, callable, "io.reading.reader_registry"),
        Group("writers", _EXTENSION, _FUNCTION, callable, "io.writing.writer_registry"),
        Group("datasets", "a kind", "a DatasetWriter", _is_writer, "apps.datasets.kinds"),
        Group("commands", "a command", _FUNCTION, callable, "apps.cli.commands"),
        Group("scenes", "a named scene", _FUNCTION, callable, "apps.scenes"),
        Group("looks", "a look", "a Look", _is_look, "stage.look"),
    )
}


def group_named(name: str) -> Group:
    """Return a group by its name, with or without ``engine3d.``.

    Raises
    ------
    InvalidArgumentError
    """
    short = name.removeprefix(_PREFIX)
    if short not in GROUPS:
        known = ", ".join(GROUPS)
        raise InvalidArgumentError(
            f"group must be one of {known}, not {name!r}{meant(short, GROUPS)}"
        )
    return GROUPS[short]


def group_of(entry_points: str) -> Group | None:
    """Return the group of entry points with this name in a package's metadata, or None."""
    return GROUPS.get(entry_points.removeprefix(_PREFIX)) if _PREFIX in entry_points else None
