"""The one error of an X server that must not end the program.

SDL wakes itself by a message to its own window, on a connection of its own. A busy server may take
this message up after the window has been closed, and calls the window bad; Xlib then ends the
process, for nothing.
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
#: The handler that Xlib has from here, which must live as long as the process.
_installed: list[ctypes._CFuncPtr] = []


def forgive_late_messages() -> None:
    """Let messages to closed windows pass; every other error goes to the handler of before.

    It is called before SDL starts its video, which puts a handler of its own in front of this one
    and takes it away again when it ends: the error comes at the very end.
    """
    if _installed:
        return
    try:
        set_handler = ctypes.CDLL("libX11.so.6").XSetErrorHandler
    except OSError:  # without the library SDL has no such screen
        return
    set_handler.argtypes, set_handler.restype = [ctypes.c_void_p], ctypes.c_void_p

    def handle(display, error):
        found = error.contents
        if (found.error_code, found.request_code) == (BAD_WINDOW, SEND_EVENT):
            return 0
        return earlier(display, error)

    _installed.append(_Handler(handle))
    earlier = _Handler(set_handler(ctypes.cast(_installed[0], ctypes.c_void_p)))
