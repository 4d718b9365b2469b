"""Passes user input to Dear ImGui, and ImGui's requests to the window.

In: events (`engine3d.events`). Out: ImGui's input; the pointer's shape, the clipboard.
"""

from __future__ import annotations

from imgui_bundle import imgui

from ....base.command_key import has_cmd
from ... import events
from ...viewer.window import Window

_BUTTONS = {"left": 0, "right": 1, "middle": 2}
_NAMES = {
    "Return": "enter",
    "Keypad Enter": "keypad_enter",
    "Left": "left_arrow",
    "Right": "right_arrow",
    "Up": "up_arrow",
    "Down": "down_arrow",
    "PageUp": "page_up",
    "PageDown": "page_down",
    "CapsLock": "caps_lock",
    "'": "apostrophe",
    ",": "comma",
    "-": "minus",
    ".": "period",
    "/": "slash",
    ";": "semicolon",
    "=": "equal",
    "+": "equal",
    "[": "left_bracket",
    "\\": "backslash",
    "]": "right_bracket",
    "`": "grave_accent",
    "Keypad .": "keypad_decimal",
    "Keypad /": "keypad_divide",
    "Keypad *": "keypad_multiply",
    "Keypad -": "keypad_subtract",
    "Keypad +": "keypad_add",
}
_DIGITS = tuple("0123456789")
_SAME = ("Space", "Escape", "Tab", "Backspace", "Insert", "Delete", "Home", "End")
_MODIFIERS = {
    "Left Ctrl": ("left_ctrl", "mod_ctrl"),
    "Right Ctrl": ("right_ctrl", "mod_ctrl"),
    "Left Shift": ("left_shift", "mod_shift"),
    "Right Shift": ("right_shift", "mod_shift"),
    "Left Alt": ("left_alt", "mod_alt"),
    "Right Alt": ("right_alt", "mod_alt"),
}
# ImGui, as it behaves on macOS, takes Cmd (its "super") for Ctrl, and Ctrl for Cmd. Both are Ctrl
# here, since the system takes some keys with Cmd.
_OF_MACOS = {
    "Left GUI": ("left_super", "mod_super"),
    "Right GUI": ("right_super", "mod_super"),
    "Left Ctrl": ("left_super", "mod_super"),
    "Right Ctrl": ("right_super", "mod_super"),
}


def _modifiers() -> dict[str, tuple[str, str]]:
    """Return ImGui's names of modifier keys by our positions: of the key, and of what it does."""
    return _MODIFIERS | _OF_MACOS if has_cmd() else _MODIFIERS


def _keys() -> dict[str, imgui.Key]:
    """Return ImGui's keys by our key names."""
    names = dict(_NAMES)
    names.update({name: name.lower() for name in _SAME})
    names.update({letter: letter.lower() for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ"})
    names.update({digit: f"_{digit}" for digit in _DIGITS})
    names.update({f"Keypad {digit}": f"keypad{digit}" for digit in _DIGITS})
    names.update({f"F{number}": f"f{number}" for number in range(1, 13)})
    names.update({name: key for name, (key, _) in _modifiers().items()})
    return {name: getattr(imgui.Key, key) for name, key in names.items()}


class ImguiInput:
    """Feeds the current ImGui context from a window.

    Parameters
    ----------
    window : Window
    """

    def __init__(self, window: Window) -> None:
        self._window = window
        self._modifiers, self._keys = _modifiers(), _keys()
        self._control = getattr(imgui.Key, self._modifiers["Left Ctrl"][1])
        imgui.get_io().config_mac_osx_behaviors = has_cmd()
        self._pointer = ""
        shapes = imgui.MouseCursor_
        self._shapes = {
            int(shapes.none): None,
            int(shapes.text_input): "text",
            int(shapes.resize_all): "size_all",
            int(shapes.resize_ns): "size_ns",
            int(shapes.resize_ew): "size_we",
            int(shapes.resize_nesw): "size_nesw",
            int(shapes.resize_nwse): "size_nwse",
            int(shapes.hand): "hand",
            int(shapes.wait): "wait",
            int(shapes.progress): "working",
            int(shapes.not_allowed): "no",
        }
        imgui.get_io().backend_flags |= imgui.BackendFlags_.has_mouse_cursors
        platform = imgui.get_platform_io()
        platform.platform_get_clipboard_text_fn = lambda context: window.clipboard
        platform.platform_set_clipboard_text_fn = self._copy

    def _copy(self, context, text: str) -> None:
        self._window.clipboard = text

    def feed(self, event) -> None:
        """Pass one event to ImGui."""
        io = imgui.get_io()
        if isinstance(event, events.MouseMotion):
            io.add_mouse_pos_event(event.x, event.y)
        elif isinstance(event, events.MouseButton):
            io.add_mouse_pos_event(event.x, event.y)
            io.add_mouse_button_event(_BUTTONS[event.button], event.down)
        elif isinstance(event, events.Wheel):
            io.add_mouse_wheel_event(0.0, event.steps)
        elif isinstance(event, events.MouseLeft):
            if not any(imgui.is_mouse_down(button) for button in _BUTTONS.values()):
                io.add_mouse_pos_event(-1e30, -1e30)
        elif isinstance(event, events.TextEntered):
            io.add_input_characters_utf8(event.text)
        elif isinstance(event, events.KeyDown | events.KeyUp):
            self._feed_key(io, event, isinstance(event, events.KeyDown))
        elif isinstance(event, events.FocusLost):
            io.add_focus_event(False)

    def _feed_key(self, io, event, down: bool) -> None:
        if isinstance(event, events.KeyDown):  # this event also reports keys pressed elsewhere
            io.add_key_event(self._control, event.control)
            io.add_key_event(imgui.Key.mod_shift, event.shift)
        if event.position in self._modifiers:
            io.add_key_event(getattr(imgui.Key, self._modifiers[event.position][1]), down)
        # The row of digits counts by its places: on AZERTY, it types "&é'(-" and so on.
        is_digit = event.position in _DIGITS
        key = None if is_digit else self._keys.get(event.key)
        key = key or self._keys.get(event.position)
        if key is not None:
            io.add_key_event(key, down)

    def follow_pointer(self) -> None:
        """Set the pointer shape that ImGui requests."""
        shape = self._shapes.get(int(imgui.get_mouse_cursor()), "arrow")
        if shape != self._pointer:
            self._window.show_pointer(shape)
            self._pointer = shape


def of_one_picture(happened: list, holds: bool = False) -> tuple[list, list]:
    """Split events into those for this picture and those for the next one.

    ImGui only knows the state of Ctrl, Shift and Alt at the end of its input: a modifier released
    right after a key press would not count for that key. Named keys, such as Return, may move the
    focus to another field, which gets the following input; so may a letter that chooses a tool.

    Parameters
    ----------
    happened : list
    holds : bool
        Whether what is typed waits.
    """
    pressed, modifiers = False, _modifiers()
    for number, event in enumerate(happened):
        if holds and isinstance(event, events.KeyDown | events.TextEntered):
            return happened[:number], happened[number:]
        if isinstance(event, events.KeyDown | events.KeyUp):
            modifies = event.position in modifiers
            if modifies and pressed:
                return happened[:number], happened[number:]
            if isinstance(event, events.KeyDown) and not modifies:
                if pressed and len(event.key) > 1:
                    return happened[:number], happened[number:]
                pressed = True
                if len(event.key) > 1:
                    return happened[: number + 1], happened[number + 1 :]
    return happened, []
