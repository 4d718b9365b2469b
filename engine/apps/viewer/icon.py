"""The icon of the windows: a cube, drawn when a window opens.

Out: (SIDE, SIDE, 4) uint8 RGBA, transparent round the cube.
"""

from __future__ import annotations

import numpy as np

from ...rendering.canvas import Canvas

SIDE = 64
#: The centre, and the outer corners from the top, clockwise; a hexagon with upright sides.
MIDDLE = (32, 32)
CORNERS = ((32, 3), (57, 17), (57, 47), (32, 61), (7, 47), (7, 17))
#: The faces of the cube: corners beside the middle, and a colour.
FACES = (
    ((5, 0, 1), (255, 206, 115)),
    ((1, 2, 3), (95, 140, 255)),
    ((3, 4, 5), (58, 84, 170)),
)


def icon() -> np.ndarray:
    """Return the pixels."""
    canvas = Canvas((SIDE, SIDE))
    canvas.clear((0, 0, 0, 0))
    for (first, second, third), color in FACES:
        a, b, c = CORNERS[first], CORNERS[second], CORNERS[third]
        canvas.triangle(MIDDLE, a, b, color)
        canvas.triangle(MIDDLE, b, c, color)
    return canvas.pixels


def set_icon(sdl, window) -> None:
    """Set the icon of an SDL window; some window managers ignore it."""
    import ctypes

    pixels = icon()
    surface = sdl.SDL_CreateRGBSurfaceWithFormatFrom(
        pixels.ctypes.data_as(ctypes.c_void_p), SIDE, SIDE, 32, SIDE * 4, sdl.SDL_PIXELFORMAT_RGBA32
    )
    sdl.SDL_SetWindowIcon(window, surface)
    sdl.SDL_FreeSurface(surface)
