"""SDL's events, translated into small values that the viewer understands.

In: an ``SDL_Event``. Out: one of the classes below, or None for events that mean nothing here.
Keys carry both what they type and where they are (named as on a US keyboard). The rest of the
viewer never sees SDL's structures.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class KeyDown:
    """A key went down (or repeats): ``key`` as typed, ``position`` on the keyboard."""

    key: str
    position: str
    shift: bool = False
    control: bool = False
    repeat: bool = False


@dataclass(frozen=True)
class KeyUp:
    """A key came up."""

    key: str
    position: str


@dataclass(frozen=True)
class MouseButton:
    """A mouse button (``"left"``, ``"middle"``, ``"right"``) went down or came up."""

    button: str
    down: bool
    shift: bool = False
    control: bool = False


@dataclass(frozen=True)
class MouseMotion:
    """The mouse moved by (dx, dy) pixels, y downward."""

    dx: int
    dy: int


@dataclass(frozen=True)
class Wheel:
    """The wheel turned by ``steps``, positive away from the user."""

    steps: float


@dataclass(frozen=True)
class Resized:
    """The window's drawable area has a new size, in pixels."""

    width: int
    height: int


@dataclass(frozen=True)
class FilesDropped:
    """Files were dropped on the window, all at once."""

    paths: tuple[str, ...]


class Exposed:
    """The window's content must be shown again."""


class Minimised:
    """The window is hidden: nothing needs drawing."""


class Restored:
    """The window shows again."""


class FocusLost:
    """The keyboard went to another window: no key is down any more as far as we know."""


class CloseRequested:
    """The user, or the system, asked the window to close."""


class Translator:
    """Makes this module's classes of SDL's events, in the order in which they came.

    Clicks bear no modifier keys, and SDL tells of these what is so by now, several events later
    where a frame takes long. So they are taken from the keys' events. Files that are dropped
    together come one by one: they are one event, when the last of them has come.
    """

    def __init__(self) -> None:
        self._modifiers = 0
        self._dropped: list[str] = []

    def translate(self, event):
        """Return ``event`` (an ``SDL_Event``) as one of this module's classes, or None."""
        import sdl2

        if event.type in (sdl2.SDL_KEYDOWN, sdl2.SDL_KEYUP):
            self._modifiers = event.key.keysym.mod
        if event.type == sdl2.SDL_DROPFILE:
            self._dropped += _dropped(sdl2, event.drop)
            return None
        if event.type == sdl2.SDL_DROPCOMPLETE:
            paths, self._dropped = tuple(self._dropped), []
            return FilesDropped(paths) if paths else None
        return _translated(sdl2, event, self._modifiers)


def _translated(sdl2, event, modifiers: int):
    kind = event.type
    if kind == sdl2.SDL_QUIT:
        return CloseRequested()
    if kind in (sdl2.SDL_KEYDOWN, sdl2.SDL_KEYUP):
        return _key(sdl2, event.key, kind == sdl2.SDL_KEYDOWN)
    if kind in (sdl2.SDL_MOUSEBUTTONDOWN, sdl2.SDL_MOUSEBUTTONUP):
        return _button(sdl2, event.button.button, kind == sdl2.SDL_MOUSEBUTTONDOWN, modifiers)
    if kind == sdl2.SDL_MOUSEMOTION:
        return MouseMotion(event.motion.xrel, event.motion.yrel)
    if kind == sdl2.SDL_MOUSEWHEEL:
        flipped = event.wheel.direction == sdl2.SDL_MOUSEWHEEL_FLIPPED
        return Wheel(-event.wheel.y if flipped else event.wheel.y)
    if kind == sdl2.SDL_WINDOWEVENT:
        return _window(sdl2, event.window)
    return None


def _key(sdl2, event, down: bool):
    symbol = event.keysym
    key = sdl2.SDL_GetKeyName(symbol.sym).decode("utf-8", "replace").upper()
    position = sdl2.SDL_GetScancodeName(symbol.scancode).decode("ascii", "replace")
    key = key if len(key) == 1 else sdl2.SDL_GetKeyName(symbol.sym).decode("utf-8", "replace")
    if not down:
        return KeyUp(key, position)
    shift = bool(symbol.mod & sdl2.KMOD_SHIFT)
    control = bool(symbol.mod & sdl2.KMOD_CTRL)
    return KeyDown(key, position, shift, control, bool(event.repeat))


def _button(sdl2, number: int, down: bool, modifiers: int):
    names = {
        sdl2.SDL_BUTTON_LEFT: "left",
        sdl2.SDL_BUTTON_MIDDLE: "middle",
        sdl2.SDL_BUTTON_RIGHT: "right",
    }
    if number not in names:
        return None
    shift, control = bool(modifiers & sdl2.KMOD_SHIFT), bool(modifiers & sdl2.KMOD_CTRL)
    return MouseButton(names[number], down, shift, control)


def _dropped(sdl2, event) -> list[str]:
    """Return the dropped file's path, if there is one; SDL's copy of the name is ours to free."""
    import ctypes
    import os

    if not event.file:
        return []
    path = os.fsdecode(event.file)
    address = ctypes.c_void_p.from_buffer(event, type(event).file.offset).value
    sdl2.SDL_free(ctypes.c_void_p(address))
    return [path]


def _window(sdl2, event):
    kind = event.event
    if kind == sdl2.SDL_WINDOWEVENT_SIZE_CHANGED:
        return Resized(event.data1, event.data2)
    if kind in (sdl2.SDL_WINDOWEVENT_EXPOSED, sdl2.SDL_WINDOWEVENT_SHOWN):
        return Exposed()
    if kind in (sdl2.SDL_WINDOWEVENT_MINIMIZED, sdl2.SDL_WINDOWEVENT_HIDDEN):
        return Minimised()
    if kind in (sdl2.SDL_WINDOWEVENT_RESTORED, sdl2.SDL_WINDOWEVENT_MAXIMIZED):
        return Restored()
    if kind == sdl2.SDL_WINDOWEVENT_FOCUS_LOST:
        return FocusLost()
    if kind == sdl2.SDL_WINDOWEVENT_CLOSE:
        return CloseRequested()
    return None
