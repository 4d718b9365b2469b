"""The viewer's loop: events in, frames out, as long as the window is open.

In: a `ViewRenderer` and a `Window` (or anything with its methods). Out: frames on the screen.
A frame is drawn only when something changed, moves or is walked through; otherwise the loop sleeps
until the next event, and it does nothing at all while the window is minimised.
"""

from __future__ import annotations

import math
import time as clock

import numpy as np

from .. import events, linalg
from ..errors import Engine3DError, printable
from ..spatial.rays import RayHit
from . import actions as viewer_actions
from .fps import LOOKS, MOVES, FpsController
from .frame_times import FrameTimes
from .help_panel import draw_help
from .keymap import ORBIT_ARROWS, action_for
from .model_files import ModelFiles
from .mouse import Mouse
from .orbit import MIN_DISTANCE, OrbitController
from .overlay import draw_block, statistics_lines
from .selection import OUTLINE_OUTPUTS, WIDTH, draw_outline, selection_lines
from .view_renderer import ViewRenderer
from .viewpoint import Sphere

#: How long the loop sleeps when nothing happens; also how often a watched file is looked at.
IDLE_SECONDS = 0.25
MESSAGE_SECONDS = 2.5
#: Characters of a message that one reads in a second.
READ_A_SECOND = 15.0
#: A model that became so many times larger or smaller is framed anew.
ALIKE = 8.0
TITLE_SECONDS = 0.5
#: A pause in the loop (a slow load, a dragged window) must not throw the walker through a wall.
LONGEST_STEP = 0.1
ARROW_RADIANS = math.radians(7.5)


