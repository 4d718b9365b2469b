"""Puts pictures into a window through a texture of SDL's renderer: for graphics cards.

In: (H, W, 4) uint8 pixels and their place in the window. Out: the window shows them.
"""

from __future__ import annotations

import ctypes

import numpy as np
from numpy.typing import NDArray

from ....errors import DisplayError
from ..sdl import last_error

#: Left, top, width and height, in pixels of the window.
Place = tuple[int, int, int, int]


class TextureOutput:
    """A window's renderer of SDL.

    Parameters
    ----------
    sdl : module
    renderer : SDL_Renderer
    """

    def __init__(self, sdl, renderer) -> None:
        self._sdl, self._renderer = sdl, renderer
        self._texture = None
        self._kind: tuple[tuple[int, int], str] | None = None
        info = sdl.SDL_RendererInfo()
        sdl.SDL_GetRendererInfo(renderer, info)
        #: Whether `show` waits for the screen's next refresh.
        self.is_synced = bool(info.flags & sdl.SDL_RENDERER_PRESENTVSYNC)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the drawable area, in pixels."""
        width, height = ctypes.c_int(), ctypes.c_int()
        self._sdl.SDL_GetRendererOutputSize(self._renderer, width, height)
        return max(width.value, 1), max(height.value, 1)

    def take(self, pixels: NDArray[np.uint8], order: str) -> None:
        """Take a picture that `show` shows, with byte order ``"rgba"`` or ``"bgra"``."""
        height, width = pixels.shape[:2]
        if self._kind != ((width, height), order):
            self._make_texture(width, height, order)
        self._sdl.SDL_UpdateTexture(self._texture, None, pixels.ctypes.data, width * 4)

    def show(self, place: Place) -> None:
        """Show the last picture at a place of the window."""
        sdl = self._sdl
        if self._texture:
            sdl.SDL_RenderClear(self._renderer)
            sdl.SDL_RenderCopy(self._renderer, self._texture, None, sdl.SDL_Rect(*place))
        sdl.SDL_RenderPresent(self._renderer)

    def forget(self) -> None:
        """Show all of the next picture, as is always done here."""

    def _make_texture(self, width: int, height: int, order: str) -> None:
        sdl = self._sdl
        if self._texture:
            sdl.SDL_DestroyTexture(self._texture)
        forms = {"rgba": sdl.SDL_PIXELFORMAT_RGBA32, "bgra": sdl.SDL_PIXELFORMAT_BGRA32}
        access = sdl.SDL_TEXTUREACCESS_STREAMING
        self._texture = sdl.SDL_CreateTexture(self._renderer, forms[order], access, width, height)
        self._kind = (width, height), order
        if not self._texture:
            self._kind = None
            raise DisplayError(f"no texture of {width}x{height} (SDL: {last_error(sdl)})")
        sdl.SDL_SetTextureBlendMode(self._texture, sdl.SDL_BLENDMODE_NONE)

    def close(self) -> None:
        """Free the texture and SDL's renderer."""
        if self._texture:
            self._sdl.SDL_DestroyTexture(self._texture)
        self._sdl.SDL_DestroyRenderer(self._renderer)
        self._texture = self._renderer = None
