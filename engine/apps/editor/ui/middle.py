"""Windows in the middle of the editor's window: dialogs, and others."""

from __future__ import annotations

from ....base.language import translated
from .translated_imgui import imgui


def place_in_middle(when: imgui.Cond_ = imgui.Cond_.appearing) -> None:
    """Place the next window in the middle: as it appears, or always."""
    middle = imgui.get_main_viewport().get_center()
    imgui.set_next_window_pos(middle, when, (0.5, 0.5))


def begin_dialog(title: str, when: imgui.Cond_ = imgui.Cond_.appearing) -> bool:
    """Begin a dialog in the middle, as large as its content; return whether it is open."""
    place_in_middle(when)
    return bool(imgui.begin_popup_modal(title, None, imgui.WindowFlags_.always_auto_resize)[0])


def label_before(text: str, letters: float) -> None:
    """Lay out a label at the left of a row, and begin the next item a number of letters on."""
    start = imgui.get_cursor_pos_x()
    imgui.align_text_to_frame_padding()
    imgui.text_unformatted(translated(text))
    imgui.same_line(start + letters * imgui.get_font_size())
