"""Mouse control of the viewer: drags orbit, pan and zoom; clicks select; the wheel zooms.

In: mouse events. Out: calls of the orbit or walking controller, and of the viewer. A press becomes
a drag after some pixels of motion; otherwise it is a click.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .state import ViewerState

#: Pixels of motion allowed in a click, at scale 1.
CLICK_REACH = 4


class Mouse:
    """Handles the mouse.

    Parameters
    ----------
    viewer : ViewerState

    Attributes
    ----------
    drag : str or None
        What a pressed button does: ``"rotate"``, ``"pan"``, ``"dolly"``, ``"light"`` or
        ``"panel"``.
    """

    def __init__(self, viewer: ViewerState):
        self._viewer = viewer
        self.release()

    def release(self) -> None:
        """Forget a pressed button."""
        self.drag: str | None = None
        self._travelled = 0
        self._held_back = (0, 0)

    def button(self, event) -> None:
        """Handle a press or release of a button."""
        panel = self._viewer.panel
        if event.down and panel is not None and panel.covers(event.x, event.y):
            self.release()
            panel.click(event.x, event.y, event.shift or event.button != "left")
            self.drag = "panel"
            return
        if self.drag == "panel" and not event.down:
            self.release()
            return
        if self._viewer.walker is not None:
            if event.down and panel is not None:
                panel.take(event.x, event.y)
            return
        if event.down:
            self.release()
            self.drag = _drag(event)
            return
        clicked = self.drag == "rotate" and not self._dragging
        self.release()
        if clicked:
            self._click(event)

    @property
    def _dragging(self) -> bool:
        return self._travelled > CLICK_REACH * max(self._viewer.view_renderer.ui_scale, 1.0)

    def _click(self, event) -> None:
        panel = self._viewer.panel
        if event.clicks == 2 and not (panel is not None and panel.takes_clicks):
            self._viewer.focus(event.x, event.y)
        else:
            self._viewer.select(event.x, event.y)

    def motion(self, event) -> None:
        """Handle a motion of the mouse."""
        viewer = self._viewer
        if self.drag == "panel":
            if viewer.panel is not None:
                viewer.panel.drag(event.x)
        elif viewer.walker is not None:
            if viewer.panel is not None:
                return
            self.release()
            viewer.walker.look(event.dx, event.dy)
            viewer.walker.place(viewer.view)
            viewer.redraw()
        elif self.drag is not None:
            self._travelled += abs(event.dx) + abs(event.dy)
            dx, dy = self._held_back[0] + event.dx, self._held_back[1] + event.dy
            self._held_back = (0, 0) if self._dragging else (dx, dy)
            if self._dragging:
                self._move(dx, dy)

    def _move(self, dx: int, dy: int) -> None:
        viewer = self._viewer
        height = viewer.view_renderer.size[1]
        if self.drag == "rotate":
            viewer.orbit.rotate(dx, dy, height)
        elif self.drag == "pan":
            viewer.orbit.pan(dx, dy, height)
        elif self.drag == "light":
            viewer.turn_light(dx, dy)
        else:
            viewer.orbit.dolly_drag(dy)
        viewer.redraw()

    def wheel(self, event) -> None:
        """Handle the wheel."""
        viewer = self._viewer
        if viewer.panel is not None and viewer.panel.covers(event.x, event.y):
            viewer.panel.scroll(event.steps)
            return
        if viewer.walker is not None:
            viewer.walker.change_speed(event.steps)
            return
        viewer.orbit.dolly(event.steps, (event.x, event.y), viewer.view_renderer.size)
        viewer.redraw()


def _drag(event) -> str:
    if event.button == "left":
        return "pan" if event.shift or event.control else "rotate"
    if event.button == "right" and (event.shift or event.control):
        return "light"
    return {"middle": "dolly", "right": "pan"}[event.button]
