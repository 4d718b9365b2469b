"""Loads SDL, which comes from pip (pysdl2-dll), when a window opens.

Out: the loaded module, with its video running; what fits the screen. A machine without a
screen raises `DisplayError` with one line that says so.
"""

from __future__ import annotations

import os
import sys
import time
import warnings

from ...errors import DisplayError
from .x11_errors import forgive_late_messages

#: SDL's drivers without a screen, which are its fallback.
SCREENLESS_DRIVERS = ("offscreen", "dummy", "evdev")
USUAL_REFRESH_RATE = 60
#: No window has wider borders, nor a higher title bar.
WIDEST_BORDER = 120
#: Seconds until window managers have added borders.
BORDER_SECONDS = 0.5
GL_RENDERER = 0x1F01
#: Parts of the names of OpenGL renderers without a graphics card.
SOFTWARE_OPENGL = ("llvmpipe", "softpipe", "swrast", "swiftshader", "software")


def load_sdl():
    """Import SDL and return the module; raise `DisplayError` if its library cannot be loaded."""
    try:
        with warnings.catch_warnings():
            # pysdl2 warns, on every import, that it uses the library that pip installed.
            warnings.simplefilter("ignore")
            import sdl2
    except (ImportError, RuntimeError, OSError) as error:
        raise DisplayError(f"SDL cannot be loaded: {error}") from error
    return sdl2


def find_screen() -> None:
    """Raise `DisplayError` if there is no screen to open a window on, without loading SDL."""
    if not sys.platform.startswith("linux") or os.environ.get("SDL_VIDEODRIVER"):
        return
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise DisplayError("no screen (neither DISPLAY nor WAYLAND_DISPLAY is set)")


def _has_x11() -> bool:
    """Return whether there is an X server for SDL; other systems may have one for some programs."""
    return bool(os.environ.get("DISPLAY")) and sys.platform not in ("win32", "darwin")


def open_video():
    """Load SDL, start its video and return the module; balance each call with `close_video`."""
    find_screen()
    sdl = load_sdl()
    sdl.SDL_SetHint(sdl.SDL_HINT_VIDEO_ALLOW_SCREENSAVER, b"1")
    # The class name that window managers see.
    sdl.SDL_setenv(b"SDL_VIDEO_X11_WMCLASS", b"engine3d", 0)
    sdl.SDL_SetHint(sdl.SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, b"0")
    # Otherwise Windows enlarges the picture, which is blurred then.
    sdl.SDL_SetHint(b"SDL_WINDOWS_DPI_AWARENESS", b"permonitorv2")
    if _has_x11():
        if not os.environ.get("WAYLAND_DISPLAY"):
            # Searching for Wayland as well would print errors.
            sdl.SDL_SetHint(sdl.SDL_HINT_VIDEODRIVER, b"x11")
        forgive_late_messages()
    if sdl.SDL_InitSubSystem(sdl.SDL_INIT_VIDEO) != 0:
        raise DisplayError(f"no screen (SDL: {last_error(sdl)})")
    driver = (sdl.SDL_GetCurrentVideoDriver() or b"").decode()
    if driver in SCREENLESS_DRIVERS and os.environ.get("SDL_VIDEODRIVER") != driver:
        close_video(sdl)
        raise DisplayError("no screen (the one that DISPLAY names does not answer)")
    return sdl


def close_video(sdl) -> None:
    """Release SDL's video, which ends after the last user."""
    sdl.SDL_QuitSubSystem(sdl.SDL_INIT_VIDEO)


def refresh_rate(sdl, window) -> int:
    """Return the refresh rate of a window's screen in hertz; 60 if unknown."""
    mode = sdl.SDL_DisplayMode()
    if sdl.SDL_GetWindowDisplayMode(window, mode) == 0 and mode.refresh_rate > 0:
        return mode.refresh_rate
    return USUAL_REFRESH_RATE


def fit_to_screen(sdl, window) -> None:
    """Shrink a window that, with its borders, is larger than its screen, and centre it."""
    import ctypes

    area, screen = sdl.SDL_Rect(), sdl.SDL_GetWindowDisplayIndex(window)
    if sdl.SDL_GetDisplayUsableBounds(screen, area) != 0 or area.w <= 0 or area.h <= 0:
        return
    width, height = ctypes.c_int(), ctypes.c_int()
    sdl.SDL_GetWindowSize(window, ctypes.byref(width), ctypes.byref(height))
    if width.value <= area.w - WIDEST_BORDER and height.value <= area.h - WIDEST_BORDER:
        return
    top, left, bottom, right = _borders(sdl, window)
    fitting = area.w - left - right, area.h - top - bottom
    if width.value > fitting[0] or height.value > fitting[1]:
        size = min(width.value, fitting[0]), min(height.value, fitting[1])
        aside = [(room - side) // 2 for room, side in zip(fitting, size, strict=True)]
        sdl.SDL_SetWindowSize(window, *size)
        sdl.SDL_SetWindowPosition(window, area.x + left + aside[0], area.y + top + aside[1])


def _borders(sdl, window) -> list[int]:
    """Return the width of a window's borders: top, left, bottom, right.

    Window managers add them a moment after the window is shown; until then, and without a manager,
    they are zeros.
    """
    import ctypes

    borders = [ctypes.c_int() for _ in range(4)]
    waits = sdl.SDL_GetCurrentVideoDriver() == b"x11"
    end = time.monotonic() + BORDER_SECONDS * waits
    while True:
        sdl.SDL_PumpEvents()
        sdl.SDL_GetWindowBordersSize(window, *map(ctypes.byref, borders))
        widths = [border.value for border in borders]
        if any(widths) or time.monotonic() >= end:
            return widths
        time.sleep(BORDER_SECONDS / 50)


def is_opengl_on_the_cpu(sdl) -> bool:
    """Return whether the renderer just made is an OpenGL one without a graphics card."""
    import ctypes

    if os.environ.get("SDL_RENDER_DRIVER") or not sdl.SDL_GL_GetCurrentContext():
        return False
    address = sdl.SDL_GL_GetProcAddress(b"glGetString")
    if not address:
        return False
    get_string = ctypes.CFUNCTYPE(ctypes.c_char_p, ctypes.c_uint)(address)
    name = (get_string(GL_RENDERER) or b"").decode("utf-8", "replace").lower()
    return any(software in name for software in SOFTWARE_OPENGL)


def last_error(sdl) -> str:
    """Return SDL's message about its last failure."""
    return sdl.SDL_GetError().decode("utf-8", "replace") or "unknown error"
