"""The window of a plotter that goes on: ``show(interactive_update=True)``, then ``update()``.

In: a plotter. Out: its pictures, one for each update. The mouse goes to VTK's own interactor, whose
style turns, moves and zooms the camera.
"""

from __future__ import annotations

from typing import Any

from ...apps import events
from ...apps.viewer.window import Window

_BUTTONS = {"left": "LeftButton", "middle": "MiddleButton", "right": "RightButton"}


class LiveWindow:
    """A window that shows a plotter.

    Parameters
    ----------
    plotter : pyvista.Plotter

    Raises
    ------
    DisplayError
        There is no screen.
    """

    def __init__(self, plotter: Any) -> None:
        self._plotter = plotter
        self._window = Window(tuple(plotter.window_size), plotter.title)

    def update(self) -> None:
        """Take what the user did, and show the plotter as it is now; nothing once it is closed."""
        if self._window.closed:
            return
        for event in self._window.events():
            self._take(event)
        if not self._window.closed:
            pixels = self._plotter.engine3d.screenshot(transparent_background=False, scale=1)
            self._window.present(pixels)

    def close(self) -> None:
        """Close the window."""
        self._window.close()

    def _take(self, event: events.Event) -> None:
        match event:
            case events.MouseButton(button, down):
                self._tell(event, f"{_BUTTONS[button]}{'Press' if down else 'Release'}Event")
            case events.MouseMotion():
                self._tell(event, "MouseMoveEvent")
            case events.Wheel(steps):
                self._tell(event, f"MouseWheel{'Forward' if steps > 0 else 'Backward'}Event")
            case events.Resized(width, height):
                self._plotter.window_size = width, height
            case events.CloseRequested():
                self.close()

    def _tell(self, event: Any, name: str) -> None:
        """Let VTK's interactor do what follows from an event of the mouse."""
        interactor = self._plotter.iren.interactor
        below = self._plotter.window_size[1] - 1 - event.y
        control = getattr(event, "control", interactor.GetControlKey())
        shift = getattr(event, "shift", interactor.GetShiftKey())
        interactor.SetEventInformation(event.x, below, int(control), int(shift))
        interactor.InvokeEvent(name)
