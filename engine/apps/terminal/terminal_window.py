"""A terminal as a window for the viewer: it shows pictures and reads keys.

In: pictures. Out: events, and bytes for the terminal. It implements what the viewer needs of a
`engine3d.Window`; the terminal's last line is its title bar.
"""

from __future__ import annotations

import signal
import threading
import time

import numpy as np

from ..events import FocusLost, KeyDown, KeyUp, Resized
from . import half_blocks, kitty, sixel
from .device import Answers, Device
from .keys import Decoder

#: A key counts as held for this long after its last repetition.
HELD_SECONDS = 0.6
#: A sequence that begins with Escape arrives within this time.
ESCAPE_SECONDS = 0.05
#: Larger pictures would take too long to send; the terminal enlarges them or leaves a margin.
LARGEST = {"kitty": (1280, 960), "sixel": (640, 480)}
_PICTURE = 1
# Alternate screen, no cursor, no wrapping; mouse with all motions, in SGR form; focus.
_ENTER = b"\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[?1003h\x1b[?1006h\x1b[?1004h\x1b[2J"
_PIXEL_MOUSE = b"\x1b[?1016h"
_LEAVE = b"\x1b[?1016l\x1b[?1004l\x1b[?1006l\x1b[?1003l\x1b[?7h\x1b[?25h\x1b[?1049l"