class Viewer:
    """Shows a scene in a window and lets the user turn it.

    Parameters
    ----------
    view_renderer : ViewRenderer
        Draws the frames.
    window : Window
        Shows them and brings the events.
    view : Viewpoint, optional
        Where to look from at first and after a reset.
    walking : bool
        Start with the walking camera.
    playing : bool, optional
        Whether to move from the start; by default as the scene likes.
    statistics : bool
        Show statistics from the start.
    files : ModelFiles, optional
        Where the scene came from: it is loaded again when they change, if they are watched.
    """

    def __init__(
        self,
        view_renderer: ViewRenderer,
        window,
        *,
        view=None,
        walking: bool = False,
        playing: bool | None = None,
        statistics: bool = False,
        files: ModelFiles | None = None,
    ):
        self.view_renderer = view_renderer
        self.window = window
        view_renderer.screen_scale = window.scale
        self.first_view = view or view_renderer.view()
        self.view = self.first_view.copy()
        self.orbit = OrbitController(self.view)
        self.walker: FpsController | None = None
        self.time = 0.0
        self.playing = view_renderer.viewed.plays if playing is None else playing
        self.show_help = False
        self.help_page = 0
        self.help_pages = 1
        self.show_statistics = statistics
        self.running = True
        self.changed = True
        self.frame = None
        self.held_positions: set[str] = set()
        self.fast = False
        self.mouse = Mouse(self)
        self.selected: RayHit | None = None
        self._message = ""
        self._message_ends = 0.0
        self.frame_times = FrameTimes()
        self._title = ""
        self._title_due = 0.0
        self._last_turn = clock.monotonic()
        self._files = files or ModelFiles()
        self._trouble = ""
        if walking:
            viewer_actions.toggle_walking(self)

    # The loop

    def run(self, frames: int | None = None) -> None:
        """Show frames until the window closes, or until ``frames`` have been drawn.

        A number of frames is drawn whether or not anything moves.
        """
        drawn = 0
        self._last_turn = clock.monotonic()
        while self.running and (frames is None or drawn < frames):
            self.changed |= frames is not None
            drawn += self.run_once()

    def run_once(self) -> bool:
        """Obey what has happened, and return whether a frame was drawn for it."""
        for event in self.window.events(0.0 if self._lively() else IDLE_SECONDS):
            self.handle(event)
        now = clock.monotonic()
        self.advance(min(now - self._last_turn, LONGEST_STEP))
        self._last_turn = now
        drawn = self.changed and self.running and not self.window.minimised
        if drawn:
            self.draw()
        self._update_title()
        return drawn

    def _lively(self) -> bool:
        """Return whether the next frame should come at once rather than wait for an event."""
        if self.window.minimised:
            return False
        return self.changed or self.playing or self._walking_now()

    def _walking_now(self) -> bool:
        return self.walker is not None and bool(self.held_positions)

    def advance(self, seconds: float) -> None:
        """Let ``seconds`` pass: animation, walking, messages that end, files that changed."""
        if self.playing and not self.window.minimised:
            self._play(seconds)
        if self.walker is not None and self.walker.walk(self.held_positions, seconds, self.fast):
            self.walker.place(self.view)
            self.changed = True
        if self._message and clock.monotonic() >= self._message_ends:
            self._message = ""
            self.changed = True
        if self._files.changed():
            self._reload()

    def _play(self, seconds: float) -> None:
        viewed = self.view_renderer.viewed
        self.changed = True
        self.time = (self.time + seconds) % viewed.period
        if viewed.update is None and self.walker is None and self.mouse.drag is None:
            self.orbit.turn(2 * math.pi * seconds / viewed.period, 0.0)

    def draw(self) -> None:
        """Draw one frame, its overlays, and show it."""
        start = clock.monotonic()
        width, height = self.window.size
        self.view_renderer.resize(width, height)
        self.changed = False
        outputs = ("color",) if self.selected is None else OUTLINE_OUTPUTS
        self.frame = self.view_renderer.draw(self.view, self.time, outputs)
        self._draw_overlays()
        drawn = clock.monotonic()
        self.window.present(self.frame.color)
        self.frame_times.add(drawn - start, clock.monotonic() - start)

    def _draw_overlays(self) -> None:
        messages = [line for line in (self._trouble, self._message) if line]
        if not (self.show_help or self.show_statistics or self.selected or messages):
            return
        canvas = self.frame.canvas()
        scale = self.view_renderer.text_scale(canvas)
        if self.selected is not None:
            draw_outline(self.frame, self.selected, WIDTH * scale)
            draw_block(canvas, selection_lines(self.selected), corner="bottom right", scale=scale)
        if self.show_help:
            self.help_pages = draw_help(canvas, self.help_page, scale)
        elif self.show_statistics:
            draw_block(canvas, self._statistics(), scale=scale)
        draw_block(canvas, messages, corner="bottom", scale=scale)

    def _statistics(self) -> list[str]:
        view_renderer = self.view_renderer
        return statistics_lines(
            self.frame_times.seconds,
            view_renderer.size,
            view_renderer.samples,
            self.frame.stats,
        )

    def _update_title(self) -> None:
        """Write the name and what frames take, now and then; at once where nothing moves."""
        now, idle = clock.monotonic(), not self._lively()
        if now < self._title_due and not idle:
            return
        self._title_due = now + TITLE_SECONDS
        parts = (self.view_renderer.viewed.title, "engine3d", self.frame_times.text(idle))
        title = printable(" - ".join(filter(None, parts)))
        if title != self._title:
            self._title = title
            self.window.title = title

    def say(self, message: str) -> None:
        """Show a message for a moment, which is longer for more words."""
        self._message = printable(message)
        seconds = max(MESSAGE_SECONDS, len(message) / READ_A_SECOND)
        self._message_ends = clock.monotonic() + seconds
        self.changed = True

    def select(self, x: int, y: int) -> None:
        """Select what shows at a pixel; where nothing does, nothing is selected any more."""
        self.selected = self.view_renderer.pick(self.view, self.time, x, y)
        self.changed = True

    def focus(self, x: int, y: int) -> None:
        """Move what shows at a pixel into the middle, and turn round it from now on."""
        hit = self.view_renderer.pick(self.view, self.time, x, y)
        if hit is None or not np.isfinite(hit.position).all():
            return
        ahead = linalg.dot(hit.position - self.view.position(), -self.view.rotation()[:, 2])
        self.view.target = hit.position.copy()
        if not self.view.orthographic:
            self.view.distance = max(MIN_DISTANCE, float(ahead))
        self.changed = True

    def open(self, paths) -> None:
        """Show other files; where one cannot be read, what is there stays, and why is said."""
        try:
            viewed = self._files.replace(paths)
        except (Engine3DError, MemoryError) as error:
            self.say(_reason(error))
            return
        self._show(viewed)
        self.time = 0.0
        self.playing = viewed.plays
        self.first_view = self.view_renderer.view()
        viewer_actions.reset_view(self)
        self.say(viewed.warnings[0] if viewed.warnings else f"opened {viewed.title}")

    def _reload(self) -> None:
        """Show the files as they are now; what is wrong with them is said until they are whole."""
        self.changed = True
        if missing := self._files.missing():
            self._trouble = printable(f"{', '.join(missing)} is not there: this is what it was")
            return
        try:
            viewed = self._files.reload()
        except (Engine3DError, MemoryError) as error:
            self._trouble = printable(_reason(error))
            return
        before = self.view_renderer.bounds
        self._show(viewed, keep_appearance=True)
        said = viewed.warnings[0] if viewed.warnings else f"loaded {viewed.title} again"
        if not self._in_view(before):
            said += "; it was out of view"
            self._frame_again()
        self.say(said)

    def _show(self, viewed, *, keep_appearance: bool = False) -> None:
        self.view_renderer.show(viewed, keep_appearance=keep_appearance)
        self.selected = None
        self._trouble = ""
        self._title_due = 0.0

    def _frame_again(self) -> None:
        """Look at all of what is shown now, from the same side; a reset does so from now on."""
        if self.walker is not None:
            viewer_actions.toggle_walking(self)
        for view in (self.view, self.first_view):
            self.view_renderer.frame(view)

    def _in_view(self, before: Sphere) -> bool:
        """Return whether the scene, which had other bounds before, is still worth looking at."""
        now = self.view_renderer.bounds
        alike = 1 / ALIKE < now.radius / before.radius < ALIKE
        return alike and self.view.sees(now, self.view_renderer.aspect)

    # Events

    def handle(self, event) -> None:
        """Obey one event of `engine3d.events`."""
        handler = _HANDLERS.get(type(event))
        if handler is not None:
            handler(self, event)

    def _key_down(self, event) -> None:
        self.fast = event.shift
        if self.walker is not None and self._walk_key(event):
            return
        if event.position in ORBIT_ARROWS and self.walker is None:
            right, up = ORBIT_ARROWS[event.position]
            self.orbit.turn(right * ARROW_RADIANS, up * ARROW_RADIANS)
            self.changed = True
            return
        action = action_for(event.key, event.position, event.control)
        if action is not None and not event.repeat:
            getattr(viewer_actions, action)(self, -1 if event.shift else 1)
            self.changed = True

    def _walk_key(self, event) -> bool:
        """Obey a key of walking mode; return whether it was one."""
        if event.key == "Escape":
            viewer_actions.toggle_walking(self)
            return True
        if event.position in MOVES or event.position in LOOKS:
            self.held_positions.add(event.position)
            return True
        return False

    def _key_up(self, event) -> None:
        self.held_positions.discard(event.position)
        if event.key == "C":
            self._unfreeze_culling()
        if event.key.endswith("Shift"):
            self.fast = False

    def _redraw(self, event) -> None:
        self.changed = True

    def _unfreeze_culling(self) -> None:
        self.view_renderer.freeze_culling(None)
        self.changed = True

    def _release_keys(self, event) -> None:
        self.held_positions.clear()
        self._unfreeze_culling()
        self.mouse.release()

    def _dropped(self, event) -> None:
        self.open(event.paths)

    def _close(self, event) -> None:
        self.running = False


_HANDLERS = {
    events.KeyDown: Viewer._key_down,
    events.KeyUp: Viewer._key_up,
    events.MouseButton: lambda viewer, event: viewer.mouse.button(event),
    events.MouseMotion: lambda viewer, event: viewer.mouse.motion(event),
    events.Wheel: lambda viewer, event: viewer.mouse.wheel(event),
    events.Resized: Viewer._redraw,
    events.Exposed: Viewer._redraw,
    events.Restored: Viewer._redraw,
    events.Minimised: Viewer._release_keys,
    events.FocusLost: Viewer._release_keys,
    events.FilesDropped: Viewer._dropped,
    events.CloseRequested: Viewer._close,
}


def _reason(error: Exception) -> str:
    return "out of memory" if isinstance(error, MemoryError) else str(error)
