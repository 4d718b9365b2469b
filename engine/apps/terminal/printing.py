"""Prints one picture between the lines of a terminal.

In: a function that draws a picture of a size. Out: the picture in the terminal, below the existing
text.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .device import Device
from .terminal_window import encoded, picture_size

#: Lines left free: the prompt, and one above.
SPARED = 2


def print_picture(draw: Callable[[tuple[int, int]], np.ndarray], aspect: float) -> None:
    """Print a picture in the terminal, as large as possible.

    Parameters
    ----------
    draw : callable
        Called with a width and a height in pixels; returns (H, W, 4) uint8 pixels of that size.
    aspect : float
        Width over height of the picture, as far as whole cells of text allow.

    Raises
    ------
    DisplayError
        There is no terminal.
    """
    with Device() as device:
        answers = device.ask()
        columns, lines = device.cells()
    cell_width, cell_height = answers.cell
    if answers.graphics == "blocks":
        cell_width, cell_height = 1, 2
    most = max(lines - SPARED, 1)
    columns = max(min(columns, round(most * cell_height * aspect / cell_width)), 1)
    room = columns, max(min(most, round(columns * cell_width / aspect / cell_height)), 1)
    picture = encoded(draw(picture_size(answers, room)), answers, room)
    with Device() as device:
        # Make room first: at the bottom of the terminal, the text scrolls up.
        device.write(b"\r\n" * room[1] + f"\x1b[{room[1]}A\x1b7".encode())
        device.write(picture + f"\x1b8\x1b[{room[1]}B\r".encode())
