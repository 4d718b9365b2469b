"""The window with the list of keys, and of what the mouse does.

In: the menus' entries. Out: a table; Esc or F1 closes it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from ....base.command_key import with_command_key
from ....base.language import translated, translated_keys
from .middle import place_large
from .translated_imgui import imgui
from .workspace import Workspace

if TYPE_CHECKING:
    from .menus import Entry

_TITLE = "Keys and mouse"
#: What the mouse does in the scene, and with which keys.
MOUSE = (
    ("Click", "select; with Shift or Ctrl, add to the selection"),
    ("Drag", "select what a rectangle holds"),
    ("Middle button, Alt + left button", "turn the view; with Shift move it, with Ctrl approach"),
    ("Wheel", "approach what is under the pointer"),
    ("Right button", "look around; meanwhile W, A, S, D, Q, E fly, with Shift faster"),
    ("Ctrl while a handle is dragged", "snap, or do not where Snap is on"),
    ("Double click in Hierarchy", "frame the node"),
    ("Drag in Hierarchy", "put a node below another"),
    ("Click on a number; drag it", "type it; change it"),
)

#: What keys do in some parts of the window.
KEYBOARD = (
    ("Up, Down in Hierarchy", "select the row before or after; with Shift, all rows on the way"),
    ("Left, Right in Hierarchy", "close or open a node; go to what is above it or below it"),
    ("Enter in Hierarchy", "go to the properties of the node"),
    (
        "Arrows, PageUp, PageDown in Scene",
        "move, rotate or scale the selection by a step of the tool; with Shift, by a tenth of it",
    ),
    ("Tab, arrows in a panel", "go from field to field; Tab opens a number to type it"),
    ("Enter on a field", "type its number, open its list, press its button, fold its section"),
    ("Esc on a field", "leave it: Space plays again"),
    ("Up, Down in a file dialog", "choose a file or folder; Enter opens it, Alt+Up goes above"),
)


def _of_keys(text: str) -> str:
    """Return a text that may name keys, as this system and the language name them."""
    return with_command_key(translated(text))


class KeysWindow:
    """Shows the keys.

    Parameters
    ----------
    workspace : Workspace
    entries : iterable of Entry
        Of all menus.
    """

    def __init__(self, workspace: Workspace, entries: Iterable[Entry]) -> None:
        self._workspace = workspace
        self._rows = [(entry.keys, entry.label, entry.menu) for entry in entries if entry.keys]
        self._search = ""

    def draw(self) -> None:
        """Lay the window out, if it is open."""
        panels = self._workspace.panels
        if not panels.shows_keys:
            return
        place_large(44, 36)
        flags = imgui.WindowFlags_
        how = flags.no_docking | flags.no_saved_settings | flags.no_collapse
        shown, is_open = imgui.begin(_TITLE, True, how)
        panels.shows_keys = bool(is_open)
        if shown:
            if imgui.is_window_focused() and imgui.is_key_pressed(imgui.Key.escape, False):
                panels.shows_keys = False
            if imgui.is_window_appearing():
                imgui.set_keyboard_focus_here()  # else letters that are typed are commands
            imgui.set_next_item_width(-1.0)
            _, self._search = imgui.input_text_with_hint("##search", "Search", self._search)
            self._draw_rows()
        imgui.end()

    def _shown_rows(self) -> Iterator[tuple[str, str, str]]:
        """Yield keys, what they do and their headings, as they are shown."""
        for keys, text in MOUSE:
            yield _of_keys(keys), _of_keys(text), translated("Mouse")
        for keys, text in KEYBOARD:
            yield _of_keys(keys), _of_keys(text), translated("Keyboard")
        for keys, text, heading in self._rows:
            yield translated_keys(keys), translated(text), translated(heading)

    def _draw_rows(self) -> None:
        flags = imgui.TableFlags_
        if not imgui.begin_table(
            "keys", 2, flags.row_bg | flags.scroll_y | flags.sizing_stretch_prop
        ):
            return
        last = ""
        for keys, text, heading in self._shown_rows():
            if self._search.casefold() not in f"{keys} {text} {heading}".casefold():
                continue
            if heading != last:
                imgui.table_next_row()
                imgui.table_next_column()
                imgui.text_disabled(heading)
                last = heading
            imgui.table_next_row()
            imgui.table_next_column()
            imgui.text_wrapped(keys)
            imgui.table_next_column()
            imgui.text_wrapped(text)
        imgui.end_table()
