"""Puts pictures into a window's memory: where no graphics card draws.

In: (H, W, 4) uint8 pixels and their place in the window. Out: the window shows them. A picture of
the window's size is copied once, and only the rows that changed go to the screen.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...._native.canvas import copy_to_window
from ....errors import DisplayError
from ..sdl import last_error
from .texture_output import Place

#: More bands of changed rows than these go to the screen as one.
_MOST_BANDS = 8
_RED_IN_WORDS = {0xFF: "rgba", 0xFF0000: "bgra"}


class SurfaceOutput:
    """A window's surface of SDL.

    Parameters
    ----------
    sdl : module
    window : SDL_Window

    Raises
    ------
    DisplayError
        The window has no memory to draw in.
    """

    #: The surface goes to the screen at once.
    is_synced = False

    def __init__(self, sdl, window) -> None:
        self._sdl, self._window = sdl, window
        self._picture: tuple[NDArray[np.uint8], str] | None = None
        self._is_new = self._is_lost = False
        #: The surface's memory, and where in the window the picture was drawn on it.
        self._drawn: tuple[int | None, Place] | None = None
        self._surface()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the drawable area, in pixels."""
        surface = self._surface()
        return max(surface.w, 1), max(surface.h, 1)

    def take(self, pixels: NDArray[np.uint8], order: str) -> None:
        """Take a picture that `show` shows, with byte order ``"rgba"`` or ``"bgra"``.

        It is not copied before: a window of another size shows it as its pixels are then.
        """
        self._picture, self._is_new = (pixels, order), True

    def show(self, place: Place) -> None:
        """Show the last picture at a place of the window."""
        if self._picture is None:
            return
        surface = self._surface()
        bands = [(0, surface.h)]
        before, self._drawn = self._drawn, (surface.pixels, place)
        if self._is_new or before != self._drawn:
            changed = self._draw(surface, place)
            if before == self._drawn and not self._is_lost:
                bands = _bands(changed)
        self._is_new = self._is_lost = False
        self._send(surface, bands)

    def forget(self) -> None:
        """Send all of the next picture: the screen has lost the last one."""
        self._is_lost = True

    def _draw(self, surface, place: Place) -> NDArray[np.uint8]:
        """Draw the picture on the surface; return whether each row has changed."""
        whole = 0, 0, surface.w, surface.h
        is_whole = place == whole == (0, 0, *self._picture[0].shape[1::-1])
        if is_whole and (red := _red(surface)):
            return self._copy(surface, red)
        self._scale(surface, place)
        return np.ones(surface.h, np.uint8)

    def _send(self, surface, bands: list[tuple[int, int]]) -> None:
        """Send bands of rows to the screen."""
        rects = (self._sdl.SDL_Rect * len(bands))()
        for rect, (first, end) in zip(rects, bands, strict=True):
            rect.y, rect.w, rect.h = first, surface.w, end - first
        if bands:
            self._sdl.SDL_UpdateWindowSurfaceRects(self._window, rects, len(bands))

    def _surface(self) -> Any:
        surface = self._sdl.SDL_GetWindowSurface(self._window)
        if not surface:
            raise DisplayError(f"cannot draw in the window (SDL: {last_error(self._sdl)})")
        return surface.contents

    def _copy(self, surface, red: str) -> NDArray[np.uint8]:
        """Copy a picture as large as the window; return whether each row has changed."""
        pixels, order = self._picture
        memory = (ctypes.c_uint8 * (surface.pitch * surface.h)).from_address(surface.pixels)
        rows = np.frombuffer(memory, np.uint8).reshape(surface.h, surface.pitch)
        shown = rows[:, : 4 * surface.w].reshape(surface.h, surface.w, 4)
        changed = np.empty(surface.h, np.uint8)
        copy_to_window(pixels, shown, order != red, changed)
        return changed

    def _scale(self, surface, place: Place) -> None:
        """Fit the picture into its place, black around it."""
        (pixels, order), sdl = self._picture, self._sdl
        height, width = pixels.shape[:2]
        forms = {"rgba": sdl.SDL_PIXELFORMAT_RGBA32, "bgra": sdl.SDL_PIXELFORMAT_BGRA32}
        picture = sdl.SDL_CreateRGBSurfaceWithFormatFrom(
            pixels.ctypes.data, width, height, 32, 4 * width, forms[order]
        )
        sdl.SDL_SetSurfaceBlendMode(picture, sdl.SDL_BLENDMODE_NONE)
        sdl.SDL_FillRect(surface, None, sdl.SDL_MapRGB(surface.format, 0, 0, 0))
        sdl.SDL_UpperBlitScaled(picture, None, surface, sdl.SDL_Rect(*place))
        sdl.SDL_FreeSurface(picture)

    def close(self) -> None:
        """Let go of the picture; the surface is the window's."""
        self._picture = None


def _red(surface) -> str:
    """Return in which order the window's bytes lie; an empty text if they are no such words."""
    form = surface.format.contents
    return (
        _RED_IN_WORDS.get(form.Rmask, "")
        if form.BytesPerPixel == 4 and form.Gmask == 0xFF00
        else ""
    )


def _bands(changed: NDArray[np.uint8]) -> list[tuple[int, int]]:
    """Return the first row and the one behind the last of each band of changed rows."""
    edges = np.flatnonzero(np.diff(changed, prepend=0, append=0)).tolist()
    bands = list(zip(edges[::2], edges[1::2], strict=True))
    return bands if len(bands) <= _MOST_BANDS else [(edges[0], edges[-1])]
