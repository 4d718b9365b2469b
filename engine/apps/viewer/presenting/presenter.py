"""Presents pictures in a window, fitted and in the screen's rhythm.

In: (H, W, 4) uint8 pixels. Out: the picture centred in the window with its aspect ratio; and the
picture position of a window point.
"""

from __future__ import annotations

import ctypes
import time

import numpy as np

from ....errors import DisplayError
from ..sdl import is_opengl_on_the_cpu, last_error, refresh_rate
from .surface_output import SurfaceOutput
from .texture_output import Place, TextureOutput


class Presenter:
    """Shows pictures in an SDL window.

    Parameters
    ----------
    sdl : module
    window : SDL_Window
    vsync : bool
        Whether `present` waits for the screen's next refresh.

    Raises
    ------
    DisplayError
        SDL cannot draw in the window.
    """

    def __init__(self, sdl, window, vsync: bool):
        self._sdl = sdl
        self._window = window
        self._picture = (0, 0)
        self._next_refresh = 0.0
        self._output = _open_output(sdl, window, vsync)
        paced = vsync and not self._output.is_synced
        self._refresh_seconds = 1.0 / refresh_rate(sdl, window) if paced else 0.0

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the drawable area, in pixels."""
        return self._output.size

    @property
    def density(self) -> float:
        """Pixels of the drawable area per unit of the window's size."""
        width, height = ctypes.c_int(), ctypes.c_int()
        self._sdl.SDL_GetWindowSize(self._window, width, height)
        return max(self.size[0] / max(width.value, 1), 1.0)

    def pixels_of(self, distance: int) -> int:
        """Convert a distance in window units to pixels of the drawable area."""
        return round(distance * self.density)

    def present(self, pixels: np.ndarray, order: str) -> None:
        """Show pixels with byte order ``"rgba"`` or ``"bgra"``."""
        self._output.take(pixels, order)
        self._picture = pixels.shape[1], pixels.shape[0]
        self.expose()

    def expose(self) -> None:
        """Show the last pixels again."""
        self._wait_for_refresh()
        self._output.show(self._room())

    def forget(self) -> None:
        """Note that the screen has lost what it showed."""
        self._output.forget()

    def _room(self) -> Place:
        """Return the picture's rectangle in the window: left, top, width and height."""
        (width, height), (across, down) = self.size, self._picture
        if not across:
            return 0, 0, width, height
        if width * down > height * across:
            shown = max(1, across * height // down), height
        else:
            shown = width, max(1, down * width // across)
        return (width - shown[0]) // 2, (height - shown[1]) // 2, *shown

    def place(self, x: int, y: int) -> tuple[int, int]:
        """Return the picture position of a window point, in pixels; it may be outside."""
        x, y = int(x * self.density), int(y * self.density)
        left, top, width, height = self._room()
        across, down = self._picture if self._picture[0] else (width, height)
        return (x - left) * across // width, (y - top) * down // height

    def _wait_for_refresh(self) -> None:
        """Keep the screen's rhythm if SDL's driver cannot."""
        if not self._refresh_seconds:
            return
        now = time.monotonic()
        if now < self._next_refresh:
            time.sleep(self._next_refresh - now)
        self._next_refresh = max(now, self._next_refresh) + self._refresh_seconds

    def close(self) -> None:
        """Free what SDL holds for it."""
        self._output.close()


def _open_output(sdl, window, vsync: bool) -> SurfaceOutput | TextureOutput:
    """Return a renderer with a graphics card, or else the window's surface."""
    # OpenGL is not faster for a surface's way to the screen, and ten times slower on the CPU.
    sdl.SDL_SetHint(sdl.SDL_HINT_FRAMEBUFFER_ACCELERATION, b"0")
    flags = sdl.SDL_RENDERER_PRESENTVSYNC if vsync else 0
    renderer = sdl.SDL_CreateRenderer(window, -1, flags)
    if not renderer:
        raise DisplayError(f"cannot draw in the window (SDL: {last_error(sdl)})")
    info = sdl.SDL_RendererInfo()
    sdl.SDL_GetRendererInfo(renderer, info)
    # SDL's software renderer would copy a picture three times; and it claims to wait for the
    # screen, but does not.
    if info.flags & sdl.SDL_RENDERER_SOFTWARE or is_opengl_on_the_cpu(sdl):
        sdl.SDL_DestroyRenderer(renderer)
        return SurfaceOutput(sdl, window)
    return TextureOutput(sdl, renderer)
