"""Ignores an X11 error that must not end the program.

SDL wakes itself by messages to its own window, on a separate connection. A busy server may process
such a message after the window was closed, and report a bad window; Xlib would then end the
process.
"""

from __future__ import annotations

import ctypes

BAD_WINDOW = 3
SEND_EVENT = 25


class _Error(ctypes.Structure):
    """Xlib's ``XErrorEvent``."""

    _fields_ = (
        ("type", ctypes.c_int),
        ("display", ctypes.c_void_p),
        ("resource", ctypes.c_ulong),
        ("serial", ctypes.c_ulong),
        ("error_code", ctypes.c_ubyte),
        ("request_code", ctypes.c_ubyte),
        ("minor_code", ctypes.c_ubyte),
    )


_Handler = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(_Error))
#: Our Xlib error handler, which must live as long as the process.
_installed: list[ctypes._CFuncPtr] = []


def forgive_late_messages() -> None:
    """Ignore late messages to closed windows; pass other errors to the previous handler.

    It must be called before SDL starts its video, which installs a handler in front of this one and
    removes it at its end: the error comes last.
    """
    if _installed:
        return
    try:
        set_handler = ctypes.CDLL("libX11.so.6").XSetErrorHandler
    except OSError:  # without the library SDL has no X11 screen
        return
    set_handler.argtypes, set_handler.restype = [ctypes.c_void_p], ctypes.c_void_p

    def handle(display, error):
        found = error.contents
        if (found.error_code, found.request_code) == (BAD_WINDOW, SEND_EVENT):
            return 0
        return earlier(display, error)

    _installed.append(_Handler(handle))
    earlier = _Handler(set_handler(ctypes.cast(_installed[0], ctypes.c_void_p)))
