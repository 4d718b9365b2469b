"""Windows in the middle of the editor's window: dialogs, and others."""

from __future__ import annotations

from .translated_imgui import imgui


def place_in_middle(when: imgui.Cond_ = imgui.Cond_.appearing) -> None:
    """Place the next window in the middle: as it appears, or always."""
    middle = imgui.get_main_viewport().get_center()
    imgui.set_next_window_pos(middle, when, (0.5, 0.5))


def begin_dialog(title: str, when: imgui.Cond_ = imgui.Cond_.appearing) -> bool:
    """Begin a dialog in the middle, as large as its content; return whether it is open."""
    place_in_middle(when)
    return bool(imgui.begin_popup_modal(title, None, imgui.WindowFlags_.always_auto_resize)[0])


def place_large(wide: float, high: float) -> None:
    """Place the next window in the middle as it appears, so many letters large if there is room."""
    place_in_middle()
    letter, room = imgui.get_font_size(), imgui.get_main_viewport().size
    size = min(wide * letter, 0.9 * room.x), min(high * letter, 0.8 * room.y)
    imgui.set_next_window_size(size, imgui.Cond_.appearing)
