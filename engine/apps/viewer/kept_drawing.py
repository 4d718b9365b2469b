"""A drawing that is made again only when what it shows has changed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...rendering.canvas import Canvas, lay_over


class KeptDrawing:
    """The pixels of a drawing, and what they show.

    Parameters
    ----------
    is_clear : bool
        Whether it has a transparent ground, rather than filling its size.
    """

    def __init__(self, *, is_clear: bool = False) -> None:
        self._is_clear = is_clear
        self._shows: object = None
        self._pixels = np.empty((0, 0, 4), np.uint8)

    def put(
        self,
        onto: np.ndarray,
        size: tuple[int, int],
        shows: object,
        draw: Callable[[Canvas], object],
    ) -> None:
        """Lay the drawing onto pixels, from their top left corner; what is beyond them is cut.

        Parameters
        ----------
        onto : (H, W, 4) uint8
        size : (int, int)
            Width and height of the drawing.
        shows : object
            Equal as long as the drawing would be the same.
        draw : callable
            Draws on a canvas of that size.
        """
        width, height = size
        if self._pixels.shape[:2] != (height, width) or shows != self._shows:
            self._pixels = np.zeros((height, width, 4), np.uint8)
            draw(Canvas(self._pixels))
            self._shows = shows
        part = onto[:height, :width]
        drawn = self._pixels[: part.shape[0], : part.shape[1]]
        if self._is_clear:
            lay_over(part, drawn)
        else:
            np.copyto(part, drawn)
