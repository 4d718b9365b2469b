"""How large texts are on a screen: what the system, or the user's settings, say.

In: SDL's video driver and a display. Out: a factor, which is 1 where 96 dots make an inch. Where
windows have more pixels than their size says (Wayland, macOS), the window knows how many
(`Presenter.density`).
"""

from __future__ import annotations

import ctypes
import functools
import os
from collections.abc import Mapping

from ...stage.overlays.ui_scale import limited_scale

USUAL_DPI = 96.0
_MM_PER_INCH = 25.4
PLAUSIBLE_DPI = 50.0, 400.0
#: What a screen's size in millimetres tells is taken in such steps: it is rounded itself.
_STEPS_OF_MEASURED, _TOLERANCE = 4, 0.1


def screen_scale(sdl, display: int) -> float:
    """Return the scale factor of a display; 1 if unknown.

    X11 leaves scaling to programs: the largest of the user's settings counts, such as ``Xft.dpi``
    and ``GDK_SCALE``, and without any the size of the screen. Windows tells its setting in dots per
    inch.
    """
    driver = sdl.SDL_GetCurrentVideoDriver()
    if driver == b"x11":
        set_dpi, server_dpi = x11_dpi(os.environ.get("DISPLAY", ""))
        return x11_scale(os.environ, set_dpi, (server_dpi, _dpi(sdl, display)))
    if driver == b"windows":
        return limited_scale(_dpi(sdl, display) / USUAL_DPI or 1.0)
    return 1.0


def x11_scale(
    environment: Mapping[str, str], set_dpi: float, measured_dpi: tuple[float, ...]
) -> float:
    """Return the scale factor on X11.

    Parameters
    ----------
    environment : mapping of str to str
        May have ``GDK_SCALE`` and ``GDK_DPI_SCALE``, which multiply each other.
    set_dpi : float
        Dots per inch, from the user's settings; 0 if there are none.
    measured_dpi : tuple of float
        The same from the size of the screen, as the server and the monitor tell it.
    """
    told = [_number(environment.get(name, "")) for name in ("GDK_SCALE", "GDK_DPI_SCALE")]
    settings = [set_dpi / USUAL_DPI] if set_dpi else []
    if any(told):
        settings.append((told[0] or 1.0) * (told[1] or 1.0))
    return limited_scale(max(settings)) if settings else max(map(scale_of, measured_dpi))


def scale_of(measured_dpi: float) -> float:
    """Return the scale factor for a screen with so many measured dots per inch.

    Projectors and televisions report wrong sizes: they count as normal screens.
    """
    if not PLAUSIBLE_DPI[0] <= measured_dpi <= PLAUSIBLE_DPI[1]:
        return 1.0
    steps = int(measured_dpi / USUAL_DPI * _STEPS_OF_MEASURED + _TOLERANCE)
    return limited_scale(max(steps / _STEPS_OF_MEASURED, 1.0))


@functools.cache
def x11_dpi(display: str) -> tuple[float, float]:
    """Return ``Xft.dpi`` of an X server's resources, and the server's own; 0 if unknown."""
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return 0.0, 0.0
    x11.XOpenDisplay.argtypes, x11.XOpenDisplay.restype = [ctypes.c_char_p], ctypes.c_void_p
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    x11.XGetDefault.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_char_p]
    x11.XGetDefault.restype = ctypes.c_char_p
    for ask in (x11.XDisplayHeight, x11.XDisplayHeightMM):
        ask.argtypes = [ctypes.c_void_p, ctypes.c_int]
    connection = x11.XOpenDisplay(os.fsencode(display))
    if not connection:
        return 0.0, 0.0
    try:
        told = x11.XGetDefault(connection, b"Xft", b"dpi") or b""
        height = x11.XDisplayHeight(connection, 0), x11.XDisplayHeightMM(connection, 0)
        return _number(told.decode("latin-1")), _MM_PER_INCH * height[0] / max(height[1], 1)
    finally:
        x11.XCloseDisplay(connection)


def _dpi(sdl, display: int) -> float:
    """Return what SDL says of a display's dots per inch; 0 if it does not know."""
    dpi = ctypes.c_float()
    if sdl.SDL_GetDisplayDPI(display, None, ctypes.byref(dpi), None) != 0:
        return 0.0
    return dpi.value


def _number(text: str) -> float:
    """Return a positive number; 0 if it is none."""
    try:
        value = float(text)
    except ValueError:
        return 0.0
    return value if 0.0 < value < float("inf") else 0.0


def has_own_units(sdl) -> bool:
    """Return whether sizes of windows count units that follow the screen, instead of pixels."""
    return sdl.SDL_GetCurrentVideoDriver() in (b"wayland", b"cocoa")