class TerminalWindow:
    """Shows pictures in the terminal until it is closed.

    Raises
    ------
    DisplayError
        There is no terminal.
    """

    scale = 1
    minimised = False

    def __init__(self) -> None:
        self._device = Device()
        try:
            self.answers = self._device.ask()
        except BaseException:
            self._device.close()
            raise
        self._device.write(_ENTER + (_PIXEL_MOUSE if self.answers.pixel_mouse else b""))
        self._decoder = Decoder(self._place)
        self._held: dict[str, float] = {}
        self._title = ""
        self._resized = False
        self._closed = False
        self._before = None
        if threading.current_thread() is threading.main_thread():
            self._before = signal.signal(signal.SIGWINCH, self._size_changed)

    def __enter__(self) -> TerminalWindow:
        return self

    def __exit__(self, *exception) -> None:
        self.close()

    def close(self) -> None:
        """Restore the terminal; may be called twice."""
        if self._closed:
            return
        self._closed = True
        if self._before is not None:
            signal.signal(signal.SIGWINCH, self._before)
        try:
            gone = kitty.delete(_PICTURE) if self.answers.graphics == "kitty" else b""
            self._device.write(gone + _LEAVE)
        finally:
            self._device.close()

    # Pictures

    @property
    def writes_text(self) -> bool:
        """Whether text is written beside the picture, whose pixels are too large for letters."""
        return self.answers.graphics == "blocks"

    @property
    def text_room(self) -> tuple[int, int]:
        """Columns and rows of text that fit over the picture."""
        columns, rows = self._room()
        return max(columns - 2, 1), max(rows - 3, 1)

    @property
    def cells(self) -> tuple[int, int]:
        """Columns and rows of the whole terminal."""
        return self._device.cells()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels of the picture for the terminal."""
        return picture_size(self.answers, self._room())

    def _room(self) -> tuple[int, int]:
        """Return columns and rows of the picture: the last row is the title's."""
        columns, rows = self._device.cells()
        return columns, rows - 1

    def present(self, pixels: np.ndarray) -> None:
        """Show (H, W, 4) uint8 pixels."""
        picture = encoded(pixels, self.answers, self._room(), _PICTURE)
        self._device.write(b"\x1b[H" + picture)

    def write(self, lines: list[str]) -> None:
        """Write lines over the picture's lower left corner."""
        _, rows = self._room()
        lines = lines[-rows:]
        first = rows - len(lines) + 1
        text = [f"\x1b[{first + n};1H\x1b[7m {line} \x1b[0m" for n, line in enumerate(lines)]
        self._device.write("".join(text).encode("utf-8", "replace"))

    def show_lines(self, lines: list[str]) -> None:
        """Show lines of text, with their codes of colours, in place of a picture."""
        rows = [f"\x1b[{number};1H\x1b[2K{line}\x1b[0m" for number, line in enumerate(lines, 1)]
        self._device.write("".join(rows).encode("utf-8", "replace"))

    @property
    def title(self) -> str:
        """The text in the last line."""
        return self._title

    @title.setter
    def title(self, title: str) -> None:
        self._title = title
        columns, rows = self._device.cells()
        line = title[: columns - 1].ljust(columns - 1)
        self._device.write(f"\x1b[{rows};1H\x1b[0m{line}".encode("utf-8", "replace"))

    # Events

    def events(self, timeout: float = 0.0) -> list:
        """Return the events that are waiting; if there are none, wait up to ``timeout`` seconds."""
        happened = self._come_up()
        if self._resized:
            self._resized = False
            self._device.write(b"\x1b[2J")
            self.title = self._title
            happened.append(Resized(*self.size))
        if self._held:
            timeout = min(timeout, max(min(self._held.values()) - time.monotonic(), 0.0))
        happened += self._decoder.decode(self._device.read(0.0 if happened else timeout))
        if self._decoder.waits:
            happened += self._decoder.decode(self._device.read(ESCAPE_SECONDS), ended=True)
        return self._hold(happened)

    def _come_up(self) -> list:
        """Return events for keys that the terminal no longer repeats."""
        now = time.monotonic()
        up = [position for position, until in self._held.items() if until <= now]
        for position in up:
            del self._held[position]
        return [KeyUp(position, position) for position in up]

    def _hold(self, happened: list) -> list:
        """Track held keys; a key that is held already is repeated."""
        until = time.monotonic() + HELD_SECONDS
        followed = []
        for event in happened:
            if isinstance(event, KeyDown):
                repeat = event.position in self._held
                event = KeyDown(event.key, event.position, event.shift, event.control, repeat)
                self._held[event.position] = until
            elif isinstance(event, FocusLost):
                self._held.clear()
            followed.append(event)
        return followed

    def _place(self, x: int, y: int) -> tuple[int, int]:
        """Return the picture's pixel at a mouse position, counted from 1.

        Outside the picture it is the nearest pixel, for any position.
        """
        (columns, rows), (width, height) = self._room(), self.size
        if self.answers.graphics == "sixel":
            across, down = self.answers.cell
        else:
            across, down = width / columns, height / rows
        if self.answers.pixel_mouse:
            across, down = across / self.answers.cell[0], down / self.answers.cell[1]
        left, top = int((x - 0.5) * across), int((y - 0.5) * down)
        return min(max(left, -1), width), min(max(top, -1), height)

    def _size_changed(self, number, frame) -> None:
        self._resized = True

    def key_at(self, position: str) -> str:
        """Return the position: no keyboard's layout is known."""
        return position

    def capture_mouse(self, captured: bool) -> None:
        """Do nothing: a terminal cannot capture the mouse."""

    def toggle_fullscreen(self) -> None:
        """Do nothing: a program cannot choose the terminal's size."""


def picture_size(answers: Answers, room: tuple[int, int]) -> tuple[int, int]:
    """Return width and height in pixels of the picture that fills columns and rows of text."""
    columns, rows = room
    if answers.graphics == "blocks":
        return columns, 2 * rows
    width, height = columns * answers.cell[0], rows * answers.cell[1]
    most = LARGEST[answers.graphics]
    if answers.graphics == "sixel":
        return min(width, most[0]), max(min(height, most[1]), sixel.BAND)
    shrunk = min(1.0, most[0] / width, most[1] / height)
    return max(round(width * shrunk), 1), max(round(height * shrunk), 1)


def encoded(
    pixels: np.ndarray, answers: Answers, room: tuple[int, int], number: int | None = None
) -> bytes:
    """Return the codes that show a picture in the cells of ``room`` from the cursor on."""
    if answers.graphics == "kitty":
        return kitty.encode(pixels, *room, number)
    if answers.graphics == "sixel":
        return sixel.encode(pixels)
    return half_blocks.encode(pixels)
