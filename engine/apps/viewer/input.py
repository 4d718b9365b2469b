"""Translates SDL's events to those of `engine3d.events`.

In: an ``SDL_Event``. Out: one of these classes, or None for events that mean nothing here. What
reads events never sees SDL's structures.
"""

from __future__ import annotations

from collections.abc import Callable

from ...base.command_key import has_cmd
from ..events import (
    CloseRequested,
    Exposed,
    FilesDropped,
    FocusLost,
    KeyDown,
    KeyUp,
    Minimised,
    MouseButton,
    MouseLeft,
    MouseMotion,
    Resized,
    Restored,
    TextEntered,
    Wheel,
)

#: Converts a point of the window to a position in the picture.
Place = Callable[[int, int], tuple[int, int]]
#: Converts a distance in the window to pixels.
Stretch = Callable[[int], int]


class Translator:
    """Translates SDL's events in order.

    Clicks carry no modifier keys, and SDL's current modifier state may be several events ahead if a
    frame takes long. So modifiers are tracked from key events. SDL reports files dropped together
    one by one: they become one event after the last.

    Parameters
    ----------
    place : callable, optional
        Returns where in the picture a point of the window is.
    stretch : callable, optional
        Returns how many pixels a distance in the window is.
    """

    def __init__(self, place: Place | None = None, stretch: Stretch | None = None) -> None:
        self._place = place or (lambda x, y: (x, y))
        self._stretch = stretch or (lambda distance: distance)
        self._modifiers = 0
        self._dropped: list[str] = []

    def translate(self, event):
        """Return ``event`` (an ``SDL_Event``) as an event of `engine3d.events`, or None."""
        import sdl2

        if event.type in (sdl2.SDL_KEYDOWN, sdl2.SDL_KEYUP):
            self._modifiers = event.key.keysym.mod
        if event.type == sdl2.SDL_DROPFILE:
            self._dropped += _dropped(sdl2, event.drop)
            return None
        if event.type == sdl2.SDL_DROPCOMPLETE:
            paths, self._dropped = tuple(self._dropped), []
            return FilesDropped(paths) if paths else None
        if event.type == sdl2.SDL_MOUSEMOTION:
            return self._motion(sdl2, event.motion)
        return _translated(sdl2, event, self._modifiers, self._place)

    def _motion(self, sdl2, motion) -> MouseMotion:
        dx, dy = motion.xrel, motion.yrel
        if not sdl2.SDL_GetRelativeMouseMode():  # a captured mouse counts its own steps
            dx, dy = self._stretch(dx), self._stretch(dy)
        return MouseMotion(dx, dy, *self._place(motion.x, motion.y))


def window_number(sdl2, event) -> int:
    """Return SDL's number of an event's window; 0 if it has none."""
    if event.type == sdl2.SDL_QUIT:
        return 0
    if event.type in (sdl2.SDL_DROPFILE, sdl2.SDL_DROPCOMPLETE):
        return event.drop.windowID
    return event.window.windowID


def _translated(sdl2, event, modifiers: int, place: Place):
    kind = event.type
    if kind == sdl2.SDL_QUIT:
        return CloseRequested()
    if kind in (sdl2.SDL_KEYDOWN, sdl2.SDL_KEYUP):
        return _key(sdl2, event.key, kind == sdl2.SDL_KEYDOWN)
    if kind == sdl2.SDL_TEXTINPUT:
        return TextEntered(event.text.text.decode("utf-8", "replace"))
    if kind in (sdl2.SDL_MOUSEBUTTONDOWN, sdl2.SDL_MOUSEBUTTONUP):
        return _button(sdl2, event.button, kind == sdl2.SDL_MOUSEBUTTONDOWN, modifiers, place)
    if kind == sdl2.SDL_MOUSEWHEEL:
        wheel = event.wheel
        flipped = wheel.direction == sdl2.SDL_MOUSEWHEEL_FLIPPED
        return Wheel(-wheel.y if flipped else wheel.y, *place(wheel.mouseX, wheel.mouseY))
    if kind == sdl2.SDL_WINDOWEVENT:
        return _window(sdl2, event.window)
    return None


def key_name(sdl2, code: int) -> str:
    """Return the name of SDL's number of a key; letters are capitals."""
    name = sdl2.SDL_GetKeyName(code).decode("utf-8", "replace")
    return name.upper() if len(name.upper()) == 1 else name


def _key(sdl2, event, down: bool):
    symbol = event.keysym
    key = key_name(sdl2, symbol.sym)
    position = sdl2.SDL_GetScancodeName(symbol.scancode).decode("ascii", "replace")
    if not down:
        return KeyUp(key, position)
    shift = bool(symbol.mod & sdl2.KMOD_SHIFT)
    control = _holds_control(sdl2, symbol.mod)
    return KeyDown(key, position, shift, control, bool(event.repeat))


def _holds_control(sdl2, modifiers: int) -> bool:
    return bool(modifiers & (sdl2.KMOD_CTRL | (sdl2.KMOD_GUI if has_cmd() else 0)))


def _button(sdl2, event, down: bool, modifiers: int, place: Place):
    names = {
        sdl2.SDL_BUTTON_LEFT: "left",
        sdl2.SDL_BUTTON_MIDDLE: "middle",
        sdl2.SDL_BUTTON_RIGHT: "right",
    }
    if event.button not in names:
        return None
    shift, control = bool(modifiers & sdl2.KMOD_SHIFT), _holds_control(sdl2, modifiers)
    x, y = place(event.x, event.y)
    return MouseButton(names[event.button], down, shift, control, x, y, max(event.clicks, 1))


def _dropped(sdl2, event) -> list[str]:
    """Return the dropped file's path, if any, and free SDL's copy of the name."""
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
    if kind == sdl2.SDL_WINDOWEVENT_LEAVE:
        return MouseLeft()
    if kind == sdl2.SDL_WINDOWEVENT_CLOSE:
        return CloseRequested()
    return None
