"""Text and lines around panels: dimensions, axes, titles, a scale.

In: a canvas over the sheet, rectangles, lengths. Out: the same pixels, drawn on.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...rendering.canvas import Canvas, lay_over
from ...rendering.fonts.fitting import most_kept
from ...stage.overlays.lengths import exponent, length_text
from ...stage.overlays.lettering import text_font
from ...stage.overlays.overlay import AXIS_COLORS
from ...stage.overlays.theme import DARK, Rgba, Theme
from .layout import Rectangle

#: X, Y and Z on a light background: the usual red, green and blue, darker.
_DARK_AXES = ((196, 44, 44, 255), (30, 132, 44, 255), (44, 84, 214, 255))
_ARROW = 7
#: Reach of the strokes at the ends of dimensions, to either side.
_TICK = 5
_AXIS = 15
#: Height of a view's name in rows.
_NAME = 24


def short(text: str, most: int, width: Callable[[str], int]) -> str:
    """Return a text shortened to a maximum width, by omitting its middle."""
    if width(text) <= most:
        return text

    def shortened(kept: int) -> str:
        head = (kept * 3 + 4) // 5
        return f"{text[:head]}…{text[len(text) - kept + head :]}"

    kept = most_kept(shortened, len(text), most, width)
    return shortened(kept) if kept >= 0 else ""


def line_color(theme: Theme) -> Rgba:
    """Return the colour of dimensions."""
    return (150, 158, 170, 255) if theme is DARK else (96, 104, 118, 255)


def draw_width(
    canvas: Canvas, left: float, right: float, y: float, text: str, theme: Theme, scale: int
) -> None:
    """Draw a dimension below a drawing, between two columns at a row."""
    first, last = _draw_length(canvas, left, right, y, theme, scale, is_level=True)
    font = text_font(scale)
    place = max((first + last + 1 - font.width(text)) // 2, 2)
    canvas.text(place, y + (_TICK + 1) * scale, text, theme.text, font=font)


def draw_height(
    canvas: Canvas, top: float, bottom: float, x: float, text: str, theme: Theme, scale: int
) -> None:
    """Draw a dimension at the left of a drawing; its text reads from below."""
    first, last = _draw_length(canvas, top, bottom, x, theme, scale, is_level=False)
    width, height = text_font(scale).text_size(text)
    # Not over the view's name.
    y = max((first + last + 1 - width) // 2, _NAME * scale)
    _text_upward(canvas, x - (_TICK + 2) * scale - height, y, text, theme.text, scale)


def _draw_length(
    canvas: Canvas,
    start: float,
    end: float,
    place: float,
    theme: Theme,
    scale: int,
    *,
    is_level: bool,
) -> tuple[int, int]:
    """Draw a line between two columns at a row, or two rows at a column; return its ends."""

    def at(along: float, across: float) -> tuple[float, float]:
        return (along, across) if is_level else (across, along)

    color, tick = line_color(theme), _TICK * scale
    first, last = math.floor(start), math.ceil(end) - 1
    for one in (first, last):
        canvas.line(*at(one, place - tick), *at(one, place + tick), color, width=scale)
    canvas.line(*at(first, place), *at(last, place), color, width=scale)
    if last - first > 3 * _ARROW * scale:
        for one, way in ((first, 1), (last, -1)):
            _arrow(canvas, at(one, place), at(way, 0), color, scale)
    return first, last


def _arrow(canvas: Canvas, tip, way, color: Rgba, scale: int) -> None:
    x, y = tip[0] + 0.5, tip[1] + 0.5
    along, aside = _ARROW * scale, 2.5 * scale
    base_x, base_y = x + way[0] * along, y + way[1] * along
    a = base_x + way[1] * aside, base_y + way[0] * aside
    b = base_x - way[1] * aside, base_y - way[0] * aside
    canvas.triangle((x, y), a, b, color)


def _text_upward(canvas: Canvas, x: float, y: float, text: str, color: Rgba, scale: int) -> None:
    """Write a text rotated by a quarter turn, from bottom to top."""
    font = text_font(scale)
    width, height = font.text_size(text)
    turned = Canvas(np.zeros((height, width, 4), np.uint8))
    turned.text(0, 0, text, color, font=font)
    ink = np.rot90(turned.pixels)
    left, top = round(x), round(y)
    window = canvas.pixels[max(top, 0) : top + width, max(left, 0) : left + height]
    ink = ink[max(-top, 0) :, max(-left, 0) :][: window.shape[0], : window.shape[1]]
    lay_over(window, ink)


def draw_triad(
    canvas: Canvas, x: float, y: float, axes: np.ndarray, theme: Theme, scale: int
) -> None:
    """Draw the file's axes as a camera sees them, around a point.

    Parameters
    ----------
    axes : (3, 3) ndarray of float64
        The camera's: columns right, up and back in world space.
    """
    colors = AXIS_COLORS if theme is DARK else _DARK_AXES
    length, letters = _AXIS * scale, (_AXIS + 6) * scale
    for (right, up, _), letter, color in sorted(
        zip(axes.tolist(), "XYZ", colors, strict=True), key=lambda axis: axis[0][2]
    ):
        if abs(right) + abs(up) < 1e-6:  # towards the viewer, or away
            canvas.rectangle(x - 2 * scale, y - 2 * scale, 4 * scale, 4 * scale, color)
            continue
        end = round(x + right * length), round(y - up * length)
        canvas.line(x, y, *end, color, width=2 * scale)
        half_width, half_height = (side / 2 for side in text_font(scale).text_size(letter))
        place = x + right * letters - half_width, y - up * letters - half_height
        canvas.text(round(place[0]), round(place[1]), letter, color, font=text_font(scale))


def draw_frame(canvas: Canvas, rectangle: Rectangle, theme: Theme) -> None:
    """Draw a thin frame around a panel."""
    x, y, width, height = rectangle
    color = (72, 77, 88, 255) if theme is DARK else (176, 183, 194, 255)
    canvas.rectangle(x - 1, y - 1, width + 2, height + 2, color, fill=False)


def draw_scale_bar(
    canvas: Canvas, x: int, y: int, pixels_per_unit: float, unit: str | None, theme: Theme, scale
) -> int:
    """Draw a bar of a round length; return where its text ends."""
    length = round_length(160 * scale / pixels_per_unit)
    pixels = max(2, round(length * pixels_per_unit))
    height, font = 4 * scale, text_font(scale)
    middle = y + font.line_height // 2
    canvas.rectangle(x, middle - height // 2, pixels, height, theme.text, fill=False)
    canvas.rectangle(x, middle - height // 2, pixels // 2, height, theme.text)
    text = length_text(length, unit)
    canvas.text(x + pixels + 8 * scale, y, text, theme.text, font=font)
    return x + pixels + 8 * scale + font.width(text)


def round_length(most: float) -> float:
    """Return the largest of 1, 2, 5, 10, … up to a limit."""
    power = exponent(most)
    lengths = [float(f"{digit}e{power}") for digit in (5, 2, 1)]
    return next((length for length in lengths if length <= most), lengths[-1])
