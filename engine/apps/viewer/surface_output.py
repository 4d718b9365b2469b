"""Puts pictures into a window's memory: where no graphics card draws.

In: (H, W, 4) uint8 pixels and their place in the window. Out: the window shows them. A picture of
the window's size is copied once, and only the rows that changed go to the screen.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..._native.canvas import copy_to_window
from ...errors import DisplayError
from .sdl import last_error
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
        self._shown: tuple[int | None, Place] | None = None
        self._surface()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the drawable area, in pixels."""
        surface = self._surface()
        return max(surface.w, 1), max(surface.h, 1)

    def take(self, pixels: NDArray[np.uint8], order: str) -> None:
        """Take a picture that `show` shows, with byte order ``"rgba"`` or ``"bgra"``.

        It is not copied: a resized window shows it as its pixels are then.
        """
        self._picture = pixels, order

    def show(self, place: Place) -> None:
        """Show the last picture at a place of the window."""
        if self._picture is None:
            return
        surface, sdl = self._surface(), self._sdl
        before, self._shown = self._shown, (surface.pixels, place)
        is_whole = place == (0, 0, *self._picture[0].shape[1::-1]) == (0, 0, surface.w, surface.h)
        if is_whole and (red := _red(surface)):
            changed = self._copy(surface, red)
            bands = _bands(changed) if before == self._shown else [(0, surface.h)]
        else:
            self._scale(surface, place)
            bands = [(0, surface.h)]
        if bands:
            rows = [sdl.SDL_Rect(0, first, surface.w, end - first) for first, end in bands]
            sdl.SDL_UpdateWindowSurfaceRects(
                self._window, (sdl.SDL_Rect * len(rows))(*rows), len(rows)
            )

    def forget(self) -> None:
        """Show all of the next picture: the screen has lost the last one."""
        self._shown = None

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
