"""The bar that tells which colour stands for which number.

In: a `Canvas` over the frame's pixels, and a `ScalarBar`. Out: the same pixels, drawn on.
"""

from __future__ import annotations

import numpy as np

from ..canvas import text_size
from .overlay import MARGIN, PADDING
from .scalars import ScalarBar
from .theme import DARK, Theme
from .ticks import label, ticks

_WIDTH, _SHARE, _MOST_TICKS = 16, 0.6, 6
_TICK = 4  # pixels


def draw_scalar_bar(canvas, bar: ScalarBar, scale: int = 1, theme: Theme = DARK) -> None:
    """Draw the bar at the right, on a block with its title above it."""
    cell_width, cell_height = text_size("M", scale)
    length = max(int(canvas.height * _SHARE), 2)
    numbers = ticks(bar.low, bar.high, min(_MOST_TICKS, max(1, length // (2 * cell_height))))
    step = numbers[1] - numbers[0] if len(numbers) > 1 else bar.high - bar.low
    labels = [label(number, step) for number in numbers]
    wide = _WIDTH * scale + _TICK * scale + cell_width * (1 + max(map(len, labels), default=0))
    wide = max(wide, cell_width * len(bar.title)) + 2 * PADDING
    high = length + 2 * PADDING + 2 * cell_height
    left, top = max(canvas.width - wide - MARGIN, 0), max((canvas.height - high) // 2, 0)
    canvas.rectangle(left, top, wide, high, theme.block)
    left, top = left + PADDING, top + PADDING
    canvas.text(left, top, bar.title, theme.text, scale=scale)
    top += cell_height + cell_height // 2
    colors = bar.colors[np.linspace(len(bar.colors) - 1, 0, length).round().astype(int)]
    for row, color in enumerate(colors.tolist()):
        canvas.rectangle(left, top + row, _WIDTH * scale, 1, (*color, 255))
    right = left + _WIDTH * scale
    for number, text in zip(numbers, labels, strict=True):
        share = (number - bar.low) / (bar.high - bar.low)
        y = top + round((1.0 - share) * (length - 1))
        canvas.rectangle(right, y, _TICK * scale, 1, theme.text)
        x = right + _TICK * scale + cell_width // 2
        canvas.text(x, y - cell_height // 2, text, theme.text, scale=scale)
