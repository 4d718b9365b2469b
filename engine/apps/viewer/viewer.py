"""The viewer's loop: events in, frames out, as long as the window is open.

In: a `ViewRenderer` and a `Window` (or anything with its methods). Out: frames on the screen.
A frame is drawn only when something changed, moves or is walked through; otherwise the loop sleeps
until the next event, and it does nothing at all while the window is minimised.
"""

from __future__ import annotations

import math
import time as clock

from ...base.language import translated
from ...stage.overlays.frame_times import FrameTimes
from ...stage.overlays.overlay import draw_block, short_statistics, statistics_lines
from ...stage.overlays.selection_outline import (
    OUTLINE_OUTPUTS,
    WIDTH,
    draw_outline,
    selection_lines,
)
from ...stage.view_renderer import ViewRenderer
from ...stage.views.fps import LOOKS, MOVES
from .. import events
from . import actions as viewer_actions
from .animation_bar import draw_bar
from .help_panel import KeyAt, draw_help, help_lines
from .keymap import REPEATED, action_for
from .model_files import ModelFiles
from .mouse import Mouse
from .opened_files import Opening
from .sampling import Sampling
from .state import ViewerState
from .title_bar import TitleBar

#: Sleep time of the idle loop, and interval of checks for file changes.
IDLE_SECONDS = 0.25
#: A pause in the loop (a slow load, a dragged window) must not throw the walker through a wall.
LONGEST_STEP = 0.1


