"""The list of all commands: with their keys and present values, to search, choose and click.

In: a viewer, typed text, keys and clicks. Out: the commands of the mode one is in, called. The bar
opens it below a button with the commands of one theme.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from ...base.language import translated, translated_keys
from ...stage.views.fps import LOOKS, MOVES
from .filtered_panel import FilteredPanel
from .keymap import GESTURES, SECTIONS, WALKING, WALKING_GESTURES, Binding
from .list_panels import Row

if TYPE_CHECKING:
    from .viewer import Viewer

_HINT = "Enter, click: do it   Shift, right click: backwards   Esc: close"
_SHORT_HINT = "click: do it   Esc: close"


class _Entry(NamedTuple):
    """A row of the list, and what it does; gestures and headings do nothing."""

    row: Row
    binding: Binding | None = None


class CommandPanel(FilteredPanel):
    """A list of commands.

    Parameters
    ----------
    viewer : Viewer
    section : str, optional
        The only theme to list; by default all are.
    left : int, optional
        The column of pixels below which the list hangs, as a menu that a click beside it closes.
    """

    title = "Commands"
    hint = _HINT
    corner = "top left"
    most_columns = 72

    def __init__(self, viewer: Viewer, section: str = "", left: int | None = None):
        super().__init__(viewer)
        self.section, self._left = section, left
        self.closes_beside = left is not None
        if section:
            self.title, self.hint = section, _SHORT_HINT
        self.set_filter("")

    def place(self, canvas, width: int, height: int, scale: float) -> tuple[int, int]:
        if self._left is None:
            return super().place(canvas, width, height, scale)
        return max(min(self._left, canvas.width - width), 0), 0

    def heads(self, left_out: int) -> list[str]:
        if not self.section:
            return super().heads(left_out)
        return [translated("filter: {text}_", text=self.filter)] if self.filter else []

    def rows(self) -> list[Row]:
        return [entry.row for entry in self._entries()]

    def choices(self) -> list[int]:
        """Return the numbers of the rows of commands."""
        return [number for number, entry in enumerate(self._entries()) if entry.binding is not None]

    def press(self, number: int, alone: bool) -> None:
        binding = self._entries()[number].binding
        if binding is None:
            return
        self.chosen = number
        if binding.value is None:
            self.close()
        self.viewer.perform(binding.action, -1 if alone else 1)

    def lines(self) -> list[str]:
        """Return the part of the list around the chosen row that fits a terminal."""
        heads, rows = self.heads(0), super().lines()[len(self.heads(0)) : -1]
        room = max(self.viewer.window.text_room[1] - len(heads) - 1, 1)
        first = max(0, min((self.chosen or 0) - room // 2, len(rows) - room))
        marked = [
            ("> " if number == self.chosen else "  ") + row for number, row in enumerate(rows)
        ]
        return [*heads, *marked[first : first + room], translated(self.hint)]

    def _entries(self) -> list[_Entry]:
        """Return the entries that the filter leaves, below the headings of their themes."""
        found: list[_Entry] = []
        for title, entries in self._sections():
            kept = [entry for entry in entries if self._keeps(title, entry.row)]
            if kept and not self.section:
                found.append(_Entry(Row(translated(title), is_title=True)))
            found += kept
        return found

    def _keeps(self, title: str, row: Row) -> bool:
        text = f"{translated(title)} {row.text} {row.key} {row.detail}".casefold()
        return all(word in text for word in self.filter.casefold().split())

    def _sections(self) -> Iterator[tuple[str, list[_Entry]]]:
        walks = self.viewer.walker is not None
        if walks and not self.section:
            yield "Walking", self._walking()
        taken = {self.viewer.window.key_at(key) for key in (*MOVES, *LOOKS)} if walks else set()
        for title, bindings in SECTIONS.items():
            if self.section in ("", title):
                yield title, [self._command(binding, taken) for binding in bindings]
        if not walks and not self.section:
            yield "Mouse", [_moving(key, text) for key, text in GESTURES]

    def _command(self, binding: Binding, taken: set[str]) -> _Entry:
        """Return the entry of a command, with the keys that have no other meaning."""
        value, is_lit = binding.value(self.viewer) if binding.value is not None else ("", False)
        keys = " ".join(translated_keys(key) for key in binding.keys if key not in taken)
        return _Entry(Row(translated(binding.help), value, key=keys, is_lit=is_lit), binding)

    def _walking(self) -> list[_Entry]:
        """Return the keys of walking, as the keyboard's layout names them."""
        key_at = self.viewer.window.key_at
        rows = [(" ".join(map(key_at, positions)), text) for positions, text in WALKING]
        return [_moving(key, text) for key, text in (*rows, *WALKING_GESTURES)]


def _moving(gesture: str, text: str) -> _Entry:
    """Return the entry of what the mouse does, or of keys of walking."""
    return _Entry(Row(translated(text), key=translated(gesture)))
