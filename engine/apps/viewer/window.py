"""A resizable window that shows pictures and reports user input.

In: pictures to present. Out: events (`engine3d.events`). SDL loads when a window opens.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator

from ...base.calls import checks_types
from ...base.image_size import check_size
from ...base.numbers import real, shown
from ...base.validation import FixedNames
from ...base.validation import text as checked_text
from ...choices import PixelFormat, PointerShape
from ...errors import DisplayError, InvalidArgumentError
from ...stage.overlays.frame_times import FrameRate
from ...stage.overlays.ui_scale import limited_scale
from .. import events
from .held import HeldInput
from .icon import set_icon
from .input import Translator, key_name, window_number
from .pixels import Picture, as_pixels
from .presenting.presenter import Presenter
from .screen_scale import screen_scale
from .sdl import (
    close_video,
    fit_to_screen,
    last_error,
    open_video,
    refresh_rate,
)

MIN_SIDE = 64
#: Seconds between checks for Ctrl-C while waiting for events.
PATIENCE = 0.25
#: SDL counts milliseconds in 32 bits.
LONGEST_WAIT = 2_000_000.0
#: SDL's names of pointer shapes.
POINTERS: dict[PointerShape, str] = {
    "arrow": "ARROW",
    "text": "IBEAM",
    "wait": "WAIT",
    "crosshair": "CROSSHAIR",
    "working": "WAITARROW",
    "size_nwse": "SIZENWSE",
    "size_nesw": "SIZENESW",
    "size_we": "SIZEWE",
    "size_ns": "SIZENS",
    "size_all": "SIZEALL",
    "no": "NO",
    "hand": "HAND",
}
#: The open windows by SDL's numbers: SDL has one event queue for all.
_OPEN: dict[int, Window] = {}


class Window(FixedNames):
    """A window to show pictures in.

    Iterating over it yields events and, where the window doesn't wait, a `Tick` whenever the next
    picture is due. The iteration ends when the user closes the window, or after `close`::

        with e3d.Window((320, 200), "Hello") as window:
            canvas = e3d.Canvas((320, 200))
            for event in window:
                canvas.text(10, 10, "hello", (255, 255, 255))
                window.present(canvas)

    Parameters
    ----------
    size : (int, int)
        Width and height of the drawable area in pixels, at first: the user may resize it. Where the
        screen counts larger units than pixels (Wayland, macOS), in these: the attribute `size` then
        tells more pixels.
    title : str
        Text of the title bar.
    wait : bool
        Wait for events, and cost nothing meanwhile: for what changes only when the user does
        something. Otherwise there are ticks as well: for what moves by itself.
    max_fps : float, optional
        Ticks a second, at most; by default the screen's refresh rate or, without ``vsync``, no
        limit.
    vsync : bool
        Whether `present` waits for the screen's next refresh.

    Raises
    ------
    DisplayError
        There is no screen, or no window can be opened.
    InvalidArgumentError
        The size or the limit is none.
    """

    @checks_types
    def __init__(
        self,
        size: tuple[int, int],
        title: str = "engine3d",
        *,
        wait: bool = False,
        max_fps: float | None = None,
        vsync: bool = True,
    ) -> None:
        self._sdl = None
        size = check_size(size)
        self._title = checked_text(title, "title")
        self._wait = bool(wait)
        self._tick_seconds = 0.0 if max_fps is None else 1.0 / _positive(max_fps, "max_fps")
        self._last_tick: float | None = None
        self._first_tick = 0.0
        self._held = HeldInput()
        self._rate = FrameRate()
        self._pending: list[events.Event] = []
        self._pointers: dict = {}
        self._sdl = open_video()
        self._window = self._presenter = None
        try:
            self._open(size, bool(vsync))
        except DisplayError:
            self.close()
            raise
        if max_fps is None and vsync:
            self._tick_seconds = 1.0 / refresh_rate(self._sdl, self._window)

    def _open(self, size: tuple[int, int], vsync: bool) -> None:
        sdl = self._sdl
        middle = sdl.SDL_WINDOWPOS_CENTERED
        flags = sdl.SDL_WINDOW_RESIZABLE | sdl.SDL_WINDOW_SHOWN | sdl.SDL_WINDOW_ALLOW_HIGHDPI
        title = self._title.encode("utf-8", "replace")
        self._window = sdl.SDL_CreateWindow(title, middle, middle, *size, flags)
        if not self._window:
            raise DisplayError(f"cannot open a window (SDL: {last_error(sdl)})")
        _OPEN[sdl.SDL_GetWindowID(self._window)] = self
        sdl.SDL_SetWindowMinimumSize(self._window, MIN_SIDE, MIN_SIDE)
        sdl.SDL_EventState(sdl.SDL_DROPFILE, sdl.SDL_ENABLE)
        set_icon(sdl, self._window)
        self._presenter = Presenter(sdl, self._window, vsync)
        self._translator = Translator(self._presenter.place, self._presenter.pixels_of)

    #: A window draws text into the picture; a terminal may write it beside.
    writes_text = False

    # Pictures

    @checks_types
    def present(self, picture: Picture, format: PixelFormat | None = None) -> None:
        """Show a picture, as large as fits into the window.

        Parameters
        ----------
        picture : Frame, Canvas or ndarray
            An array is (H, W, 4) or (H, W, 3) uint8, (H, W) uint8 for grey, or (H, W) uint32; top
            row first. Alpha is not looked at.
        format : {"rgba", "bgra"}, optional
            In which order an array's bytes lie in memory; ``"rgba"`` if left out. Words have to
            say it: ``"bgra"`` is 0xAARRGGBB (what SDL calls ARGB8888), ``"rgba"`` 0xAABBGGRR.

        Raises
        ------
        InvalidArgumentError
            It is no such picture, or the window is closed.
        """
        pixels, order = as_pixels(picture, format)
        self._opened().present(pixels, order)
        self._rate.add()

    def expose(self) -> None:
        """Show the last picture again; a window of another size may show later changes of it."""
        self._opened().expose()

    def _opened(self) -> Presenter:
        if self._presenter is None:
            raise InvalidArgumentError("the window is closed")
        return self._presenter

    @property
    def fps(self) -> float:
        """Pictures a second that were presented in the last second."""
        return self._rate.value

    # Events

    @checks_types
    def events(self, timeout: float = 0.0) -> list[events.Event]:
        """Return the events that are waiting; if there are none, wait up to ``timeout`` seconds."""
        self._opened()
        sdl = self._sdl
        event = sdl.SDL_Event()
        if math.isnan(real(timeout)):
            raise InvalidArgumentError(f"timeout must be a number, not {shown(timeout)}")
        milliseconds = math.ceil(min(max(real(timeout), 0.0), LONGEST_WAIT) * 1000)
        if not self._pending and milliseconds > 0 and sdl.SDL_WaitEventTimeout(event, milliseconds):
            self._receive(event)
        while sdl.SDL_PollEvent(event):
            self._receive(event)
        received, self._pending = self._pending, []
        return received

    def _receive(self, event) -> None:
        """Queue an event for its window."""
        window = _OPEN.get(window_number(self._sdl, event), self)
        translated = window._translator.translate(event)
        if translated is not None:
            window._held.follow(translated)
            if isinstance(translated, events.Exposed | events.Resized) and window._presenter:
                window._presenter.forget()
            window._pending.append(translated)

    def __iter__(self) -> Iterator[events.Event]:
        while not self.closed:
            for event in self.events(self._until_tick()):
                if isinstance(event, events.Exposed | events.Resized):
                    self.expose()
                yield event
                if isinstance(event, events.CloseRequested):
                    self.close()
                if self.closed:
                    return
            if not self._wait and self._until_tick() <= 0.0:
                yield self._tick()

    def _until_tick(self) -> float:
        if self._wait:
            return PATIENCE
        if self._last_tick is None:
            return 0.0
        return min(PATIENCE, self._last_tick + self._tick_seconds - time.monotonic())

    def _tick(self) -> events.Tick:
        now = time.monotonic()
        if self._last_tick is None:
            self._first_tick = self._last_tick = now
        dt, self._last_tick = now - self._last_tick, now
        return events.Tick(dt, now - self._first_tick)

    @property
    def keys(self) -> frozenset[str]:
        """The pressed keys, by what they type: ``"W" in window.keys``."""
        return self._held.keys

    @property
    def positions(self) -> frozenset[str]:
        """The pressed keys by position, named as on a US keyboard."""
        return self._held.positions

    @property
    def buttons(self) -> frozenset[str]:
        """The pressed mouse buttons: ``"left"``, ``"middle"``, ``"right"``."""
        return self._held.buttons

    @property
    def mouse(self) -> tuple[int, int] | None:
        """The mouse's position in pixels of the picture; None outside the window."""
        return self._held.mouse

    @checks_types
    def key_at(self, position: str) -> str:
        """Return what a key types, by its position: on AZERTY, ``"Z"`` for ``"W"``.

        Parameters
        ----------
        position : str
            What the key there types on a US keyboard, as `events.KeyDown` tells it.
        """
        self._opened()
        there = self._sdl.SDL_GetScancodeFromName(position.encode("ascii", "replace"))
        return key_name(self._sdl, self._sdl.SDL_GetKeyFromScancode(there)) or position

    @checks_types
    def capture_mouse(self, captured: bool) -> None:
        """Capture the mouse, hiding the pointer and reporting unlimited motion, or release it."""
        self._opened()
        self._sdl.SDL_SetRelativeMouseMode(captured)

    @checks_types
    def show_pointer(self, shape: PointerShape | None) -> None:
        """Set the shape of the mouse pointer over the window; None hides it.

        Raises
        ------
        InvalidArgumentError
            There is no such shape, or the window is closed.
        """
        self._opened()
        if shape is not None and shape not in POINTERS:
            known = ", ".join(POINTERS)
            raise InvalidArgumentError(f"shape must be one of {known}, not {shown(shape)}")
        sdl = self._sdl
        sdl.SDL_ShowCursor(sdl.SDL_DISABLE if shape is None else sdl.SDL_ENABLE)
        if shape is not None and shape not in self._pointers:
            number = getattr(sdl, f"SDL_SYSTEM_CURSOR_{POINTERS[shape]}")
            self._pointers[shape] = sdl.SDL_CreateSystemCursor(number)
        if shape is not None:
            sdl.SDL_SetCursor(self._pointers[shape])

    @property
    def clipboard(self) -> str:
        """The clipboard's text; assignable."""
        self._opened()
        return (self._sdl.SDL_GetClipboardText() or b"").decode("utf-8", "replace")

    @clipboard.setter
    def clipboard(self, text: str) -> None:
        self._opened()
        text = checked_text(text, "clipboard")
        self._sdl.SDL_SetClipboardText(text.encode("utf-8", "replace"))

    # The window

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the drawable area, in pixels."""
        return self._opened().size

    @property
    def title(self) -> str:
        """Text of the title bar; assignable."""
        return self._title

    @title.setter
    def title(self, title: str) -> None:
        self._opened()
        self._title = checked_text(title, "title")
        self._sdl.SDL_SetWindowTitle(self._window, title.encode("utf-8", "replace"))

    @property
    def scale(self) -> float:
        """Scale factor of the window's screen, 0.5 to 4; 1 if unknown.

        It is that of the user's other programs, such as 1.5: how many times as large texts are, in
        pixels.
        """
        density, sdl = self._opened().density, self._sdl
        if density > 1.0:  # the screen's units are larger than pixels
            return limited_scale(density)
        return screen_scale(sdl, sdl.SDL_GetWindowDisplayIndex(self._window))

    @property
    def minimised(self) -> bool:
        """Whether the window is minimised or hidden."""
        self._opened()
        hidden = self._sdl.SDL_WINDOW_MINIMIZED | self._sdl.SDL_WINDOW_HIDDEN
        return bool(self._sdl.SDL_GetWindowFlags(self._window) & hidden)

    def fit_to_screen(self) -> None:
        """Shrink the window if it is larger than its screen.

        The title bar and borders count. Other windows keep their requested size.
        """
        self._opened()
        fit_to_screen(self._sdl, self._window)

    def toggle_fullscreen(self) -> None:
        """Toggle between full screen and a window."""
        self._opened()
        sdl = self._sdl
        full = sdl.SDL_WINDOW_FULLSCREEN_DESKTOP
        now = sdl.SDL_GetWindowFlags(self._window) & full
        sdl.SDL_SetWindowFullscreen(self._window, 0 if now else full)

    @property
    def closed(self) -> bool:
        """Whether the window has been closed."""
        return self._sdl is None

    def close(self) -> None:
        """Close the window; may be called twice."""
        sdl, self._sdl = self._sdl, None
        if sdl is None:
            return
        for pointer in self._pointers.values():
            sdl.SDL_FreeCursor(pointer)
        if self._presenter is not None:
            self._presenter.close()
        if self._window:
            _OPEN.pop(sdl.SDL_GetWindowID(self._window), None)
            sdl.SDL_DestroyWindow(self._window)
        close_video(sdl)
        self._presenter = self._window = None

    def __reduce_ex__(self, protocol):
        raise TypeError("a Window cannot be copied or pickled: it is on the screen")

    def __enter__(self) -> Window:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _positive(value, what: str) -> float:
    number = real(value)
    if not number > 0:
        raise InvalidArgumentError(f"{what} must be a positive number, not {shown(value)}")
    return number
