"""The terminal device: input and output, its size, and its capabilities.

In: the process's terminal, independent of standard input and output. Out: `Device`, in raw mode
while it is open; `ask` returns the terminal's capabilities. Answers are untrusted input: impossible
sizes are ignored.
"""

from __future__ import annotations

import contextlib
import os
import re
import select
import struct
import time
from typing import NamedTuple

from ...errors import DisplayError

#: Any answering terminal answers within this time, even over slow connections.
PATIENCE = 2.0
#: Default size of a cell in pixels.
USUAL_CELL = (8, 16)
#: Maximum side of a cell in pixels.
LARGEST_CELL = 1000
#: Default columns and rows, and the largest reported number that is believed.
USUAL_CELLS, TOLD_CELLS = (80, 24), 4096
#: Maximum columns and rows that are used; no screen has as many.
MOST_CELLS = (640, 256)
#: Maximum bytes of an answer.
_LONGEST_ANSWER = 1 << 16
#: Maximum bytes read before other work continues.
_MOST_READ = 1 << 16
_ASK_KITTY = b"\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\"
_ASK_CELL = b"\x1b[16t"
_ASK_PIXEL_MOUSE = b"\x1b[?1016$p"
#: Every terminal answers this request, so its answer ends the wait.
_ASK_ATTRIBUTES = b"\x1b[c"
_ATTRIBUTES = re.compile(rb"\x1b\[\?([0-9;]{0,256})c")
_CELL = re.compile(rb"\x1b\[6;(\d{1,4});(\d{1,4})t")
_SIXEL = b"4"


class Answers(NamedTuple):
    """The capabilities of a terminal.

    Attributes
    ----------
    graphics : {"kitty", "sixel", "blocks"}
    cell : (int, int)
        Width and height of a cell of text in pixels.
    pixel_mouse : bool
        Whether it can report the mouse in pixels instead of cells.
    """

    graphics: str
    cell: tuple[int, int]
    pixel_mouse: bool


class Device:
    """The process's terminal, in raw mode until it is closed.

    Raises
    ------
    DisplayError
        There is none.
    """

    def __init__(self) -> None:
        try:
            import termios
            import tty
        except ImportError as error:
            raise DisplayError("pictures in a terminal need a POSIX system") from error
        try:
            self._file = os.open("/dev/tty", os.O_RDWR | os.O_NOCTTY)
        except OSError as error:
            raise DisplayError("there is no terminal to show pictures in") from error
        self._before = termios.tcgetattr(self._file)
        tty.setraw(self._file)

    def close(self) -> None:
        """Restore the terminal; may be called twice."""
        import termios

        if self._file >= 0:
            with contextlib.suppress(termios.error):  # it was hung up
                termios.tcsetattr(self._file, termios.TCSAFLUSH, self._before)
            os.close(self._file)
            self._file = -1

    def __enter__(self) -> Device:
        return self

    def __exit__(self, *exception) -> None:
        self.close()

    def write(self, data: bytes) -> None:
        """Write all of ``data``."""
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(self._file, rest) :]

    def read(self, timeout: float) -> bytes:
        """Return input or answers; empty if nothing comes within ``timeout`` seconds."""
        said, wait = b"", max(timeout, 0.0)
        # The system delivers a few kilobytes at a time: read everything that is waiting.
        while len(said) < _MOST_READ and select.select([self._file], [], [], wait)[0]:
            part = os.read(self._file, _MOST_READ - len(said))
            if not part:
                break
            said, wait = said + part, 0.0
        return said

    def cells(self) -> tuple[int, int]:
        """Return the number of columns and rows."""
        columns, rows = os.get_terminal_size(self._file)
        if not (0 < columns <= TOLD_CELLS and 0 < rows <= TOLD_CELLS):
            return USUAL_CELLS
        return min(columns, MOST_CELLS[0]), min(max(rows, 2), MOST_CELLS[1])

    def ask(self) -> Answers:
        """Ask the terminal for its capabilities; a silent one gets half blocks."""
        self.write(_ASK_KITTY + _ASK_CELL + _ASK_PIXEL_MOUSE + _ASK_ATTRIBUTES)
        said, ends = b"", time.monotonic() + PATIENCE
        while not _ATTRIBUTES.search(said) and (left := ends - time.monotonic()) > 0:
            said += self.read(left)
            if len(said) > _LONGEST_ANSWER:
                break
        cell = _CELL.search(said)
        told = None if cell is None else _sensible(int(cell[2]), int(cell[1]))
        pixel_mouse = re.search(rb"\x1b\[\?1016;[123]\$y", said) is not None
        measured = told or self._cell_by_system() or USUAL_CELL
        return Answers(_graphics(said), measured, pixel_mouse and told is not None)

    def _cell_by_system(self) -> tuple[int, int] | None:
        """Return the size of a cell reported by the system; None if unknown."""
        import fcntl
        import termios

        size = fcntl.ioctl(self._file, termios.TIOCGWINSZ, bytes(8))
        rows, columns, width, height = struct.unpack("4H", size)
        if not (rows and columns and width and height):
            return None
        return _sensible(max(width // columns, 1), max(height // rows, 1))


def _sensible(width: int, height: int) -> tuple[int, int] | None:
    """Return a cell's size, or a default for implausible sizes."""
    is_sensible = all(1 <= side <= LARGEST_CELL for side in (width, height))
    return (width, height) if is_sensible else None


def _graphics(said: bytes) -> str:
    if b"\x1b_Gi=31;OK" in said:
        return "kitty"
    attributes = _ATTRIBUTES.search(said)
    # The first number is the terminal's class; its capabilities follow.
    known = attributes[1].split(b";")[1:] if attributes else []
    return "sixel" if _SIXEL in known else "blocks"
