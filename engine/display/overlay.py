"""Text and marks over the picture: help, statistics, metadata, messages, the axes.

In: a `Canvas` over the frame's pixels. Out: the same pixels, drawn on. Text sits on dark,
translucent blocks in the corners; what does not fit the picture is clipped.
"""

from __future__ import annotations

from itertools import zip_longest

from ..canvas import text_size
from .counts import count_names, count_table
from .keymap import GESTURES, SECTIONS
from .viewpoint import Viewpoint

TEXT = (235, 238, 242, 255)
KEY = (255, 206, 115, 255)
TITLE = (130, 190, 255, 255)
BLOCK = (16, 18, 24, 210)
PADDING = 8
MARGIN = 10
LINE_GAP = 3
#: Pictures at least this high get text twice the size.
LARGE_HEIGHT = 1400
#: X, Y and Z, the usual red, green and blue, light enough for a dark background.
AXIS_COLORS = ((235, 80, 80, 255), (95, 205, 95, 255), (95, 140, 255, 255))
AXIS_LENGTH = 34


def text_scale(canvas) -> int:
    """Return the factor on the font's size that suits the picture."""
    return 2 if canvas.pixels.shape[0] >= LARGE_HEIGHT else 1


def draw_block(canvas, lines: list[str], *, corner: str = "top left") -> None:
    """Draw lines of text on a dark block.

    Parameters
    ----------
    canvas : Canvas
        Over the frame.
    lines : list of str
        The text.
    corner : str
        ``"top left"``, ``"top right"``, ``"bottom left"``, ``"bottom"`` or ``"middle"``.
    """
    if not lines:
        return
    scale = text_scale(canvas)
    sizes = [text_size(line, scale) for line in lines]
    line_height = text_size("M", scale)[1] + LINE_GAP * scale
    width = max(size[0] for size in sizes) + 2 * PADDING
    height = line_height * len(lines) - LINE_GAP * scale + 2 * PADDING
    x, y = _place(canvas, width, height, corner)
    canvas.rectangle(x, y, width, height, BLOCK)
    for row, line in enumerate(lines):
        canvas.text(x + PADDING, y + PADDING + row * line_height, line, TEXT, scale=scale)


def _place(canvas, width: int, height: int, corner: str) -> tuple[int, int]:
    """Return the top left pixel of a block in the given corner."""
    picture_height, picture_width = canvas.pixels.shape[:2]
    x, y = MARGIN, MARGIN
    if "right" in corner:
        x = picture_width - width - MARGIN
    if corner in ("bottom", "middle"):
        x = (picture_width - width) // 2
    if "bottom" in corner:
        y = picture_height - height - MARGIN
    if corner == "middle":
        y = (picture_height - height) // 2
    return max(x, 0), max(y, 0)


def help_columns() -> list[list[tuple[str, str]]]:
    """Return the help: two columns of (key, what it does); a title has no second part."""

    def rows(title: str) -> list[tuple[str, str]]:
        bindings = SECTIONS[title]
        return [(title, ""), *((" ".join(binding.keys), binding.help) for binding in bindings)]

    gap = ("", "")
    left = [*rows("Drawing"), gap, ("Mouse", ""), *GESTURES]
    right = [*rows("View"), gap, *rows("Overlays"), gap, *rows("Window")]
    return [left, right]


def draw_help(canvas) -> None:
    """Draw every key and gesture on a block in the middle."""
    scale = text_scale(canvas)
    character, line_height = text_size("M", scale)[0], text_size("M", scale)[1] + LINE_GAP * scale
    columns = help_columns()
    indents = [max(len(key) for key, text in column if text) + 2 for column in columns]
    widths = [
        (indent + max(len(text) for _, text in column)) * character
        for indent, column in zip(indents, columns, strict=True)
    ]
    gutter = 3 * character
    width = sum(widths) + gutter + 4 * PADDING
    height = line_height * max(map(len, columns)) - LINE_GAP * scale + 4 * PADDING
    left, top = _place(canvas, width, height, "middle")
    canvas.rectangle(left, top, width, height, BLOCK)
    x = left + 2 * PADDING
    for column, indent, column_width in zip(columns, indents, widths, strict=True):
        for row, (key, text) in enumerate(column):
            y = top + 2 * PADDING + row * line_height
            canvas.text(x, y, key, KEY if text else TITLE, scale=scale)
            canvas.text(x + indent * character, y, text, TEXT, scale=scale)
        x += column_width + gutter


def statistics_lines(seconds: float, size, samples: int, stats: dict) -> list[str]:
    """Return the statistics of the last frame, line by line; they fit 640 x 480 pixels.

    Parameters
    ----------
    seconds : float
        Mean time from frame to frame.
    size : (int, int)
        Width and height in pixels.
    samples : int
        Samples a pixel.
    stats : dict
        `Frame.stats`: counters and milliseconds of each stage.
    """
    rate = 1.0 / seconds if seconds > 0.0 else 0.0
    lines = [
        f"{rate:7.1f} frames/s {seconds * 1000:8.2f} ms",
        f"{size[0]}x{size[1]}" + (f", {samples} samples per pixel" if samples > 1 else ""),
    ]
    tabled = count_names()
    if tabled <= stats.keys():
        lines += count_table(stats)
    else:
        tabled = set()
    entries = []
    for name, value in stats.items():
        if name in tabled:
            continue
        text = f"{value:.3f}" if isinstance(value, float) else f"{value}"
        entries.append(f"{name.replace('_', ' '):<19}{text:>11}")
    return lines + _in_two_columns(entries)


def _in_two_columns(entries: list[str]) -> list[str]:
    """Return lines of two entries each, the first half of them on the left."""
    half = (len(entries) + 1) // 2
    pairs = zip_longest(entries[:half], entries[half:], fillvalue="")
    return ["   ".join(pair).rstrip() for pair in pairs]


def draw_axes(canvas, view: Viewpoint) -> None:
    """Draw the world's axes, as the camera sees their directions, in the bottom left corner."""
    scale = text_scale(canvas)
    length = AXIS_LENGTH * scale
    reach = length + 14 * scale
    x0, y0 = reach, canvas.pixels.shape[0] - reach
    # Row k of the rotation is the world's axis k in camera space: right, up, back.
    axes = zip(view.rotation().tolist(), "XYZ", AXIS_COLORS, strict=True)
    for (right, up, _), letter, color in sorted(axes, key=lambda axis: axis[0][2]):
        x, y = round(x0 + right * length), round(y0 - up * length)
        canvas.line(x0, y0, x, y, color, width=2 * scale)
        half_width, half_height = (side / 2 for side in text_size(letter, scale))
        x, y = x0 + right * (length + 8 * scale), y0 - up * (length + 8 * scale)
        canvas.text(round(x - half_width), round(y - half_height), letter, color, scale=scale)
