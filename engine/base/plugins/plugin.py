"""A plug-in: one name that a package adds, and the value behind it.

In: an entry point. Out: its value, imported on first use and checked for the contract. Every error
names the package, its version, the entry point and its group.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ...errors import Engine3DError, PluginError, printable
from ..memory import NEEDS_MORE, is_lack_of_memory
from .groups import API, GROUPS
from .participants import took_part

# Characters of another package's message that are passed on.
_SAID = 300


class Plugin:
    """One name that a package, or a program by `register`, adds to engine3d.

    Attributes
    ----------
    group : str
        ``"readers"``, ``"writers"``, ``"datasets"``, ``"commands"``, ``"scenes"`` or ``"looks"``.
    name : str
        The entry point's name: an extension without a dot, a kind, a command, a scene, a look.
    package : str
        The name of the distribution; empty for what the program itself registered.
    version : str
        Its version.
    about : str
        The summary of the distribution, in a line.
    """

    def __init__(
        self,
        group: str,
        name: str,
        value: Callable[[], Any],
        package: str = "",
        version: str = "",
        about: str = "",
    ) -> None:
        self.group, self.name = group, name
        self.package, self.version, self.about = package, version, about
        self._import = value
        self._kept: list[Any] = []

    @property
    def origin(self) -> str:
        """The package and its version, for listings."""
        return f"{self.package} {self.version}" if self.package else "this program"

    @property
    def stamp(self) -> list[str]:
        """What tells whether a result would be made by the same plug-in again, in JSON's types."""
        return [self.group, self.name, self.package, self.version]

    def __str__(self) -> str:
        where = f"{self.name!r} of {GROUPS[self.group].entry_points}"
        return printable(
            f"{self.package} {self.version} (entry point {where})"
            if self.package
            else f"the program's plug-in {where}"
        )

    def __repr__(self) -> str:
        return f"<Plugin {self}>"

    def load(self) -> Any:
        """Return the value, imported the first time.

        Raises
        ------
        PluginError
            It cannot be imported, is not what its group takes, or demands a newer contract than
            this engine3d knows.
        """
        if not self._kept:
            try:
                value = self._import()
            except (Exception, SystemExit) as error:  # whatever a foreign module does at import
                raise fault(self, f"could not be imported: {told(error)}") from error
            self._check(value)
            self._kept.append(value)
        return self._kept[0]

    def use(self) -> Any:
        """Return the value as `load` does, and tell that the plug-in takes part."""
        value = self.load()
        took_part(self)
        return value

    @contextmanager
    def named_in_errors(self, *passing: type[BaseException]) -> Iterator[None]:
        """Name the plug-in in errors within the block.

        Errors of engine3d pass, which plug-ins raise on purpose, and those that the caller handles.
        `SystemExit` does not: no plug-in ends the program that uses it.
        """
        allowed: tuple[type[BaseException], ...] = (Engine3DError, *passing)
        try:
            yield
        except allowed:
            raise
        except (Exception, SystemExit) as error:
            lacks_memory = is_lack_of_memory(error)
            said = NEEDS_MORE if lacks_memory else f"raised {told(error)}{_place_of(error)}"
            raise fault(self, said) from error

    def _check(self, value: Any) -> None:
        """Raise unless a value is what the group takes, by a contract that is known."""
        group = GROUPS[self.group]
        if not group.takes(value):
            raise fault(self, f"must be {group.value}, not {type(value).__name__}")
        needed = getattr(value, "engine3d_api", 1)
        if type(needed) is not int or needed < 1:
            raise fault(self, f"says engine3d_api = {needed!r:.40}, which is no contract's number")
        if needed > API:
            raise fault(
                self,
                f"needs the contract {needed} of plug-ins, but this engine3d knows those up to "
                f"{API}: install a newer engine3d",
            )


def fault(plugin: Plugin, what: str) -> PluginError:
    """Return the error to raise where a plug-in breaks the contract of its group."""
    return PluginError(f"{plugin} {what}")


def told(error: BaseException) -> str:
    """Return another package's exception as one line."""
    try:
        said = printable(" ".join(str(error).split())[:_SAID])
    except Exception:  # of a foreign __str__
        said = ""
    if isinstance(error, ImportError) and said:
        return said
    return f"{type(error).__name__}: {said}" if said else type(error).__name__


def _place_of(error: BaseException) -> str:
    """Return the file and line that raised an error, for a message."""
    import traceback  # here, because it takes milliseconds

    frames = traceback.extract_tb(error.__traceback__)
    return f" ({os.path.basename(frames[-1].filename)}:{frames[-1].lineno})" if frames else ""
