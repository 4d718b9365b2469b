"""A resizable SDL window that shows RGBA pixels through a streaming texture.

In: (H, W, 4) uint8 pixels to present. Out: translated input events (see `input`).
SDL comes from pip (pysdl2-dll) and loads when a window opens. A machine without a screen raises
`DisplayError` with one line that says so.
"""

from __future__ import annotations

import os
import sys
import time
import warnings

import numpy as np

from ..errors import DisplayError
from .input import Translator

#: SDL's drivers that draw nowhere: it falls back to them when there is no screen.
SCREENLESS_DRIVERS = ("offscreen", "dummy", "evdev")
MIN_SIDE = 64
USUAL_DPI = 96.0
PLAUSIBLE_DPI = 50.0, 400.0
GL_RENDERER = 0x1F01
#: Part of the names under which OpenGL draws without a graphics card.
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


def scale_of(dpi: float) -> int:
    """Return how many times larger than usual texts should be on a screen of so many dots an inch.

    Projectors and televisions tell sizes that are no sizes: those count as usual screens.
    """
    if not PLAUSIBLE_DPI[0] <= dpi <= PLAUSIBLE_DPI[1]:
        return 1
    return max(1, int(dpi / USUAL_DPI + 0.5))


class Window:
    """One window, its renderer and its streaming texture.

    Parameters
    ----------
    title : str
        Text of the title bar.
    width, height : int
        Size of the drawable area in pixels.
    vsync : bool
        Whether `present` waits for the screen's next refresh.

    Raises
    ------
    DisplayError
        If there is no screen, or SDL cannot open a window.
    """

    def __init__(self, title: str, width: int, height: int, *, vsync: bool = True):
        find_screen()
        self._sdl = load_sdl()
        self._window = self._renderer = self._texture = None
        self._video_open = False
        self._texture_size = (0, 0)
        self._next_refresh = 0.0
        self._translator = Translator()
        try:
            self._open_video()
            self._open_window(title, width, height)
            self._open_renderer(vsync)
        except DisplayError:
            self.close()
            raise

    def _open_video(self) -> None:
        sdl = self._sdl
        sdl.SDL_SetHint(sdl.SDL_HINT_VIDEO_ALLOW_SCREENSAVER, b"1")
        # The class by which window managers know the program.
        sdl.SDL_setenv(b"SDL_VIDEO_X11_WMCLASS", b"engine3d", 0)
        sdl.SDL_SetHint(sdl.SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, b"0")
        if os.environ.get("DISPLAY") and not os.environ.get("WAYLAND_DISPLAY"):
            # Looking for Wayland as well would print its complaints on standard error.
            sdl.SDL_SetHint(sdl.SDL_HINT_VIDEODRIVER, b"x11")
        if sdl.SDL_InitSubSystem(sdl.SDL_INIT_VIDEO) != 0:
            raise DisplayError(f"no screen (SDL: {_error(sdl)})")
        self._video_open = True
        driver = (sdl.SDL_GetCurrentVideoDriver() or b"").decode()
        if driver in SCREENLESS_DRIVERS and os.environ.get("SDL_VIDEODRIVER") != driver:
            raise DisplayError("no screen (the one that DISPLAY names does not answer)")

    def _open_window(self, title: str, width: int, height: int) -> None:
        sdl = self._sdl
        middle = sdl.SDL_WINDOWPOS_CENTERED
        flags = sdl.SDL_WINDOW_RESIZABLE | sdl.SDL_WINDOW_SHOWN
        self._window = sdl.SDL_CreateWindow(title.encode(), middle, middle, width, height, flags)
        if not self._window:
            raise DisplayError(f"cannot open a window (SDL: {_error(sdl)})")
        sdl.SDL_SetWindowMinimumSize(self._window, MIN_SIDE, MIN_SIDE)
        sdl.SDL_EventState(sdl.SDL_DROPFILE, sdl.SDL_ENABLE)

    def _open_renderer(self, vsync: bool) -> None:
        sdl = self._sdl
        flags = sdl.SDL_RENDERER_PRESENTVSYNC if vsync else 0
        # SDL's own renderer hands its pixels to the screen; through OpenGL that is no faster
        # anywhere, and where OpenGL itself draws on the CPU it takes ten times as long.
        sdl.SDL_SetHint(sdl.SDL_HINT_FRAMEBUFFER_ACCELERATION, b"0")
        self._renderer = sdl.SDL_CreateRenderer(self._window, -1, flags)
        if self._renderer and _is_opengl_on_the_cpu(sdl):
            sdl.SDL_DestroyRenderer(self._renderer)
            flags |= sdl.SDL_RENDERER_SOFTWARE
            self._renderer = sdl.SDL_CreateRenderer(self._window, -1, flags)
        if not self._renderer:
            raise DisplayError(f"cannot draw in the window (SDL: {_error(sdl)})")
        info = sdl.SDL_RendererInfo()
        sdl.SDL_GetRendererInfo(self._renderer, info)
        # SDL's own renderer says that it waits for the screen, but does not.
        waits = sdl.SDL_RENDERER_PRESENTVSYNC | sdl.SDL_RENDERER_SOFTWARE
        synced = info.flags & waits == sdl.SDL_RENDERER_PRESENTVSYNC
        self._refresh_seconds = 1.0 / self.refresh_rate if vsync and not synced else 0.0

    @property
    def refresh_rate(self) -> int:
        """The screen's refresh rate in hertz; 60 where it is unknown."""
        mode = self._sdl.SDL_DisplayMode()
        if self._sdl.SDL_GetWindowDisplayMode(self._window, mode) == 0 and mode.refresh_rate > 0:
            return mode.refresh_rate
        return 60

    @property
    def scale(self) -> int:
        """How many times finer than usual the window's screen is; 1 where it is unknown.

        Only X11 leaves it to programs to draw larger on such a screen.
        """
        import ctypes

        sdl, dpi = self._sdl, ctypes.c_float()
        if sdl.SDL_GetCurrentVideoDriver() != b"x11":
            return 1
        screen = sdl.SDL_GetWindowDisplayIndex(self._window)
        if sdl.SDL_GetDisplayDPI(screen, ctypes.byref(dpi), None, None) != 0:
            return 1
        return scale_of(dpi.value)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the drawable area, in pixels."""
        import ctypes

        width, height = ctypes.c_int(), ctypes.c_int()
        self._sdl.SDL_GetRendererOutputSize(self._renderer, width, height)
        return max(width.value, 1), max(height.value, 1)

    @property
    def minimised(self) -> bool:
        """Whether the window is minimised or hidden."""
        hidden = self._sdl.SDL_WINDOW_MINIMIZED | self._sdl.SDL_WINDOW_HIDDEN
        return bool(self._sdl.SDL_GetWindowFlags(self._window) & hidden)

    def events(self, timeout: float = 0.0) -> list:
        """Return the events that are waiting; if there are none, wait up to ``timeout`` seconds."""
        sdl = self._sdl
        event = sdl.SDL_Event()
        translate, received = self._translator.translate, []
        if timeout > 0.0 and sdl.SDL_WaitEventTimeout(event, int(timeout * 1000)):
            received.append(translate(event))
        while sdl.SDL_PollEvent(event):
            received.append(translate(event))
        return [event for event in received if event is not None]

    def present(self, pixels: np.ndarray) -> None:
        """Show ``pixels``, (H, W, 4) uint8 RGBA, top row first, stretched to the window."""
        sdl = self._sdl
        height, width = pixels.shape[:2]
        if self._texture_size != (width, height):
            self._make_texture(width, height)
        pixels = np.ascontiguousarray(pixels)
        sdl.SDL_UpdateTexture(self._texture, None, pixels.ctypes.data, width * 4)
        self.expose()

    def expose(self) -> None:
        """Show the last pixels again."""
        sdl = self._sdl
        if self._texture:
            sdl.SDL_RenderCopy(self._renderer, self._texture, None, None)
        self._wait_for_refresh()
        sdl.SDL_RenderPresent(self._renderer)

    def _wait_for_refresh(self) -> None:
        """Keep the screen's rhythm where SDL's driver cannot."""
        if not self._refresh_seconds:
            return
        now = time.monotonic()
        if now < self._next_refresh:
            time.sleep(self._next_refresh - now)
        self._next_refresh = max(now, self._next_refresh) + self._refresh_seconds

    def _make_texture(self, width: int, height: int) -> None:
        sdl = self._sdl
        if self._texture:
            sdl.SDL_DestroyTexture(self._texture)
        access = sdl.SDL_TEXTUREACCESS_STREAMING
        self._texture = sdl.SDL_CreateTexture(
            self._renderer, sdl.SDL_PIXELFORMAT_RGBA32, access, width, height
        )
        if not self._texture:
            raise DisplayError(f"no texture of {width}x{height} (SDL: {_error(sdl)})")
        sdl.SDL_SetTextureBlendMode(self._texture, sdl.SDL_BLENDMODE_NONE)
        self._texture_size = (width, height)

    def set_title(self, title: str) -> None:
        """Write ``title`` in the title bar."""
        self._sdl.SDL_SetWindowTitle(self._window, title.encode("utf-8", "replace"))

    def capture_mouse(self, captured: bool) -> None:
        """Hide the pointer and report movements without end (mouse look), or give it back."""
        self._sdl.SDL_SetRelativeMouseMode(captured)

    def hold_mouse(self, held: bool) -> None:
        """Keep receiving the mouse outside the window while a button drags."""
        self._sdl.SDL_CaptureMouse(held)

    def toggle_fullscreen(self) -> None:
        """Fill the screen, or go back to a window."""
        sdl = self._sdl
        full = sdl.SDL_WINDOW_FULLSCREEN_DESKTOP
        now = sdl.SDL_GetWindowFlags(self._window) & full
        sdl.SDL_SetWindowFullscreen(self._window, 0 if now else full)

    def close(self) -> None:
        """Close the window and leave SDL; may be called twice."""
        sdl = self._sdl
        if self._texture:
            sdl.SDL_DestroyTexture(self._texture)
        if self._renderer:
            sdl.SDL_DestroyRenderer(self._renderer)
        if self._window:
            sdl.SDL_DestroyWindow(self._window)
        if self._video_open:
            sdl.SDL_QuitSubSystem(sdl.SDL_INIT_VIDEO)
        self._video_open = False
        self._texture = self._renderer = self._window = None

    def __enter__(self) -> Window:
        return self

    def __exit__(self, *exception) -> None:
        self.close()


def _is_opengl_on_the_cpu(sdl) -> bool:
    """Whether the renderer just made is an OpenGL one without a graphics card."""
    import ctypes

    if os.environ.get("SDL_RENDER_DRIVER") or not sdl.SDL_GL_GetCurrentContext():
        return False
    address = sdl.SDL_GL_GetProcAddress(b"glGetString")
    if not address:
        return False
    get_string = ctypes.CFUNCTYPE(ctypes.c_char_p, ctypes.c_uint)(address)
    name = (get_string(GL_RENDERER) or b"").decode("utf-8", "replace").lower()
    return any(software in name for software in SOFTWARE_OPENGL)


def _error(sdl) -> str:
    return sdl.SDL_GetError().decode("utf-8", "replace") or "unknown error"
