"""Converts a terminal's input to events: keys, mouse, focus.

In: untrusted bytes: unknown or overlong sequences are skipped. Out: values of `engine3d.events`.
Terminals report key presses but no releases, which terminal_window.py infers after a delay. The
codes are those of xterm's "Control Sequences".
"""

from __future__ import annotations

import re
import time

from ..events import (
    CloseRequested,
    FocusLost,
    KeyDown,
    MouseButton,
    MouseMotion,
    TextEntered,
    Wheel,
)

_SEQUENCE = re.compile(
    rb"\x1b\[<(?P<button>\d{1,4});(?P<x>-?\d{1,6});(?P<y>-?\d{1,6})(?P<end>[Mm])"
    rb"|\x1b\[(?P<numbers>[0-9;]{0,16})(?P<letter>[A-Za-z~])"
    rb"|\x1bO(?P<function>[A-Z])"
    rb"|\x1b_[^\x1b]*\x1b\\"  # a late answer
    rb"|\x1b\[[ -?]*[@-~]"  # any other sequence
)
#: The start of a possible sequence.
_BEGUN = re.compile(rb"\x1b(\[[ -?]*|O|_[^\x1b]*\x1b?)?\Z")
_TAIL = re.compile(rb"[ -?]*(?P<end>[@-~])?")
#: Of longer sequences, only the start is kept.
_LONGEST = 4096
_LETTERS = {b"A": "Up", b"B": "Down", b"C": "Right", b"D": "Left", b"H": "Home", b"F": "End"}
_FUNCTIONS = {b"P": "F1", b"Q": "F2", b"R": "F3", b"S": "F4"}
_NUMBERS = {
    1: "Home",
    2: "Insert",
    3: "Delete",
    4: "End",
    5: "PageUp",
    6: "PageDown",
    **{number: f"F{key}" for key, number in enumerate((15, 17, 18, 19, 20, 21, 23, 24), 5)},
}
_BYTES = {
    0x0D: "Return",
    0x09: "Tab",
    0x1B: "Escape",
    0x7F: "Backspace",
    0x08: "Backspace",
    0x20: "Space",
}
_BUTTONS = ("left", "middle", "right")
_CONTROL_C = 0x03
#: Limits of a double click, in seconds and in pixels.
_AGAIN_SECONDS, _AGAIN_PIXELS = 0.4, 12
# Bits of the mouse's number.
_SHIFT, _CONTROL, _MOVES, _WHEEL = 4, 16, 32, 64


class Decoder:
    """Converts bytes to events, in arbitrary pieces.

    Parameters
    ----------
    place : callable
        Returns the pixel of the picture for what the terminal tells of the mouse's place, from 1.
    """

    def __init__(self, place) -> None:
        self._place = place
        self._rest = b""
        self._is_inside = False  # inside a discarded sequence
        self._mouse: tuple[int, int] | None = None
        self._click = (0.0, (0, 0), 0)

    @property
    def waits(self) -> bool:
        """Whether a started sequence may be a lone Escape key."""
        return bool(self._rest)

    def decode(self, data: bytes, *, ended: bool = False) -> list:
        """Return the events of some bytes; ``ended`` means that Escape was a key."""
        data, self._rest = self._rest + self._after_sequence(data), b""
        happened: list = []
        place = 0
        while place < len(data):
            if data[place] != 0x1B:
                place += self._plain(data, place, happened)
            elif match := _SEQUENCE.match(data, place):
                happened += self._sequence(match)
                place = match.end()
            elif _BEGUN.match(data, place) and self._waits_for(data[place:], ended):
                break
            else:
                happened += _pressed("Escape")
                place += 1
        return happened

    def _waits_for(self, begun: bytes, ended: bool) -> bool:
        """Keep the start of a sequence, unless it was an Escape key with later input."""
        if ended and len(begun) < 3:
            return False
        self._is_inside = ended and begun.startswith(b"\x1b[")
        if not ended:
            self._rest = begun if len(begun) <= _LONGEST else begun[:2]
        return True

    def _after_sequence(self, data: bytes) -> bytes:
        """Skip the rest of a discarded sequence: its digits are no keys."""
        if not (self._is_inside and data):
            return data
        rest = _TAIL.match(data)
        self._is_inside = rest.end() == len(data) and rest["end"] is None
        return data[rest.end() :]

    def _plain(self, data: bytes, place: int, happened: list) -> int:
        """Handle a byte or a multi-byte character; return its number of bytes."""
        first = data[place]
        if first == _CONTROL_C:
            happened.append(CloseRequested())
        elif first in _BYTES:
            happened += _pressed(_BYTES[first])
            if first == 0x20:
                happened.append(TextEntered(" "))
        elif first < 0x20:
            happened += _pressed(chr(first + 0x40), control=True)
        else:
            size = 1 + (first >= 0xC0) + (first >= 0xE0) + (first >= 0xF0)
            text = data[place : place + size].decode("utf-8", "replace")
            happened += _pressed(text.upper(), shift=text.isupper())
            happened.append(TextEntered(text))
            return size
        return 1

    def _sequence(self, match: re.Match) -> list:
        if match["button"] is not None:
            return self._mouse_event(match)
        if match["function"] is not None:
            name = _FUNCTIONS.get(match["function"]) or _LETTERS.get(match["function"])
            return _pressed(name) if name else []
        if match["letter"] is None:
            return []
        return _key(match["letter"], [int(number or 0) for number in match["numbers"].split(b";")])

    def _mouse_event(self, match: re.Match) -> list:
        number, down = int(match["button"]), match["end"] == b"M"
        x, y = self._place(int(match["x"]), int(match["y"]))
        before, self._mouse = self._mouse or (x, y), (x, y)
        if number & _WHEEL:
            return [Wheel(1.0 if number & 1 == 0 else -1.0, x, y)] if number & 2 == 0 else []
        if number & _MOVES:
            return [MouseMotion(x - before[0], y - before[1], x, y)]
        if number & 3 == 3:
            return []
        shift, control = bool(number & _SHIFT), bool(number & _CONTROL)
        button = _BUTTONS[number & 3]
        return [MouseButton(button, down, shift, control, x, y, self._clicks(down, x, y))]

    def _clicks(self, down: bool, x: int, y: int) -> int:
        """Return the number of the click in a row of clicks."""
        seconds, (left, top), count = self._click
        if down:
            now = time.monotonic()
            near = abs(x - left) + abs(y - top) <= _AGAIN_PIXELS
            count = count + 1 if near and now - seconds <= _AGAIN_SECONDS else 1
            self._click = now, (x, y), count
        return max(count, 1)


def _pressed(key: str, *, shift: bool = False, control: bool = False) -> list:
    return [KeyDown(key, key, shift, control)]


def _key(letter: bytes, numbers: list[int]) -> list:
    """Return the key of a sequence that ends in a letter; its second number holds modifiers."""
    if letter == b"O":
        return [FocusLost()]
    if letter == b"Z":
        return _pressed("Tab", shift=True)
    names = {**_LETTERS, **_FUNCTIONS}
    name = _NUMBERS.get(numbers[0]) if letter == b"~" else names.get(letter)
    modifiers = max(numbers[1] - 1, 0) if len(numbers) > 1 else 0
    return _pressed(name, shift=bool(modifiers & 1), control=bool(modifiers & 4)) if name else []
