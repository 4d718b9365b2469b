"""The animation's time at the bottom of the window: a thin bar, or a strip with a track
to drag, buttons to play and for the speed.

In: a `Canvas`, the time and speed, the mouse. Out: the same pixels, drawn on; what is under the
mouse.
"""

from __future__ import annotations

from typing import NamedTuple

from ....base.language import translated_number
from ....rendering.canvas import Canvas
from ....rendering.fonts.font import Font
from ....stage.overlays.theme import Theme
from ....stage.overlays.ui_scale import scaled

HEIGHT = 4
#: A time that is dragged stays before the end, which is the beginning again.
LAST_SHARE = 0.9999
#: Alpha of what is under the mouse, and of the rest of the track.
_HOVER_ALPHA, _TRACK_ALPHA = 40, 70


def draw_bar(canvas, share: float, *, scale: float, theme: Theme) -> None:
    """Draw the thin bar: the played part in one colour, the rest in another."""
    height, played = scaled(HEIGHT, scale), round(min(1.0, max(0.0, share)) * canvas.width)
    top = max(canvas.height - height, 0)
    canvas.rectangle(0, top, canvas.width, height, theme.block)
    if played:
        canvas.rectangle(0, top, played, height, theme.title)


class TimeLine(NamedTuple):
    """Where the parts of the strip are: columns of pixels, from each to the next.

    Attributes
    ----------
    play, track, clock, slower, speed, faster, end : int
        The left ends of the button that plays, of the track, of the time in seconds, of the speed
        with its two buttons; and the right end of the last one.
    """

    play: int
    track: int
    clock: int
    slower: int
    speed: int
    faster: int
    end: int

    def part_at(self, x: int) -> str | None:
        """Return the name of the part at a column."""
        found = (name for name, (left, right) in self.parts().items() if left <= x < right)
        return next(found, None)

    def parts(self) -> dict[str, tuple[int, int]]:
        """Return the left and right ends of the parts by name."""
        return dict(zip(self._asdict(), zip(self, self[1:], strict=False), strict=False))

    def share_at(self, x: int) -> float:
        """Return the share of the time at a column, clamped to the track."""
        inset = (self.clock - self.track) * 0.02
        share = (x - self.track - inset) / max(self.clock - self.track - 2 * inset, 1)
        return min(max(share, 0.0), LAST_SHARE)

    def column_at(self, share: float) -> float:
        """Return the column of a share of the time."""
        inset = (self.clock - self.track) * 0.02
        return self.track + inset + share * (self.clock - self.track - 2 * inset)


def time_line(width: int, period: float, font: Font) -> TimeLine:
    """Return the parts of a strip so wide."""
    button = round(2.2 * font.size)
    clock = font.width(_clock(period, period)) + font.size
    speed = font.width(_speed(0.25)) + font.size / 2
    right = [button, speed, button, clock]
    lefts = [width]
    for part in right:
        lefts.append(lefts[-1] - round(part))
    _, faster, speed_left, slower, clock_left = lefts
    return TimeLine(0, button, max(clock_left, button), slower, speed_left, faster, width)


def _clock(time: float, period: float) -> str:
    return f"{translated_number(time, '.2f')} / {translated_number(period, '.2f')} s"


def _speed(speed: float) -> str:
    return f"{translated_number(speed, 'g')}×"


def draw_time_line(
    canvas: Canvas,
    line: TimeLine,
    state: TimeState,
    hovered: str | None,
    font: Font,
    theme: Theme,
) -> None:
    """Draw the strip.

    Parameters
    ----------
    canvas : Canvas
        Over the strip.
    line : TimeLine
    state : TimeState
    hovered : str or None
        The part under the mouse.
    font : Font
    theme : Theme
    """
    canvas.clear((*theme.block[:3], 255))
    places = line.parts()
    if hovered in ("play", "slower", "faster"):
        left, right = places[hovered]
        canvas.rectangle(left, 0, right - left, canvas.height, (*theme.text[:3], _HOVER_ALPHA))
    middle = canvas.height / 2
    color = theme.title if state.playing else theme.text
    _draw_play((line.play + line.track) / 2, canvas, state.playing, font, color)
    _draw_track(canvas, line, state.time / state.period, hovered == "track", font, theme)
    y = round(middle - font.line_height / 2)
    canvas.text(
        line.clock + font.size // 2, y, _clock(state.time, state.period), theme.text, font=font
    )
    for text, name in (("−", "slower"), (_speed(state.speed), "speed"), ("+", "faster")):
        left, right = places[name]
        lit = name == "speed" and state.speed != 1.0
        x = (left + right - font.width(text)) // 2
        canvas.text(x, y, text, theme.title if lit else theme.text, font=font)


class TimeState(NamedTuple):
    """The time and the period of an animation in seconds, its speed, and whether it plays."""

    time: float
    period: float
    speed: float
    playing: bool


def _draw_play(x: float, canvas: Canvas, playing: bool, font: Font, color) -> None:
    """Draw two bars while it plays, otherwise a triangle."""
    y, half = canvas.height / 2, font.size * 0.38
    if playing:
        for side in (-1, 1):
            left = x + side * half * 0.6 - half * 0.25
            canvas.rectangle(
                round(left), round(y - half), max(round(half / 2), 1), round(2 * half), color
            )
        return
    canvas.polygon([(x - half * 0.7, y - half), (x + half, y), (x - half * 0.7, y + half)], color)


def _draw_track(
    canvas: Canvas, line: TimeLine, share: float, is_hovered: bool, font: Font, theme: Theme
) -> None:
    start, end = line.column_at(0.0), line.column_at(1.0)
    here, y = line.column_at(min(max(share, 0.0), 1.0)), canvas.height / 2
    high = max(round(font.size / 5), 2)
    for right, color in ((end, (*theme.text[:3], _TRACK_ALPHA)), (here, theme.title)):
        canvas.rectangle(start, round(y - high / 2), right - start, high, color)
    canvas.disc(here, y, font.size * (0.42 if is_hovered else 0.34), theme.title)
