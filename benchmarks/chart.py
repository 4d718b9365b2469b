"""What a chart is drawn of, and how it becomes SVG or, by the engine's own canvas, an image.

In:  rectangles, line segments and texts at whole pixels, in order.
Out: a file; its suffix says whether it is SVG text or an image.
"""

from __future__ import annotations

import io
import os
from xml.sax.saxutils import escape

from engine3d.base.files.atomic_write import atomic_write
from engine3d.rendering.canvas import Canvas

_FORMATS = {".png": "PNG", ".jpg": "JPEG", ".webp": "WEBP"}
COLORS = [(122, 132, 150), (214, 170, 60), (78, 160, 214), (64, 176, 120), (200, 90, 120)]
INK, GRID, PAPER = (40, 44, 52), (214, 218, 224), (255, 255, 255)


class Chart:
    """What is drawn: first the rectangles, then the lines, then the texts."""

    def __init__(self, width, height):
        self.width, self.height = width, height
        self.rectangles, self.lines, self.texts = [], [], []
        self.rectangle(0, 0, width, height, PAPER)

    def rectangle(self, x, y, width, height, color):
        self.rectangles.append((round(x), round(y), max(1, round(width)), round(height), color))

    def line(self, start, end, color):
        self.lines.append((*(round(value) for value in (*start, *end)), color))

    def text(self, x, y, string):
        self.texts.append((round(x), round(y), string))

    def save(self, path):
        """Write the chart to a file, whole or not at all."""
        suffix = os.path.splitext(path)[1].lower()
        if suffix == ".svg":
            data = as_svg(self).encode()
        else:
            buffer = io.BytesIO()
            as_canvas(self).image().convert("RGB").save(buffer, _FORMATS[suffix])
            data = buffer.getvalue()
        with atomic_write(path) as file:
            file.write(data)


def as_svg(chart):
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{chart.width}" height="{chart.height}" '
        'font-family="monospace" font-size="10">'
    ]
    for x, y, width, height, color in chart.rectangles:
        fill = _hexadecimal(color)
        parts.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" fill="{fill}"/>')
    for x0, y0, x1, y1, color in chart.lines:
        stroke = f'stroke="{_hexadecimal(color)}" stroke-width="2"'
        parts.append(f'<line x1="{x0}" y1="{y0}" x2="{x1}" y2="{y1}" {stroke}/>')
    for x, y, string in chart.texts:
        parts.append(f'<text x="{x}" y="{y + 8}">{escape(string)}</text>')
    return "\n".join([*parts, "</svg>", ""])


def _hexadecimal(color):
    return "#{:02x}{:02x}{:02x}".format(*color)


def as_canvas(chart):
    canvas = Canvas((chart.width, chart.height))
    for x, y, width, height, color in chart.rectangles:
        canvas.rectangle(x, y, width, height, color)
    for x0, y0, x1, y1, color in chart.lines:
        canvas.line(x0, y0, x1, y1, color, width=2)
    for x, y, string in chart.texts:
        canvas.text(x, y, string, INK)
    return canvas
