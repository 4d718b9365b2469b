"""The controls beside the picture: they lay out the window, draw themselves, and take the mouse.

In: a viewer, mouse events in pixels of the window. Out: strips and the ball of axes, drawn;
commands called; other events, in pixels of the picture. Nothing of it lies over the picture but the
ball, in a free corner.
"""

from __future__ import annotations

import math
import time as clock
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ....rendering.canvas import Canvas
from ....rendering.fonts.font import Font
from ....stage.overlays.axes_ball import RADIUS, BallPlace, draw_ball, tip_at, turn_to
from ....stage.overlays.lettering import table_font, text_font
from ....stage.overlays.overlay import MARGIN, PADDING
from ....stage.overlays.theme import Theme
from ....stage.overlays.ui_scale import scale_for, scaled
from ... import events
from ..help_panel import CommandPanel
from ..kept_drawing import KeptDrawing
from ..mouse import CLICK_REACH
from .animation_bar import TimeState, draw_time_line, time_line
from .menu_bar import Button, bar_buttons, bar_height, button_at, draw_menu_bar, lit_buttons
from .window_layout import Rectangle, WindowLayout, has_room, lay_out

if TYPE_CHECKING:
    from ..viewer import Viewer

#: Characters of a line of the statistics.
SIDE_COLUMNS = 46
#: Seconds between statistics in motion: faster, nobody could read them.
_READ_SECONDS = 0.25
#: Diameters of the ball that a drag over makes one turn.
_BALL_TURN = 2.0


