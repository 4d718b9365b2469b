"""Panels of lines, both of whose axes are logarithmic: how a cost grows with a size.

In:  panels of (title, [(size, value)]).
Out: a file; its suffix says whether it is SVG text or an image.
"""

from __future__ import annotations

import math

from chart import COLORS, GRID, Chart

WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 320, 190, 46, 34, 24, 26
DOT = 5


def lay_out(panels, columns=2):
    """Arrange the panels in rows."""
    rows = -(-len(panels) // columns)
    wide, high = LEFT + WIDTH + RIGHT, TOP + HEIGHT + BOTTOM
    chart = Chart(columns * wide, rows * high)
    for number, (title, points) in enumerate(panels):
        row, column = divmod(number, columns)
        _panel(chart, column * wide + LEFT, row * high + TOP, title, points, number)
    return chart


def _panel(chart, left, top, title, points, number):
    horizontal, vertical = (_Axis(values) for values in zip(*points, strict=True))
    chart.text(left, top - 24, title)
    for value, place in horizontal.ticks():
        chart.rectangle(left + place * WIDTH, top, 1, HEIGHT, GRID)
        chart.text(left + place * WIDTH - 8, top + HEIGHT + 6, _short(value))
    for value, place in vertical.ticks():
        chart.rectangle(left, top + (1 - place) * HEIGHT, WIDTH, 1, GRID)
        chart.text(left - 40, top + (1 - place) * HEIGHT - 4, _short(value))
    color = COLORS[(number + 2) % len(COLORS)]
    places = [
        (left + horizontal.place(x) * WIDTH, top + (1 - vertical.place(y)) * HEIGHT)
        for x, y in points
    ]
    for start, end in zip(places, places[1:], strict=False):
        chart.line(start, end, color)
    for x, y in places:
        chart.rectangle(x - DOT // 2, y - DOT // 2, DOT, DOT, color)


class _Axis:
    """A logarithmic axis from the power of ten below the values to the one above, or of two."""

    def __init__(self, values):
        self._base = 10 if max(values) >= 20 * min(values) else 2
        self._low = math.floor(math.log(min(values), self._base) + 1e-9)
        self._high = math.ceil(math.log(max(values), self._base) - 1e-9)
        self._high = max(self._high, self._low + 1)

    def place(self, value):
        """Where a value is, from 0 to 1."""
        return (math.log(value, self._base) - self._low) / (self._high - self._low)

    def ticks(self):
        """Pairs of (value, place)."""
        powers = range(self._low, self._high + 1)
        return [(float(self._base) ** k, (k - self._low) / (len(powers) - 1)) for k in powers]


def _short(value):
    """A number in few characters: 0.1, 10, 1k, 10M."""
    for factor, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= factor:
            return f"{value / factor:g}{letter}"
    return f"{value:g}"


def save(path, panels):
    """Write the chart of panels [(title, [(size, value)])] to a file, whole or not at all."""
    lay_out(panels).save(path)
