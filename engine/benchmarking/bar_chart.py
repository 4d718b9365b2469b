"""A chart of horizontal bars in groups, as SVG or, drawn by engine3d's own canvas, as an image.

In:  rows of (label, one value for each series or None), names of the series.
Out: a file; its suffix says whether it is SVG text or an image.
"""

from __future__ import annotations

import io
import os
from xml.sax.saxutils import escape

from ..atomic_write import atomic_write

_FORMATS = {".png": "PNG", ".jpg": "JPEG", ".webp": "WEBP"}
COLORS = [(122, 132, 150), (214, 170, 60), (78, 160, 214), (64, 176, 120), (200, 90, 120)]
INK, GRID, PAPER = (40, 44, 52), (214, 218, 224), (255, 255, 255)
BAR, GAP, LEFT, TOP, PLOT, RIGHT = 12, 12, 236, 46, 480, 60


class Chart:
    """What is drawn: rectangles and texts at whole pixels, in order."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.rectangles, self.texts = [], []

    def rectangle(self, x, y, width, height, color):
        self.rectangles.append((round(x), round(y), max(1, round(width)), round(height), color))

    def text(self, x, y, string):
        self.texts.append((round(x), round(y), string))


def lay_out(title, rows, series):
    """Arrange a chart: a group of bars for each row, one bar a series, its value beside it."""
    group = len(series) * BAR + GAP
    most = max(value for _, values in rows for value in values if value is not None)
    chart = Chart(LEFT + PLOT + RIGHT, TOP + len(rows) * group + GAP)
    chart.rectangle(0, 0, chart.width, chart.height, PAPER)
    step = next(s for s in (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if most / s <= 10)
    for tick in range(int(most / step) + 1):
        x = LEFT + PLOT * tick * step / most
        chart.rectangle(x, TOP - 4, 1, len(rows) * group + 4, GRID)
        chart.text(x - 3, TOP - 14, f"{tick * step:g}")
    chart.text(8, 8, title)
    for number, name in enumerate(series):
        chart.rectangle(LEFT + 110 * number, 22, BAR, BAR, COLORS[number % len(COLORS)])
        chart.text(LEFT + 110 * number + BAR + 4, 22, name)
    for row, (label, values) in enumerate(rows):
        y = TOP + row * group + GAP // 2
        chart.text(8, y + (len(series) * BAR) // 2 - 4, label)
        for number, value in enumerate(values):
            if value is not None:
                bar = PLOT * value / most
                color = COLORS[number % len(COLORS)]
                chart.rectangle(LEFT, y + number * BAR, bar, BAR - 1, color)
                chart.text(LEFT + bar + 4, y + number * BAR + 1, f"{value:.1f}")
    return chart


def as_svg(chart):
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{chart.width}" height="{chart.height}" '
        'font-family="monospace" font-size="10">'
    ]
    for x, y, width, height, color in chart.rectangles:
        fill = "#{:02x}{:02x}{:02x}".format(*color)
        parts.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{fill}"/>')
    for x, y, string in chart.texts:
        parts.append(f'<text x="{x}" y="{y + 8}">{escape(string)}</text>')
    return "\n".join([*parts, "</svg>", ""])


def as_canvas(chart):
    from ..canvas import Canvas

    canvas = Canvas(chart.width, chart.height)
    for x, y, width, height, color in chart.rectangles:
        canvas.rectangle(x, y, width, height, color)
    for x, y, string in chart.texts:
        canvas.text(x, y, string, INK)
    return canvas


def save(path, title, rows, series):
    """Write the chart of rows [(label, values)] to a file, whole or not at all."""
    chart = lay_out(title, rows, series)
    suffix = os.path.splitext(path)[1].lower()
    if suffix == ".svg":
        data = as_svg(chart).encode()
    else:
        buffer = io.BytesIO()
        as_canvas(chart).image().convert("RGB").save(buffer, _FORMATS[suffix])
        data = buffer.getvalue()
    with atomic_write(path) as file:
        file.write(data)
