"""The console panel: the log with filters, and a Python prompt.

In: the document's console and prompt. Out: lines to run. Only visible rows are laid out.
"""

from __future__ import annotations

from ....base.language import translated
from ..console import LEVELS
from .panel_layout import begin_panel
from .translated_imgui import imgui
from .workspace import Workspace

_COLORS = {
    "action": (0.55, 0.65, 0.75, 1.0),
    "message": (0.9, 0.9, 0.9, 1.0),
    "warning": (1.0, 0.8, 0.3, 1.0),
    "error": (1.0, 0.45, 0.4, 1.0),
    "input": (0.5, 0.85, 0.6, 1.0),
    "output": (0.8, 0.8, 0.8, 1.0),
}


class ConsolePanel:
    """Shows the log, and accepts lines of Python.

    Parameters
    ----------
    workspace : Workspace
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._hidden: set[str] = set()
        self._search = ""
        self._line = ""
        self._back = 0
        self._version = -1
        self._focuses = False

    def draw(self) -> None:
        """Lay the panel out."""
        shown = begin_panel("Console")
        if shown:
            self._draw_head()
            height = -imgui.get_frame_height_with_spacing()
            if imgui.begin_child("log", (0.0, height)):
                self._draw_log()
            imgui.end_child()
            self._draw_prompt()
        imgui.end()

    def _draw_head(self) -> None:
        if imgui.button("Clear"):
            self._workspace.document.console.clear()
        for level in LEVELS:
            imgui.same_line()
            _, shown = imgui.checkbox(level.capitalize(), level not in self._hidden)
            (self._hidden.discard if shown else self._hidden.add)(level)
        imgui.same_line()
        imgui.set_next_item_width(-1.0)
        _, self._search = imgui.input_text_with_hint("##search", "Filter", self._search)

    def _draw_log(self) -> None:
        console = self._workspace.document.console
        levels = [level for level in LEVELS if level not in self._hidden]
        entries = console.filtered(levels, self._search)
        clipper = imgui.ListClipper()
        clipper.begin(len(entries), imgui.get_text_line_height_with_spacing())
        while clipper.step():
            for entry in entries[clipper.display_start : clipper.display_end]:
                imgui.push_style_color(imgui.Col_.text, _COLORS[entry.level])
                imgui.text_unformatted(entry.text)
                imgui.pop_style_color()
        if console.version != self._version:
            self._version = console.version
            imgui.set_scroll_here_y(1.0)

    def _draw_prompt(self) -> None:
        prompt = self._workspace.document.prompt
        imgui.text("..." if prompt.is_open else ">>>")
        imgui.same_line()
        imgui.set_next_item_width(-1.0)
        if self._focuses:
            imgui.set_keyboard_focus_here()
            self._focuses = False
        flags = imgui.InputTextFlags_
        chosen = flags.enter_returns_true | flags.callback_history | flags.callback_completion
        entered, line = imgui.input_text("##prompt", self._line, chosen, self._edit)
        self._line = line
        if prompt.is_open and imgui.is_item_focused() and imgui.is_key_pressed(imgui.Key.escape):
            prompt.reset()
            self._workspace.console.write(
                "message", translated("the lines of the prompt are given up")
            )
        if entered:
            self._line, self._back = "", 0
            self._focuses = True
            self._workspace.hold_keys()
            self._workspace.lines_to_run.append(line)

    def _edit(self, data) -> int:
        """Replace the text by an earlier line or a completion."""
        prompt = self._workspace.document.prompt
        text = data.buf
        if data.event_flag == imgui.InputTextFlags_.callback_history:
            step = 1 if data.event_key == imgui.Key.up_arrow else -1
            self._back = min(max(self._back + step, 0), len(prompt.lines))
            text = prompt.lines[-self._back] if self._back else ""
        elif data.event_flag == imgui.InputTextFlags_.callback_completion:
            start = max(text.rfind(mark) for mark in " ([{,=+-*/") + 1
            found = prompt.completions(text[start:])
            if len(found) == 1:
                text = text[:start] + found[0]
            elif found:
                self._workspace.document.console.write("output", "  ".join(found[:40]))
        if text != data.buf:
            data.delete_chars(0, data.buf_text_len)
            data.insert_chars(0, text)
        return 0
