"""The viewer's loop: events in, frames out, as long as the window is open.

In: a `ViewRenderer` and a `Window` (or anything with its methods). Out: frames on the screen.
A frame is drawn only when something changed, moves or is walked through; otherwise the loop sleeps
until the next event, and it does nothing at all while the window is minimised.
"""

from __future__ import annotations

import math
import time as clock

from ...base.language import translated
from ...rendering.canvas import Canvas
from ...stage.overlays.frame_statistics import short_statistics, statistics_lines
from ...stage.overlays.frame_times import FrameTimes
from ...stage.overlays.overlay import draw_block
from ...stage.overlays.selection_outline import (
    OUTLINE_OUTPUTS,
    WIDTH,
    draw_outline,
    selection_lines,
)
from ...stage.overlays.ui_scale import scaled
from ...stage.view_renderer import ViewRenderer
from ...stage.views.fps import LOOKS, MOVES
from .. import events
from . import actions as viewer_actions
from .controls.animation_bar import draw_bar
from .controls.controls import Controls
from .controls.window_pixels import WindowPixels
from .keymap import REPEATED, TYPED_KEYS, action_for
from .model_files import ModelFiles
from .mouse import Mouse
from .opened_files import Opening
from .sampling import Sampling
from .state import ViewerState
from .title_bar import TitleBar

#: Sleep time of the idle loop, and interval of checks for file changes.
IDLE_SECONDS = 0.25
#: What is said first; it goes away by itself.
HINT = "H, F1 or /: all commands"
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

    Attributes
    ----------
    controls : Controls
        What is beside the picture; its attribute ``shown`` is False at first.
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
        self.controls = Controls(self)
        self._pixels = WindowPixels()
        self._types_text = True
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
        elif self._stale == "controls" and self.frame is not None and not self.window.minimised:
            self._show(self._over_frame())
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
        if self.playing and not self.controls.holds_time and not self.window.minimised:
            self._play(seconds * self.speed)
        if self.walker is not None and self.walker.walk(self.held_positions, seconds, self.fast):
            self.walker.place(self.view)
            self.redraw()
        if self.messages.pass_by():
            self.redraw_controls()
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
        picture = self.controls.arrange().picture
        self.view_renderer.resize((picture.width, picture.height))
        self._stale = ""
        outputs = ("color",) if self.selected is None else OUTLINE_OUTPUTS
        self.frame = self.view_renderer.draw(self.view, self.time, outputs)
        if self.selected is not None and not self.view_renderer.split:
            draw_outline(self.frame, self.selected, scaled(WIDTH, self.controls.scale))
        pixels = self._over_frame()
        drawn = clock.monotonic()
        self.sampling.add(self.view_renderer.samples, drawn - start)
        self._show(pixels)
        core = self.view_renderer.stats.get("ms_total", 0.0) / 1000
        self.frame_times.add(drawn - start, clock.monotonic() - start, core)
        if self.statistics and not self.lively:
            self.redraw_controls()  # its own times are known now

    def _show(self, pixels) -> None:
        """Show the window's pixels."""
        if self._stale == "controls":
            self._stale = ""
        self.window.present(pixels)
        if self.window.writes_text:
            self.window.write(self._overlay_lines())

    def _over_frame(self):
        """Return the window's pixels: the last frame, what lies over it, the strips beside it."""
        if self.window.writes_text:
            return self._marked_frame()
        layout = self.controls.layout
        pixels, picture = self._pixels.with_picture(self.frame.color, layout)
        self.controls.draw(pixels)
        self._draw_overlays(Canvas(picture))
        return pixels

    def _marked_frame(self):
        """Return the last frame with the panel's marks, for a window that writes the panel."""
        if self.panel is None:
            return self.frame.color
        pixels = self.frame.color.copy()
        self.panel.mark(Canvas(pixels), self.controls.scale, self.view_renderer.theme)
        return pixels

    def _draw_overlays(self, canvas: Canvas) -> None:
        look = {"scale": self.controls.scale, "theme": self.view_renderer.theme}
        layout = self.controls.layout
        self.controls.draw_ball(canvas)
        if self.selected is not None:
            draw_block(canvas, self._selection(), corner="bottom right", **look)
        if self.statistics and layout.side is None and not self.controls.holds_line:
            is_table = self.statistics != "short"
            draw_block(canvas, self.statistics_lines(), is_table=is_table, **look)
        viewed = self.view_renderer.viewed
        if viewed.player is not None and layout.time is None:
            draw_bar(canvas, self.time / viewed.period, **look)
        draw_block(canvas, self.messages.lines(), corner="bottom", **look)
        if self.panel is not None:
            self.panel.mark(canvas, **look)
            self.panel.draw(canvas, **look)

    def _overlay_lines(self) -> list[str]:
        """Return the overlays as lines, for a window that writes text."""
        lines = [] if self.selected is None else self._selection()
        if self.statistics:
            lines += self.statistics_lines()
        if self.panel is not None:
            lines += self.panel.lines()
        return lines + self.messages.lines()

    def _selection(self) -> list[str]:
        return selection_lines(self.selected, self.view_renderer.viewed.origin)

    def statistics_lines(self) -> list[str]:
        """Return the statistics of the last frame: a line, or all."""
        view_renderer = self.view_renderer
        # At rest a mean would be of frames in motion, and not of the one whose stages are told.
        times = self.frame_times if self.lively else self.frame_times.last()
        if self.statistics == "short":
            return [short_statistics(times, view_renderer.stats)]
        x, y, z = self.view.position()
        return statistics_lines(
            times,
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
        self._types_text = True
        if self.panel is not None and self.panel.key(event):
            return
        self._types_text = False  # what this key types is a command, perhaps one that opens a list
        if self.walker is not None and self._walk_key(event):
            return
        action = action_for(event.key, event.position, event.control, event.shift)
        if action is None:
            self._types_text = True
        elif not event.repeat or action in REPEATED:
            self.perform(action, -1 if event.shift else 1)

    def perform(self, action: str, step: int = 1) -> None:
        """Call one of the `actions`, forwards or backwards, and draw what has become of it."""
        getattr(viewer_actions, action)(self, step)
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
        if not self._types_text:
            return
        if self.panel is not None:
            self.panel.type(event.text)
        elif event.text in TYPED_KEYS and self.walker is None:
            self.perform(TYPED_KEYS[event.text])

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
        self.controls.release()

    def _mouse(self, event) -> None:
        """Hand a mouse event to the controls or, if it is not for them, to the picture."""
        passed = self.controls.take(event)
        if passed is not None:
            _MOUSE[type(event)](self.mouse, passed)

    def _dropped(self, event) -> None:
        self.opening.open(event.paths)

    def _close(self, event) -> None:
        self.running = False


_MOUSE = {
    events.MouseButton: Mouse.button,
    events.MouseMotion: Mouse.motion,
    events.Wheel: Mouse.wheel,
}
_HANDLERS = {
    events.KeyDown: Viewer._key_down,
    events.KeyUp: Viewer._key_up,
    events.TextEntered: Viewer._typed,
    events.MouseButton: Viewer._mouse,
    events.MouseMotion: Viewer._mouse,
    events.Wheel: Viewer._mouse,
    events.MouseLeft: lambda viewer, event: viewer.controls.leave(),
    events.Resized: Viewer._redraw,
    events.Exposed: Viewer._redraw,
    events.Restored: Viewer._redraw,
    events.Minimised: Viewer._release_keys,
    events.FocusLost: Viewer._release_keys,
    events.FilesDropped: Viewer._dropped,
    events.CloseRequested: Viewer._close,
}
