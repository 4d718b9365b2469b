"""The window of scenes to start from, and of files opened lately.

In: the user's choice. Out: the workspace's document. It does not stand in the way: whatever else
one does, it goes.
"""

from __future__ import annotations

import os

from ....base.language import translated
from ....errors import printable
from ..new_things.starts import STARTS
from .files import Files
from .middle import place_in_middle
from .translated_imgui import imgui
from .workspace import Workspace

_TITLE = "Start"
#: The files that are listed.
MOST_FILES = 6
_WIDTH = 26  # letters


class StartChooser:
    """Offers scenes to start from.

    Parameters
    ----------
    workspace : Workspace
    files : Files
        Asks before anything is lost.
    """

    def __init__(self, workspace: Workspace, files: Files) -> None:
        self._workspace, self._files = workspace, files
        self._recent: tuple[str, ...] = ()
        self._was_open = False

    def draw(self) -> None:
        """Lay the window out, if it is open."""
        panels = self._workspace.panels
        if self._workspace.document.is_modified:
            panels.offers_start = False
        if not panels.offers_start:
            self._was_open = False
            return
        if not self._was_open:
            self._recent, self._was_open = self._workspace.recent.paths()[:MOST_FILES], True
        place_in_middle(imgui.Cond_.always)
        flags = imgui.WindowFlags_
        how = flags.no_docking | flags.no_saved_settings | flags.no_collapse | flags.no_move
        shown, is_open = imgui.begin(_TITLE, True, how | flags.always_auto_resize)
        panels.offers_start = bool(is_open)
        if shown:
            self._draw_content()
        imgui.end()

    def _draw_content(self) -> None:
        panels = self._workspace.panels
        asks = imgui.is_popup_open("", imgui.PopupFlags_.any_popup)
        leaves = not imgui.is_window_focused() and not imgui.is_window_appearing() and not asks
        if leaves and imgui.is_mouse_clicked(0):
            panels.offers_start = False
        if imgui.is_key_pressed(imgui.Key.escape, False):
            panels.offers_start = False
        if imgui.is_window_appearing():
            imgui.set_nav_cursor_visible(True)  # otherwise Enter works only after an arrow key
        size = imgui.get_font_size() * _WIDTH, 0.0
        for start in STARTS:
            said = translated(
                "{title}: {hint}", title=translated(start.title), hint=translated(start.hint)
            )
            if imgui.button(f"{said}###{start.title}", size):
                panels.offers_start = False
                self._workspace.start(start)
            if start is STARTS[0]:
                imgui.set_item_default_focus()
        if imgui.button("Open a file ...", size):
            panels.offers_start = False
            self._files.open()
        if self._recent:
            imgui.separator_text("Opened lately")
        for path in self._recent:
            if imgui.selectable(f"{printable(os.path.basename(path))}##{path}", False)[0]:
                panels.offers_start = False
                self._workspace.open(path)
            imgui.set_item_tooltip(printable(path))
        imgui.text_disabled("F1 lists the keys; Esc closes this.")
