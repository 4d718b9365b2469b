"""Keys that belong to a part of the window, and there do not move ImGui's own cursor."""

from __future__ import annotations

from collections.abc import Iterable

from ..translated_imgui import imgui

#: How many rows each key goes on in a list.
STEPS = {"up_arrow": -1, "down_arrow": 1, "page_up": -10, "page_down": 10}
ENTER = ("enter", "keypad_enter")


def own(owner: str, keys: Iterable[str]) -> None:
    """Let keys belong to a part of the current window until the next picture, and while held.

    Parameters
    ----------
    owner : str
        An ID of ImGui's.
    keys : iterable of str
        As ImGui's `Key` names them.
    """
    number = imgui.get_id(owner)
    for key in keys:
        imgui.internal.set_key_owner(getattr(imgui.Key, key), number)


def pressed(key: str, *, again: bool = True) -> bool:
    """Return whether a key was pressed just now, or, ``again``, is held for long enough."""
    return imgui.is_key_pressed(getattr(imgui.Key, key), again)
