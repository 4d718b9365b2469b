"""Shows a picture in a window, with zooming and panning.

In: (H, W, 4) uint8 pixels and a `Window`. Out: the visible part of the picture on the screen, and
the pixel under the mouse in the title bar.
"""

from __future__ import annotations

import math

import numpy as np

from .. import events
from .window import Window

BACKDROP = (28, 30, 34, 255)
#: Zoom factor per wheel step or key, and limits of a pixel's size.
ZOOM_STEP = 1.25
SIDES = 1 / 64, 64.0
#: Keys that zoom, with the equivalent wheel steps.
ZOOM_KEYS = {"+": 1, "=": 1, "Keypad +": 1, "-": -1, "Keypad -": -1}


class PictureView:
    """The visible part of a picture.

    Parameters
    ----------
    picture : (int, int)
        Width and height in pixels.
    window : (int, int)
        Width and height of the window.
    """

    def __init__(self, picture: tuple[int, int], window: tuple[int, int]):
        self._picture = picture
        self._window = window
        self.fit()

    def fit(self) -> None:
        """Fit the picture into the window, also after later changes of the window."""
        self.fits = True
        sides = (room / length for room, length in zip(self._window, self._picture, strict=True))
        self.side = min(sides)  # size of a picture pixel in window pixels
        self._center()

    def _center(self) -> None:
        pairs = zip(self._window, self._picture, strict=True)
        self._corner = [(room - length * self.side) / 2 for room, length in pairs]

    def resize(self, window: tuple[int, int]) -> None:
        """Show the picture in a window of another size."""
        old, self._window = self._window, window
        if self.fits:
            self.fit()
        else:
            self.move((window[0] - old[0]) / 2, (window[1] - old[1]) / 2)

    def real_size(self) -> None:
        """Show each pixel as one of the window, and centre the picture."""
        self.fits, self.side = False, 1.0
        self._center()

    def zoom(self, steps: float, at: tuple[float, float]) -> None:
        """Zoom by wheel steps about a fixed point of the window."""
        low, high = SIDES
        side = max(low, min(high, self.side * ZOOM_STEP**steps))
        ratio, self.side, self.fits = side / self.side, side, False
        self._corner = [
            point - (point - corner) * ratio for point, corner in zip(at, self._corner, strict=True)
        ]

    def move(self, dx: float, dy: float) -> None:
        """Move the picture by pixels of the window."""
        self.fits = False
        self._corner = [self._corner[0] + dx, self._corner[1] + dy]

    def pixel_at(self, x: int, y: int) -> tuple[int, int] | None:
        """Return the picture's pixel at a point of the window, or None."""
        column, row = (
            int(indices[at]) for indices, at in zip(self._indices(), (x, y), strict=True)
        )
        inside = 0 <= column < self._picture[0] and 0 <= row < self._picture[1]
        return (column, row) if inside else None

    def _indices(self) -> list[np.ndarray]:
        """Return the picture's column and row for each column and row of the window."""
        pairs = zip(self._window, self._corner, strict=True)
        return [
            np.floor((np.arange(room) + 0.5 - corner) / self.side).astype(np.int64)
            for room, corner in pairs
        ]

    def visible(self, pixels: np.ndarray) -> np.ndarray:
        """Return the visible pixels, as an array of the window's size."""
        columns, rows = self._indices()
        width, height = self._picture
        shown = np.empty((len(rows), len(columns), 4), np.uint8)
        shown[:] = BACKDROP
        inside = [(columns >= 0) & (columns < width), (rows >= 0) & (rows < height)]
        part = pixels[rows[inside[1]]][:, columns[inside[0]]]
        shown[np.ix_(inside[1], inside[0])] = part
        return shown


class PictureWindow:
    """Shows a picture until the user closes the window, or presses Q or Escape.

    Parameters
    ----------
    window : Window
        One that waits for events.
    pixels : (H, W, 4) ndarray of uint8
    order : {"rgba", "bgra"}
        In which order their bytes come.
    """

    def __init__(self, window: Window, pixels: np.ndarray, order: str):
        self._window = window
        self._title = window.title
        self._pixels, self._order = pixels, order
        self._size = window.size
        self.view = PictureView((pixels.shape[1], pixels.shape[0]), self._size)

    def run(self) -> None:
        """Run until the window closes."""
        self._draw()
        for event in self._window:
            if self._obey(event):
                self._draw()

    def _draw(self) -> None:
        self._window.present(self.view.visible(self._pixels), self._order)

    def _obey(self, event) -> bool:
        """Handle an event; return whether to redraw the picture."""
        view = self.view
        match event:
            case events.KeyDown("Q" | "Escape"):
                self._window.close()
                return False
            case events.KeyDown(key) if key in ZOOM_KEYS:
                middle = self._window.mouse or tuple(side / 2 for side in self._size)
                view.zoom(ZOOM_KEYS[key], middle)
            case events.KeyDown("R" | "Return"):
                view.fit()
            case events.KeyDown("1" | "Keypad 1"):
                view.real_size()
            case events.Wheel(steps, x, y):
                view.zoom(steps, (x, y))
            case events.MouseMotion(dx, dy, x, y):
                self._tell(x, y)
                if not self._window.buttons:
                    return False
                view.move(dx, dy)
            case events.Resized(width, height):
                self._size = width, height
                view.resize(self._size)
            case _:
                return False
        return True

    def _tell(self, x: int, y: int) -> None:
        """Show the pixel under the mouse, and its colour, in the title."""
        width, height = self._size
        pixel = self.view.pixel_at(x, y) if 0 <= x < width and 0 <= y < height else None
        title = self._title
        if pixel is not None:
            channels = self._pixels[pixel[1], pixel[0]].tolist()
            if self._order == "bgra":
                channels[:3] = channels[2::-1]
            title += f" - {pixel[0]}, {pixel[1]}: {' '.join(map(str, channels))}"
        if title != self._window.title:
            self._window.title = title


def fitting_size(picture: tuple[int, int], most: tuple[int, int]) -> tuple[int, int]:
    """Return the window size for a picture, enlarged by a whole number if small.

    Parameters
    ----------
    picture : (int, int)
        Width and height.
    most : (int, int)
        As large as the window may be.
    """
    fits = min(room / length for room, length in zip(most, picture, strict=True))
    times = math.floor(fits / 2) or min(1.0, fits)
    return max(1, round(picture[0] * times)), max(1, round(picture[1] * times))
