"""The window of a `Visualizer`, and what its mouse does.

In: events of the engine's window. Out: its pictures; calls of the visualizer. The mouse turns,
moves, rolls and zooms as in Open3D's VisualizerCallback.cpp.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...apps import events
from ...apps.viewer.window import PATIENCE, Window
from ...errors import DisplayError
from ._keys import CONTROL, PRESS, RELEASE, REPEAT, SHIFT, key_number

if TYPE_CHECKING:
    from .visualizer import Visualizer

_BUTTONS = {"left": 0, "right": 1, "middle": 2}


def open_window(visualizer: Visualizer, size: tuple[int, int]) -> VisualizerWindow | None:
    """Return an open window; None without a screen."""
    try:
        window = Window(size, visualizer.get_window_name())
    except DisplayError:
        return None
    window.fit_to_screen()
    visualizer.get_view_control().change_window_size(*window.size)
    return VisualizerWindow(visualizer, window)


class VisualizerWindow:
    """Shows a visualizer's pictures, and tells it what the user does."""

    def __init__(self, visualizer: Visualizer, window: Window) -> None:
        self._visualizer, self._window = visualizer, window
        self._shown: object = None
        self.is_full_screen = False

    def close(self) -> None:
        """Close the window."""
        self._window.close()

    def set_full_screen(self, full: bool) -> None:
        """Fill the screen, or not."""
        if full != self.is_full_screen:
            self._window.toggle_fullscreen()
            self.is_full_screen = full

    @property
    def clipboard(self) -> str:
        """The text of the clipboard."""
        return self._window.clipboard

    @clipboard.setter
    def clipboard(self, text: str) -> None:
        self._window.clipboard = text

    def take_events(self, *, wait: bool) -> None:
        """Show the ordered picture if it is new, then take what the user did.

        Parameters
        ----------
        wait : bool
            Whether to wait a moment for it.
        """
        if self._visualizer._ordered is not self._shown:
            self._window.present(self._visualizer._colors(False))
            self._shown = self._visualizer._ordered
        for event in self._window.events(PATIENCE if wait else 0.0):
            if self._window.closed:  # by a function of the program
                return
            self._take(event)

    def _take(self, event: events.Event) -> None:
        visualizer = self._visualizer
        match event:
            case events.KeyDown() | events.KeyUp():
                self._take_key(event)
            case events.MouseButton():
                mods = SHIFT * event.shift | CONTROL * event.control
                action = PRESS if event.down else RELEASE
                visualizer._mouse_button(_BUTTONS[event.button], action, mods)
            case events.MouseMotion():
                visualizer._mouse_moved(event.x, event.y, event.dx, event.dy)
            case events.Wheel(steps):
                visualizer._scrolled(0.0, steps)
            case events.Resized(width, height):
                visualizer.get_view_control().change_window_size(width, height)
                visualizer.update_renderer()
            case events.Exposed():
                self._window.expose()
            case events.CloseRequested():
                visualizer.close()

    def _take_key(self, event: events.KeyDown | events.KeyUp) -> None:
        key = key_number(event.position)
        if key is None:
            return
        if isinstance(event, events.KeyUp):
            self._visualizer._key(key, RELEASE, 0)
            return
        mods = SHIFT * event.shift | CONTROL * event.control
        self._visualizer._key(key, REPEAT if event.repeat else PRESS, mods)