class Viewer(ViewerState):
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
    sampling : Sampling, optional
        Chooses the samples per pixel; by default always as many as the renderer takes.
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
        sampling: Sampling | None = None,
    ):
        super().__init__(view_renderer, window, view, sampling)
        view_renderer.screen_scale = window.scale
        if playing is not None:
            self.playing = playing
        self.statistics = "long" if statistics else None
        self.frame = None
        self.mouse = Mouse(self)
        self.frame_times = FrameTimes()
        self.opening = Opening(self, files or ModelFiles())
        self._title = TitleBar(window)
        self._last_turn = clock.monotonic()
        if walking:
            self.toggle_walking()

    # The loop

    def run(self, frames: int | None = None) -> None:
        """Show frames until the window closes, or until ``frames`` have been drawn.

        With a number of frames, they are drawn even if nothing moves.
        """
        drawn = 0
        self._last_turn = clock.monotonic()
        while self.running and (frames is None or drawn < frames):
            if frames is not None:
                self.redraw()
            drawn += self.run_once()

    def run_once(self) -> bool:
        """Handle pending events; return whether a frame was drawn."""
        for event in self.window.events(0.0 if self.lively else self._patience()):
            self.handle(event)
        now = clock.monotonic()
        self.advance(min(now - self._last_turn, LONGEST_STEP))
        self._last_turn = now
        rests = self.sampling.until_rest() <= 0.0
        drawn = (self.changed or rests) and self.running and not self.window.minimised
        if drawn:
            self.draw(self.sampling.in_motion() if self.changed else self.sampling.at_rest())
        idle = not self.lively
        name = self.view_renderer.viewed.title
        self._title.write(name, lambda: self.frame_times.text(idle), at_once=idle)
        return drawn

    def _patience(self) -> float:
        """Return how long to wait for an event."""
        return min(IDLE_SECONDS, self.sampling.until_rest())

    @property
    def lively(self) -> bool:
        """Whether the next frame should be drawn without waiting for an event."""
        if self.window.minimised:
            return False
        return self.changed or self.playing or self._walking_now()

    def _walking_now(self) -> bool:
        return self.walker is not None and bool(self.held_positions)

    def advance(self, seconds: float) -> None:
        """Advance the time by ``seconds``: animation, walking, messages, file changes."""
        if self.playing and not self.window.minimised:
            self._play(seconds)
        if self.walker is not None and self.walker.walk(self.held_positions, seconds, self.fast):
            self.walker.place(self.view)
            self.redraw()
        if self.messages.pass_by():
            self.redraw()
        self.opening.look_for_changes()

    def _play(self, seconds: float) -> None:
        viewed = self.view_renderer.viewed
        self.redraw()
        self.time = (self.time + seconds) % viewed.period
        if viewed.update is None and self.walker is None and self.mouse.drag is None:
            self.orbit.turn(2 * math.pi * seconds / viewed.period, 0.0)

    def draw(self, samples: int | None = None) -> None:
        """Draw one frame with its overlays, and show it.

        Parameters
        ----------
        samples : int, optional
            Samples per pixel; by default as many as while nothing moves.
        """
        self.view_renderer.samples = samples or self.sampling.at_rest()
        start = clock.monotonic()
        width, height = self.window.size
        self.view_renderer.resize((width, height))
        self._changed = False
        outputs = ("color",) if self.selected is None else OUTLINE_OUTPUTS
        self.frame = self.view_renderer.draw(self.view, self.time, outputs)
        if not self.window.writes_text:
            self._draw_overlays()
        drawn = clock.monotonic()
        self.sampling.add(self.view_renderer.samples, drawn - start)
        self.window.present(self.frame.color)
        if self.window.writes_text:
            self.window.write(self._overlay_lines())
        self.frame_times.add(drawn - start, clock.monotonic() - start)

    def _draw_overlays(self) -> None:
        canvas = self.frame.canvas()
        scale = self.view_renderer.text_scale(canvas)
        look = {"scale": scale, "theme": self.view_renderer.theme}
        if self.selected is not None:
            if not self.view_renderer.split:
                draw_outline(self.frame, self.selected, WIDTH * scale)
            draw_block(canvas, self._selection(), corner="bottom right", **look)
        if self.help.shown:
            self.help.count = draw_help(canvas, self.help.page, **look, key_at=self._walking_keys())
        elif self.statistics:
            draw_block(canvas, self._statistics(), is_table=self.statistics != "short", **look)
        if self.panel is not None:
            self.panel.draw(canvas, **look)
        viewed = self.view_renderer.viewed
        if viewed.player is not None:
            draw_bar(canvas, self.time / viewed.period, **look)
        draw_block(canvas, self.messages.lines(), corner="bottom", **look)

    def _overlay_lines(self) -> list[str]:
        """Return the overlays as lines, for a window that writes text."""
        lines = [] if self.selected is None else self._selection()
        if self.help.shown:
            page, self.help.count = help_lines(
                *self.window.text_room, self.help.page, self._walking_keys()
            )
            lines += page
        elif self.statistics:
            lines += self._statistics()
        if self.panel is not None:
            lines += self.panel.lines()
        return lines + self.messages.lines()

    def _walking_keys(self) -> KeyAt | None:
        return None if self.walker is None else self.window.key_at

    def _selection(self) -> list[str]:
        return selection_lines(self.selected, self.view_renderer.viewed.origin)

    def _statistics(self) -> list[str]:
        view_renderer = self.view_renderer
        if self.statistics == "short":
            return [short_statistics(self.frame_times, view_renderer.stats)]
        x, y, z = self.view.position()
        return statistics_lines(
            self.frame_times.seconds,
            view_renderer.size,
            view_renderer.samples,
            view_renderer.stats,
            translated("camera at {x:.4g}, {y:.4g}, {z:.4g}", x=x, y=y, z=z),
            view_renderer.appearance.culling,
        )

    # Events

    def handle(self, event) -> None:
        """Handle one event of `engine3d.events`."""
        handler = _HANDLERS.get(type(event))
        if handler is not None:
            handler(self, event)

    def _key_down(self, event) -> None:
        self.fast = event.shift
        if self.panel is not None and self.panel.key(event):
            return
        if self.walker is not None and self._walk_key(event):
            return
        action = action_for(event.key, event.position, event.control, event.shift)
        if action is not None and (not event.repeat or action in REPEATED):
            getattr(viewer_actions, action)(self, -1 if event.shift else 1)
            self.redraw()

    def _walk_key(self, event) -> bool:
        """Handle a key in walking mode; return whether it was one."""
        if event.key == "Escape":
            self.toggle_walking()
            return True
        if (event.position in MOVES or event.position in LOOKS) and not event.control:
            self.held_positions.add(event.position)
            return True
        return False

    def _key_up(self, event) -> None:
        self.held_positions.discard(event.position)
        if event.key == "C":
            self._unfreeze_culling()
        if event.key.endswith("Shift"):
            self.fast = False

    def _typed(self, event) -> None:
        if self.panel is not None:
            self.panel.type(event.text)

    def _redraw(self, event) -> None:
        self.view_renderer.screen_scale = self.window.scale  # it may have moved to another screen
        self.redraw()

    def _unfreeze_culling(self) -> None:
        self.view_renderer.freeze_culling(None)
        self.redraw()

    def _release_keys(self, event) -> None:
        self.held_positions.clear()
        self._unfreeze_culling()
        self.mouse.release()

    def _dropped(self, event) -> None:
        self.opening.open(event.paths)

    def _close(self, event) -> None:
        self.running = False


_HANDLERS = {
    events.KeyDown: Viewer._key_down,
    events.KeyUp: Viewer._key_up,
    events.TextEntered: Viewer._typed,
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
