"""The colour bar that maps colours to numbers: its layout and drawing.

In: a picture's size, a `ScalarBar`, and a `Canvas` over the frame's pixels. Out: the bar's place,
which framing keeps free; the same pixels, drawn on. The bar is upright at the right if it takes at
most a quarter of the width, else flat at the bottom, in small pictures without title or numbers.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...rendering.canvas import Canvas
from ..coloring import ScalarBar
from ..views.free_region import Taken
from .lettering import text_font
from .overlay import MARGIN, PADDING
from .theme import DARK, Theme
from .ticks import label, ticks
from .ui_scale import scaled

_SHARE, _MOST_TICKS = 0.6, 6
_FINEST, _TICK = 6, 4  # pixels at scale 1: thickness of the bar, length of a tick
_UNITS = 40  # thickness, margin and padding are this fraction of the picture's smaller side
_MOST, _MOST_FLAT = 0.25, 1 / 3  # of the picture


class BarPlace(NamedTuple):
    """The layout of a bar, in pixels.

    Attributes
    ----------
    left, top, width, height : int
        The block behind it.
    upright : bool
    title : list of str
        Its lines; empty if there is no room.
    length, thick, padding, margin : int
        Sizes of the colours, of the space around them, and around the block.
    numbers : list of float
    labels : list of str
        Empty if there is no room.
    """

    left: int
    top: int
    width: int
    height: int
    upright: bool
    title: list[str]
    length: int
    thick: int
    padding: int
    margin: int
    numbers: list[float]
    labels: list[str]

    def taken(self, width: int, height: int) -> Taken:
        """Return which part of a picture of this size the bar takes from the model."""
        if self.upright:
            return Taken(right=(width - self.left) / width)
        return Taken(bottom=(height - self.top) / height)


def place_bar(width: int, height: int, bar: ScalarBar, scale: float = 1) -> BarPlace:
    """Return the layout of a bar in a picture of some size, with texts of some scale."""
    upright = _upright(width, height, bar, scale)
    fits = width - upright.left <= _MOST * width and upright.top >= 0
    return upright if fits else _flat(width, height, bar, scale)


def _edges(width: int, height: int, scale: float) -> tuple[int, int, int]:
    """Return the thickness of a bar, its padding and its margin."""
    unit = min(width, height) // _UNITS
    padding, margin = scaled(PADDING, scale), scaled(MARGIN, scale)
    return max(unit, scaled(_FINEST, scale)), min(max(unit, 2), padding), min(max(unit, 3), margin)


def _numbers(bar: ScalarBar, most: int) -> tuple[list[float], list[str]]:
    numbers = ticks(bar.low, bar.high, max(1, min(_MOST_TICKS, most)))
    step = numbers[1] - numbers[0] if len(numbers) > 1 else bar.high - bar.low
    return numbers, [label(number, step) for number in numbers]


def _widest(texts: list[str], scale: float) -> int:
    return max(map(text_font(scale).width, texts), default=0)


def _upright(width: int, height: int, bar: ScalarBar, scale: float) -> BarPlace:
    line = text_font(scale).line_height
    thick, padding, margin = _edges(width, height, scale)
    length = max(int(height * _SHARE), 2)
    numbers, labels = _numbers(bar, length // (2 * line))
    if len(numbers) < 2:  # a single one says little: with less spacing, more fit
        numbers, labels = _numbers(bar, length // line)
    room = max(int(_MOST * width - margin - 2 * padding), _widest(bar.title.split(), scale))
    title = text_font(scale).wrapped(bar.title, room) if bar.title else []
    wide = thick + 2 * scaled(_TICK, scale) + _widest(labels, scale)
    wide = max(wide, _widest(title, scale)) + 2 * padding
    high = length + 2 * padding + line * (len(title) + 1)
    left, top = width - wide - margin, (height - high) // 2
    return BarPlace(
        left, top, wide, high, True, title, length, thick, padding, margin, numbers, labels
    )


def _flat(width: int, height: int, bar: ScalarBar, scale: float) -> BarPlace:
    font = text_font(scale)
    thick, padding, margin = _edges(width, height, scale)
    length = max(width - 2 * (margin + padding), 2)
    high = thick + 2 * padding
    title: list[str] = []
    numbers: list[float] = []
    labels: list[str] = []
    for most in range(_MOST_TICKS, 0, -1):
        numbers, labels = _numbers(bar, most)
        if (_widest(labels, scale) + font.width("0")) * len(labels) <= length:
            break
    below = scaled(_TICK, scale) + font.line_height
    if high + below + margin > _MOST_FLAT * height or length < _widest(labels, scale):
        numbers, labels = [], []
    else:
        high += below
        is_short = font.width(bar.title) <= length
        if bar.title and is_short and high + font.line_height + margin <= _MOST * height:
            title, high = [bar.title], high + font.line_height
    wide = length + 2 * padding
    left, top = (width - wide) // 2, height - high - margin
    return BarPlace(
        left, top, wide, high, False, title, length, thick, padding, margin, numbers, labels
    )


def draw_scalar_bar(canvas: Canvas, bar: ScalarBar, scale: float = 1, theme: Theme = DARK) -> None:
    """Draw the bar on a block, with its title above it."""
    place = place_bar(canvas.width, canvas.height, bar, scale)
    font = text_font(scale)
    canvas.rectangle(place.left, place.top, place.width, place.height, theme.block)
    left, top = place.left + place.padding, place.top + place.padding
    for line in place.title:
        canvas.text(left, top, line, theme.text, font=font)
        top += font.line_height
    if place.upright:
        _draw_upright(canvas, bar, place, (left, top + font.line_height // 2), scale, theme)
    else:
        _draw_flat(canvas, bar, place, (left, top), scale, theme)


def _colors(bar: ScalarBar, length: int) -> list[list[int]]:
    """Return the colour of each pixel along the bar, lowest number first."""
    return bar.colors[np.linspace(0, len(bar.colors) - 1, length).round().astype(int)].tolist()


def _at(number: float, bar: ScalarBar, length: int) -> int:
    return round((number - bar.low) / (bar.high - bar.low) * (length - 1))


def _draw_upright(
    canvas: Canvas,
    bar: ScalarBar,
    place: BarPlace,
    corner: tuple[int, int],
    scale: float,
    theme: Theme,
) -> None:
    (left, top), last = corner, place.length - 1
    font = text_font(scale)
    for row, color in enumerate(_colors(bar, place.length)):
        canvas.rectangle(left, top + last - row, place.thick, 1, (*color, 255))
    right, tick = left + place.thick, scaled(_TICK, scale)
    for number, text in zip(place.numbers, place.labels, strict=True):
        y = top + last - _at(number, bar, place.length)
        canvas.rectangle(right, y, tick, scaled(1, scale), theme.text)
        canvas.text(right + 2 * tick, y - font.line_height // 2, text, theme.text, font=font)


def _draw_flat(
    canvas: Canvas,
    bar: ScalarBar,
    place: BarPlace,
    corner: tuple[int, int],
    scale: float,
    theme: Theme,
) -> None:
    (left, top), font = corner, text_font(scale)
    for column, color in enumerate(_colors(bar, place.length)):
        canvas.rectangle(left + column, top, 1, place.thick, (*color, 255))
    bottom, tick = top + place.thick, scaled(_TICK, scale)
    for number, text in zip(place.numbers, place.labels, strict=True):
        x, wide = left + _at(number, bar, place.length), font.width(text)
        canvas.rectangle(x, bottom, scaled(1, scale), tick, theme.text)
        x = min(max(x - wide // 2, left), left + place.length - wide)
        canvas.text(x, bottom + tick, text, theme.text, font=font)
