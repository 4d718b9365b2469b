"""The viewer's state, changed by its keys, mouse, lists and files.

In: user actions. Out: the changed state; the loop (`viewer.Viewer`) draws a frame after every
`redraw`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

import numpy as np

from ...base import linalg
from ...base.language import translated
from ...errors import Engine3DError
from ...model.spatial.rays import RayHit
from ...stage.view_renderer import ViewRenderer
from ...stage.views.fps import FpsController
from ...stage.views.orbit import MIN_DISTANCE, OrbitController
from ...stage.views.viewpoint import Viewpoint
from ...stage.views.walkable_ground import told
from ...stage.views.walking import GroundController, controller
from .messages import Messages
from .sampling import Sampling
from .tools.inspector import Inspector

if TYPE_CHECKING:
    from .list_panels import Panel


class ViewerState:
    """The state of a viewer.

    Parameters
    ----------
    view_renderer : ViewRenderer
        Draws the frames.
    window : Window
        Shows them.
    view : Viewpoint, optional
        Where to look from at first and after a reset.
    sampling : Sampling, optional
        Chooses the samples per pixel; by default always as many as the renderer takes.

    Attributes
    ----------
    view, first_view : Viewpoint
        From where the scene is seen, and from where it is after a reset.
    walker : FpsController or None
        Who walks; None where the view orbits.
    held_positions : set of str
        The keys of walks that are down.
    fast : bool
        Whether one walks fast.
    time, speed : float
        Of the animation, in seconds, and how many of them pass in a second.
    playing, running : bool
        Whether it moves, and whether the window stays open.
    selected : RayHit or None
    inspector : Inspector
        The section and the distance of the parts.
    """

    def __init__(
        self,
        view_renderer: ViewRenderer,
        window,
        view: Viewpoint | None,
        sampling: Sampling | None,
    ) -> None:
        self.view_renderer = view_renderer
        self.window = window
        self.first_view = view or view_renderer.view()
        self.view = self.first_view.copy()
        self.orbit = OrbitController(self.view)
        self.walker: FpsController | None = None
        self.held_positions: set[str] = set()
        self.fast = False
        self.time = 0.0
        self.speed = 1.0
        self.playing = view_renderer.viewed.plays
        self.statistics: str | None = None
        self.running = True
        self.selected: RayHit | None = None
        self.messages = Messages()
        self.sampling = sampling or Sampling(view_renderer.samples)
        self.inspector = Inspector(self)
        self._panel: Panel | None = None
        self._stale: Literal["", "controls", "frame"] = "frame"

    @property
    def panel(self) -> Panel | None:
        """The list over the picture, or None; assignable. One who walks gets the mouse back."""
        return self._panel

    @panel.setter
    def panel(self, panel: Panel | None) -> None:
        self._panel = panel
        if self.walker is not None:
            self.window.capture_mouse(panel is None)
            self.held_positions.clear()
        self.redraw_controls()

    @property
    def changed(self) -> bool:
        """Whether anything changed since the last frame."""
        return self._stale == "frame"

    def redraw(self) -> None:
        """Request a new frame."""
        self._stale = "frame"

    def redraw_controls(self) -> None:
        """Request that what lies over and beside the frame is drawn anew, but not the frame."""
        self._stale = self._stale or "controls"

    def say(self, message: str, /, **values: object) -> None:
        """Show a message for a time that depends on its length.

        Parameters
        ----------
        message : str
            In English, or what the library says: it is shown in the language of the window.
        **values
            What fields of the message become, as for `translated`.
        """
        self.messages.say(translated(message, **values))
        self.redraw()

    def forget_scene(self) -> None:
        """Reset the state that belongs to the previous scene."""
        self.selected = None
        self.inspector.forget()
        if self._panel is not None:
            self._panel.forget()
        self.messages.trouble = ""
        self.sampling.start_anew()

    def select(self, x: int, y: int) -> None:
        """Select the object at a pixel, or deselect, unless a panel uses the click."""
        if self.panel is not None and self.panel.take(x, y):
            return
        self.selected = self.view_renderer.pick(self.view, self.time, x, y)
        self.redraw()

    def turn_light(self, dx: int, dy: int) -> None:
        """Rotate the light by a drag of (dx, dy) pixels."""
        full_turn = 2 * math.pi / self.view_renderer.size[1]
        lighting = self.view_renderer.lighting
        if not lighting.turn(self.view.pose(), dx * full_turn, dy * full_turn):
            self.say("these lights cannot be turned: L chooses others")

    def focus(self, x: int, y: int) -> bool:
        """Centre the clicked point, and orbit around it; return whether something is there."""
        hit = self.view_renderer.pick(self.view, self.time, x, y)
        if hit is None or not np.isfinite(hit.position).all():
            return False
        ahead = linalg.dot(hit.position - self.view.position(), -self.view.rotation()[:, 2])
        self.view.target = hit.position.copy()
        if not self.view.orthographic:
            self.view.distance = max(MIN_DISTANCE, float(ahead))
        self.redraw()
        return True

    def reset_view(self) -> None:
        """Go back to the first view."""
        if self.walker is not None:
            self.toggle_walking()
        self.view = self.first_view.copy()
        if self.inspector.amount:
            self.view_renderer.frame(self.view)  # parts that are apart take more room
        self.orbit.view = self.view
        self.redraw()

    def toggle_walking(self) -> None:
        """Toggle walking; the picture stays, or moves down to the ground."""
        if self.walker is None:
            self._begin_walking()
        else:
            self.walker.leave(self.view)
            self.walker = None
            self.say("orbiting")
        self.held_positions.clear()
        self.panel = None
        self.window.capture_mouse(self.walker is not None)

    def _begin_walking(self) -> None:
        try:
            self.walker = controller(self.view_renderer, self.view)
            said = translated("flying")
        except Engine3DError as error:
            self.walker = FpsController(self.view, self.view_renderer.bounds)
            said = translated("flying, as there is no ground: {reason}", reason=error)
        self.walker.place(self.view)
        if isinstance(self.walker, GroundController):
            said = translated("walking; {grid}", grid=told(self.walker.grid))
        keys = "".join(map(self.window.key_at, "WASD"))
        self.say("{now}; {keys}, mouse or arrows to look; Tab or Esc to leave", now=said, keys=keys)
