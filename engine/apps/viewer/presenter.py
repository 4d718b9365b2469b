"""Presents pixels on the screen through a streaming texture, fitted and in the screen's rhythm.

In: (H, W, 4) uint8 pixels. Out: the picture centred in the window with its aspect ratio; and the
picture position of a window point.
"""

from __future__ import annotations

import time

import numpy as np

from ...errors import DisplayError
from .sdl import is_opengl_on_the_cpu, last_error, refresh_rate


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
        self._texture = None
        self._picture = (0, 0)
        self._order = ""
        self._next_refresh = 0.0
        self._renderer = self._open_renderer(window, vsync)
        info = sdl.SDL_RendererInfo()
        sdl.SDL_GetRendererInfo(self._renderer, info)
        # SDL's software renderer claims to wait for the screen, but does not.
        waits = sdl.SDL_RENDERER_PRESENTVSYNC | sdl.SDL_RENDERER_SOFTWARE
        synced = info.flags & waits == sdl.SDL_RENDERER_PRESENTVSYNC
        paced = vsync and not synced
        self._refresh_seconds = 1.0 / refresh_rate(sdl, window) if paced else 0.0

    def _open_renderer(self, window, vsync: bool):
        sdl = self._sdl
        flags = sdl.SDL_RENDERER_PRESENTVSYNC if vsync else 0
        # SDL's software renderer copies its pixels to the screen; OpenGL is not faster for that,
        # and ten times slower where it runs on the CPU.
        sdl.SDL_SetHint(sdl.SDL_HINT_FRAMEBUFFER_ACCELERATION, b"0")
        renderer = sdl.SDL_CreateRenderer(window, -1, flags)
        if renderer and is_opengl_on_the_cpu(sdl):
            sdl.SDL_DestroyRenderer(renderer)
            flags |= sdl.SDL_RENDERER_SOFTWARE
            renderer = sdl.SDL_CreateRenderer(window, -1, flags)
        if not renderer:
            raise DisplayError(f"cannot draw in the window (SDL: {last_error(sdl)})")
        return renderer

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the drawable area, in pixels."""
        import ctypes

        width, height = ctypes.c_int(), ctypes.c_int()
        self._sdl.SDL_GetRendererOutputSize(self._renderer, width, height)
        return max(width.value, 1), max(height.value, 1)

    @property
    def density(self) -> float:
        """Pixels of the drawable area per unit of the window's size."""
        import ctypes

        width, height = ctypes.c_int(), ctypes.c_int()
        self._sdl.SDL_GetWindowSize(self._window, width, height)
        return max(self.size[0] / max(width.value, 1), 1.0)

    def pixels_of(self, distance: int) -> int:
        """Convert a distance in window units to pixels of the drawable area."""
        return round(distance * self.density)

    def present(self, pixels: np.ndarray, order: str) -> None:
        """Show pixels with byte order ``"rgba"`` or ``"bgra"``."""
        height, width = pixels.shape[:2]
        if (self._picture, self._order) != ((width, height), order):
            self._make_texture(width, height, order)
        self._sdl.SDL_UpdateTexture(self._texture, None, pixels.ctypes.data, width * 4)
        self.expose()

    def expose(self) -> None:
        """Show the last pixels again."""
        sdl = self._sdl
        if self._texture:
            sdl.SDL_RenderClear(self._renderer)
            sdl.SDL_RenderCopy(self._renderer, self._texture, None, sdl.SDL_Rect(*self._room()))
        self._wait_for_refresh()
        sdl.SDL_RenderPresent(self._renderer)

    def _room(self) -> tuple[int, int, int, int]:
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
        across, down = self._picture if self._texture else (width, height)
        return (x - left) * across // width, (y - top) * down // height

    def _wait_for_refresh(self) -> None:
        """Keep the screen's rhythm if SDL's driver cannot."""
        if not self._refresh_seconds:
            return
        now = time.monotonic()
        if now < self._next_refresh:
            time.sleep(self._next_refresh - now)
        self._next_refresh = max(now, self._next_refresh) + self._refresh_seconds

    def _make_texture(self, width: int, height: int, order: str) -> None:
        sdl = self._sdl
        if self._texture:
            sdl.SDL_DestroyTexture(self._texture)
        forms = {"rgba": sdl.SDL_PIXELFORMAT_RGBA32, "bgra": sdl.SDL_PIXELFORMAT_BGRA32}
        access = sdl.SDL_TEXTUREACCESS_STREAMING
        self._texture = sdl.SDL_CreateTexture(self._renderer, forms[order], access, width, height)
        self._picture, self._order = (width, height), order
        if not self._texture:
            self._picture = (0, 0)
            raise DisplayError(f"no texture of {width}x{height} (SDL: {last_error(sdl)})")
        sdl.SDL_SetTextureBlendMode(self._texture, sdl.SDL_BLENDMODE_NONE)

    def close(self) -> None:
        """Free the texture and SDL's renderer."""
        if self._texture:
            self._sdl.SDL_DestroyTexture(self._texture)
        self._sdl.SDL_DestroyRenderer(self._renderer)
        self._texture = self._renderer = None