class Controls:
    """The bar, the time line, the column of statistics and the ball of axes.

    Parameters
    ----------
    viewer : Viewer

    Attributes
    ----------
    shown : bool
        Whether a window with room for them has a bar, a time line and a ball; assignable.
    layout : WindowLayout
        Of the last frame.
    """

    def __init__(self, viewer: Viewer):
        self._viewer = viewer
        self.shown = False
        self.layout = WindowLayout(viewer.window.size, Rectangle(0, 0, *viewer.window.size))
        #: The part under the mouse: that of a strip, or of the ball.
        self._hovered: tuple[str, str | None] = ("", None)
        self._held = ""
        self._travelled = 0
        self._bar, self._side = KeptDrawing(), KeptDrawing()
        self._kept_ball = KeptDrawing(is_clear=True)
        self._told: list[str] = []
        self._due = 0.0
        self._buttons: list[Button] = []
        self._laid_out: tuple[int, Font] | None = None

    # The window

    @property
    def scale(self) -> float:
        """The factor on the size of texts over and beside the picture."""
        width, height = self._viewer.window.size
        chosen = self._viewer.view_renderer.settings.ui_scale
        return chosen or scale_for(width, height, self._viewer.view_renderer.screen_scale)

    @property
    def _has_strips(self) -> bool:
        viewer = self._viewer
        return not viewer.window.writes_text and has_room(viewer.window.size, self.scale)

    @property
    def has_bar(self) -> bool:
        """Whether the window has a bar, a time line and a ball now."""
        return self.shown and self._has_strips

    def arrange(self) -> WindowLayout:
        """Lay the window out for the next frame, and return how."""
        scale, viewer = self.scale, self._viewer
        strip = bar_height(text_font(scale))
        moves = viewer.view_renderer.viewed.update is not None
        side = table_font(scale).width("0") * SIDE_COLUMNS + 2 * scaled(PADDING, scale)
        self.layout = lay_out(
            viewer.window.size,
            bar=strip if self.has_bar else 0,
            time=strip if self.has_bar and moves else 0,
            side=side if self._has_strips and viewer.statistics == "long" else 0,
            scale=scale,
        )
        return self.layout

    def draw(self, pixels: np.ndarray) -> None:
        """Draw the strips on the window's pixels, (H, W, 4), around the picture."""
        layout, viewer = self.layout, self._viewer
        theme, font = viewer.view_renderer.theme, text_font(self.scale)
        if layout.bar is not None:
            self._draw_bar(layout.bar, pixels, font, theme)
        if layout.time is not None:
            canvas = Canvas(layout.time.of(pixels))
            period = viewer.view_renderer.viewed.period
            state = TimeState(viewer.time, period, viewer.speed, viewer.playing)
            line = time_line(canvas.width, period, font)
            draw_time_line(canvas, line, state, self._part("time"), font, theme)
        if layout.side is not None:
            self._draw_side(layout.side, pixels, theme)

    def _draw_bar(self, bar: Rectangle, pixels: np.ndarray, font: Font, theme: Theme) -> None:
        """Draw the bar, with the short statistics if there is room."""
        buttons, chosen = self.buttons, self._open_menu or self._part("bar")
        lit = lit_buttons(buttons, self._viewer)
        line = self._viewer.statistics_lines()[0] if self.holds_line else ""
        shows = buttons, lit, chosen, line, font, theme
        size = bar.width, bar.height
        self._bar.put(bar.of(pixels), size, shows, lambda canvas: draw_menu_bar(canvas, *shows))

    @property
    def holds_line(self) -> bool:
        """Whether the short statistics stand in the bar, rather than over the picture."""
        viewer = self._viewer
        if self.layout.bar is None or viewer.statistics != "short":
            return False
        font, buttons = text_font(self.scale), self.buttons
        (text,) = viewer.statistics_lines()
        free = buttons[-1].left - buttons[-2].left - buttons[-2].width
        return font.width(text) + 2 * font.size < free

    def _draw_side(self, side: Rectangle, pixels: np.ndarray, theme: Theme) -> None:
        """Write the statistics into their column; in motion, a few times a second."""
        viewer, now = self._viewer, clock.monotonic()
        moves = viewer.playing or bool(viewer.held_positions)
        if not moves or now >= self._due:
            self._told, self._due = viewer.statistics_lines(), now + _READ_SECONDS
        font, size = table_font(self.scale), (side.width, side.height)
        shows = self._told, font, scaled(PADDING, self.scale), theme
        self._side.put(side.of(pixels), size, shows, lambda canvas: _write_lines(canvas, *shows))

    def draw_ball(self, canvas: Canvas) -> None:
        """Draw the ball of axes on the picture."""
        place = self._ball
        if place is None:
            return
        rotation, theme = self._viewer.view.rotation(), self._viewer.view_renderer.theme
        is_hovered = self._hovered[0] == "ball" or self._held == "ball"
        how = {"theme": theme, "lit": self._part("ball"), "is_hovered": is_hovered}
        half = math.ceil(place.radius) + 1
        left, top = round(place.x) - half, round(place.y) - half
        moved = place._replace(x=place.x - left, y=place.y - top)
        self._kept_ball.put(
            canvas.pixels[top:, left:],
            (2 * half, 2 * half),
            (rotation.tobytes(), moved, how),
            lambda kept: draw_ball(kept, rotation, moved, **how),
        )

    @property
    def _ball(self) -> BallPlace | None:
        """Where the ball is in the picture: at the right, where no text is."""
        viewer = self._viewer
        if not self.has_bar or viewer.walker is not None or viewer.view_renderer.split:
            return None
        radius = RADIUS * self.scale
        inset = radius + scaled(MARGIN, self.scale)
        height, panel = self.layout.picture.height, viewer.panel
        is_list_above = panel is not None and panel.corner == "top right"
        if not viewer.view_renderer.settings.metadata and not is_list_above:
            y = inset
        else:
            y = height - inset if viewer.selected is None else height / 2
        return BallPlace(self.layout.picture.width - inset, y, radius)

    @property
    def buttons(self) -> list[Button]:
        """The buttons of the bar."""
        width, font = self._viewer.window.size[0], text_font(self.scale)
        if self._laid_out != (width, font):
            self._laid_out, self._buttons = (width, font), bar_buttons(width, font)
        return self._buttons

    @property
    def _open_menu(self) -> str:
        panel = self._viewer.panel
        return panel.section if isinstance(panel, CommandPanel) else ""

    # The mouse

    @property
    def holds_time(self) -> bool:
        """Whether the mouse drags the animation's time."""
        return self._held == "time"

    def release(self) -> None:
        """Forget a pressed button."""
        self._held = ""

    def take(self, event: Any) -> Any | None:
        """Handle a mouse event, in pixels of the window.

        Returns
        -------
        event or None
            The same in pixels of the picture, if it is for what the picture shows.
        """
        picture = self.layout.picture
        moved = replace(event, x=event.x - picture.left, y=event.y - picture.top)
        if self._viewer.walker is not None and self._viewer.panel is None:
            return moved  # the mouse is captured
        if isinstance(event, events.MouseMotion):
            is_used = self._motion(event, moved)
        elif isinstance(event, events.MouseButton):
            is_used = self._press(event, moved) if event.down else self._let_go(moved)
        else:
            is_used = not picture.covers(event.x, event.y)
        return None if is_used else moved

    def leave(self) -> None:
        """Take note that the mouse has left the window."""
        self._hover(("", None))

    def _motion(self, event: Any, moved: Any) -> bool:
        viewer = self._viewer
        if self._held == "time":
            self._seek(event.x)
        elif self._held == "ball":
            self._turn_ball(event)
        if self._held:
            return True
        if viewer.walker is not None or viewer.mouse.drag is not None:
            self._hover(("", None))
            return False
        self._hover(self._part_at(event, moved))
        return False

    def _part_at(self, event: Any, moved: Any) -> tuple[str, str | None]:
        """Return the part under the mouse."""
        viewer, layout = self._viewer, self.layout
        if layout.bar is not None and layout.bar.covers(event.x, event.y):
            button = button_at(self.buttons, event.x)
            return "bar", None if button is None else button.text
        if layout.time is not None and layout.time.covers(event.x, event.y):
            return "time", self._time_line.part_at(event.x)
        panel, ball = viewer.panel, self._ball
        if panel is not None and panel.covers(moved.x, moved.y):
            return "", None
        if ball is not None and ball.covers(moved.x, moved.y):
            return "ball", tip_at(viewer.view.rotation(), ball, moved.x, moved.y)
        return "", None

    def _part(self, where: str) -> str | None:
        return self._hovered[1] if self._hovered[0] == where else None

    def _hover(self, part: tuple[str, str | None]) -> None:
        if part != self._hovered:
            self._hovered = part
            self._viewer.redraw_controls()
        is_other = part[0] == "bar" and part[1] is not None and part[1] != self._open_menu
        if is_other and self._viewer.panel is not None and self._viewer.panel.closes_beside:
            button = next(one for one in self.buttons if one.text == part[1])
            if button.binding is None:
                self.open_menu(button)

    def _press(self, event: Any, moved: Any) -> bool:
        """Handle a pressed button; return whether it was for the controls."""
        viewer = self._viewer
        self.release()
        part = self._part_at(event, moved)
        menu = self._open_menu
        if viewer.panel is not None and viewer.panel.closes_beside:
            if viewer.panel.covers(moved.x, moved.y):
                return False
            viewer.panel.close()
            if part[0] != "bar" or part[1] == menu:
                return True
        if part[0] == "bar":
            self._press_bar(event)
        elif part[0] == "time":
            self._press_time(part[1], event)
        elif part[0] == "ball" and viewer.walker is None:
            self._held, self._travelled = "ball", 0
        return bool(part[0]) or not self.layout.picture.covers(event.x, event.y)

    def _press_bar(self, event: Any) -> None:
        button = button_at(self.buttons, event.x)
        if button is None:
            return
        if button.binding is None:
            self.open_menu(button)
        else:
            backwards = event.shift or event.button != "left"
            self._viewer.perform(button.binding.action, -1 if backwards else 1)

    def open_menu(self, button: Button) -> None:
        """Open the menu of a theme of commands."""
        self._viewer.panel = CommandPanel(self._viewer, button.text, button.left)

    @property
    def _time_line(self):
        period = self._viewer.view_renderer.viewed.period
        return time_line(self.layout.time.width, period, text_font(self.scale))

    def _press_time(self, part: str | None, event: Any) -> None:
        actions = {"play": "toggle_playing", "slower": "play_slower", "faster": "play_faster"}
        if part in actions:
            self._viewer.perform(actions[part])
        elif part == "track":
            self._held = "time"
            self._seek(event.x)

    def _seek(self, x: int) -> None:
        viewer = self._viewer
        viewer.time = self._time_line.share_at(x) * viewer.view_renderer.viewed.period
        viewer.redraw()

    @property
    def _is_click(self) -> bool:
        """Whether the mouse moved no further than in a click."""
        return self._travelled <= CLICK_REACH * max(self.scale, 1.0)

    def _turn_ball(self, event: Any) -> None:
        self._travelled += abs(event.dx) + abs(event.dy)
        if not self._is_click:
            turn = round(2 * _BALL_TURN * RADIUS * self.scale)
            self._viewer.orbit.rotate(event.dx, event.dy, turn)
            self._viewer.redraw()

    def _let_go(self, moved: Any) -> bool:
        """Handle a released button; return whether the controls had been pressed."""
        viewer, held = self._viewer, self._held
        self.release()
        ball = self._ball
        if held == "ball" and self._is_click and ball is not None:
            name = tip_at(viewer.view.rotation(), ball, moved.x, moved.y)
            if name is not None:
                turn_to(viewer.view, name)
        if held:
            viewer.redraw()
        return bool(held)


def _write_lines(canvas: Canvas, lines: list[str], font: Font, padding: int, theme: Theme) -> None:
    """Write as many lines of a column as fit, wrapped to its width."""
    canvas.clear((*theme.block[:3], 255))
    width = max(canvas.width - 2 * padding, 1)
    wrapped = [part for line in lines for part in font.wrapped(line, width)]
    rows = max((canvas.height - 2 * padding) // font.line_height, 1)
    for row, text in enumerate(wrapped[:rows]):
        canvas.text(padding, padding + row * font.line_height, text, theme.text, font=font)
