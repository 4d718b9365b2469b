"""The pixels of the viewer's window: a frame, with room for what lies over and beside it.

In: a frame's pixels and a layout. Out: the window's pixels, the same memory as long as its size
stays. The frame itself stays as it was drawn.
"""

from __future__ import annotations

import numpy as np

from .window_layout import WindowLayout


class WindowPixels:
    """Memory for the pixels of a window."""

    def __init__(self) -> None:
        self._pixels = np.empty((0, 0, 4), np.uint8)

    def with_picture(
        self, picture: np.ndarray, layout: WindowLayout
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the window's pixels with a picture copied into them, and the part that shows it.

        Parameters
        ----------
        picture : (h, w, 4) uint8
            Of the layout's size.
        layout : WindowLayout

        Returns
        -------
        pixels : (H, W, 4) uint8
        part : (h, w, 4) uint8
            A view of them.
        """
        width, height = layout.size
        if self._pixels.shape[:2] != (height, width):
            self._pixels = np.empty((height, width, 4), np.uint8)
        part = layout.picture.of(self._pixels)
        np.copyto(part, picture)
        return self._pixels, part
