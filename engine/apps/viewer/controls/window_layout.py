"""Divides the window between the picture and the strips beside it.

In: the window's size, and which strips are wanted. Out: rectangles that cover the window, none over
another: nothing lies over the picture.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

#: A window has strips if it is at least so large at scale 1, and a column if so much is left.
LEAST_SIZE = (560, 400)
LEAST_PICTURE = 400


class Rectangle(NamedTuple):
    """Pixels of the window."""

    left: int
    top: int
    width: int
    height: int

    def covers(self, x: int, y: int) -> bool:
        """Return whether a pixel belongs to it."""
        return 0 <= x - self.left < self.width and 0 <= y - self.top < self.height

    def of(self, pixels: np.ndarray) -> np.ndarray:
        """Return its part of the window's pixels, (H, W, 4)."""
        return pixels[self.top : self.top + self.height, self.left : self.left + self.width]


class WindowLayout(NamedTuple):
    """The parts of a window so large; None for strips that it does not have."""

    size: tuple[int, int]
    picture: Rectangle
    bar: Rectangle | None = None
    time: Rectangle | None = None
    side: Rectangle | None = None


def has_room(size: tuple[int, int], scale: float) -> bool:
    """Return whether a window is large enough for strips."""
    return all(side >= least * scale for side, least in zip(size, LEAST_SIZE, strict=True))


def lay_out(
    size: tuple[int, int], *, bar: int = 0, time: int = 0, side: int = 0, scale: float = 1.0
) -> WindowLayout:
    """Return the layout of a window.

    Parameters
    ----------
    size : (int, int)
        Of the window in pixels.
    bar, time : int
        Heights of the strips above and below the picture; 0 for none.
    side : int
        Width of the column on the right; 0 for none.
    scale : float
        Of the texts.
    """
    (width, height), below = size, bar
    if width - side < LEAST_PICTURE * scale:
        side = 0
    middle = height - bar - time
    return WindowLayout(
        size,
        Rectangle(0, below, width - side, middle),
        Rectangle(0, 0, width, bar) if bar else None,
        Rectangle(0, height - time, width, time) if time else None,
        Rectangle(width - side, below, side, middle) if side else None,
    )
