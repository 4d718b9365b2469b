"""The search for a command by its name.

In: the entries of all menus, and what there is to add. Out: the chosen action.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

from .....base.language import translated, translated_keys
from ...new_things.adding import GROUPS
from ..selection_actions import add
from ..workspace import PANELS, Workspace
from .list_dialog import ListDialog, Option

if TYPE_CHECKING:
    from ..menus import Entry


class CommandSearch:
    """Finds commands.

    Parameters
    ----------
    workspace : Workspace

    Attributes
    ----------
    entries : sequence of Entry
        Of all menus.
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._dialog = ListDialog("Find a command")
        self.entries: Sequence[Entry] = ()

    def open(self) -> None:
        """Ask for a command."""
        self._workspace.hold_keys()
        self._dialog.ask(list(self._options()))

    def draw(self) -> None:
        """Lay the search out, if it is open."""
        self._dialog.draw()

    def _options(self) -> Iterator[Option]:
        workspace = self._workspace
        for entry in self.entries:
            if entry.is_enabled() and entry.act != self.open:
                name = translated(entry.label) if entry.says is None else entry.says()
                keys = f"  {translated_keys(entry.keys)}" if entry.keys else ""
                yield Option(name, entry.act, translated(entry.menu) + keys)
        for name in (title for titles in GROUPS for title in titles):
            said = translated("Add {name}", name=translated(name).lower())
            yield Option(said, partial(add, workspace, name), translated("Add"))
        for name in PANELS:
            said = translated("Go to {panel}", panel=translated(name))
            yield Option(said, partial(workspace.go_to, name), translated("Window"))
