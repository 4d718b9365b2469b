"""Text and marks over the picture: statistics, metadata, messages, axes.

In: a `Canvas` over the frame's pixels. Out: the same pixels, drawn on. Text is on translucent
blocks in the corners; lines wider than the picture are wrapped.
"""

from __future__ import annotations

from itertools import zip_longest
from typing import Any

from ...base.language import translated, translated_number
from ...rendering.canvas import Canvas
from ...rendering.fonts.font import Font
from ..views.camera_view import AnyView
from .draw_counts import count_names, count_table, told_tests
from .frame_times import FrameTimes
from .lettering import table_font, text_font
from .theme import DARK, Theme

PADDING = 8
MARGIN = 10
#: Pictures of at least this height get text of twice the size.
LARGE_HEIGHT = 1400
#: Larger text is used only if the picture has so many of its pixels in a row.
LEAST_WIDTH = 320
#: X, Y and Z in the usual red, green and blue, light enough for a dark background.
AXIS_COLORS = ((235, 80, 80, 255), (95, 205, 95, 255), (95, 140, 255, 255))
AXIS_LENGTH = 34


def text_scale(canvas: Canvas, screen: int = 1) -> int:
    """Return the font scale for a picture, on a screen of some scale."""
    return text_scale_for(canvas.width, canvas.height, screen)


def text_scale_for(width: int, height: int, screen: int = 1) -> int:
    """Return the font scale for a picture of some size."""
    scale = max(screen, 2 if height >= LARGE_HEIGHT else 1)
    return max(1, min(scale, width // LEAST_WIDTH))


def draw_block(
    canvas: Canvas,
    lines: list[str],
    *,
    corner: str = "top left",
    scale: int | None = None,
    theme: Theme = DARK,
    is_table: bool = False,
) -> None:
    """Draw lines of text on a translucent block.

    Parameters
    ----------
    canvas : Canvas
        The canvas over the frame.
    lines : list of str
        The text. Too wide lines are wrapped; too many lines end with a line of dots.
    corner : str
        Such as ``"top left"``, ``"bottom right"``, ``"bottom"`` or ``"middle"``.
    scale : int, optional
        Factor on the font's size; by default chosen for the picture.
    theme : Theme
    is_table : bool
        Whether the lines have columns, each character as wide.
    """
    scale = scale or text_scale(canvas)
    font = (table_font if is_table else text_font)(scale)
    lines = _fitting(canvas, lines, font)
    if not lines:
        return
    width = max(map(font.width, lines)) + 2 * PADDING
    height = font.line_height * len(lines) + 2 * PADDING
    x, y = place(canvas, width, height, corner)
    canvas.rectangle(x, y, width, height, theme.block)
    for row, line in enumerate(lines):
        canvas.text(x + PADDING, y + PADDING + row * font.line_height, line, theme.text, font=font)


def _fitting(canvas: Canvas, lines: list[str], font: Font) -> list[str]:
    """Return the lines, wrapped to the picture's width and cut to its height."""
    width = max(canvas.width - 2 * PADDING - MARGIN, 1)
    rows = max((canvas.height - 2 * PADDING - MARGIN) // font.line_height, 1)
    wrapped = [part for line in lines for part in font.wrapped(line, width)]
    return wrapped if len(wrapped) <= rows else [*wrapped[: rows - 1], "…"]


def place(canvas: Canvas, width: int, height: int, corner: str) -> tuple[int, int]:
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


def short_statistics(times: FrameTimes, stats: dict[str, Any]) -> str:
    """Return a one-line summary of the last frame's statistics."""
    parts = [
        translated("{ms:.1f} ms to draw", ms=times.drawing_seconds * 1000),
        translated(
            "{drawn:,} of {total:,} triangles",
            drawn=stats["triangles_drawn"],
            total=stats["triangles"],
        ),
    ]
    if times.count > 1:
        parts.insert(0, translated("{rate:.0f} frames per second", rate=1.0 / times.seconds))
    return ", ".join(parts)


def statistics_lines(
    seconds: float,
    size: tuple[int, int],
    samples: int,
    stats: dict[str, Any],
    place: str = "",
    culling: str = "all",
) -> list[str]:
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
    place : str
        Where the camera is.
    culling : str
        The culling method.
    """
    rate = 1.0 / seconds if seconds > 0.0 else 0.0
    lines = [
        translated("{rate:7.1f} frames/s {ms:8.2f} ms", rate=rate, ms=seconds * 1000),
        f"{size[0]}x{size[1]}",
    ]
    if samples > 1:
        lines[1] += translated(", {count} samples per pixel", count=samples)
    if place:
        lines[1] += f"; {place}"
    tabled = count_names()
    if tabled <= stats.keys():
        lines += [*count_table(stats), told_tests(stats, culling)]
        tabled.add("boxes_tested")
    else:
        tabled = set()
    entries = []
    for name, value in stats.items():
        if name in tabled or name == "plan":
            continue  # the plan's names are only for developers of the rasteriser
        text = translated_number(value, ".3f") if isinstance(value, float) else f"{value}"
        entries.append(f"{translated(name.replace('_', ' ')):<19}{text:>11}")
    return lines + _in_two_columns(entries)


def _in_two_columns(entries: list[str]) -> list[str]:
    """Return lines of two entries each, with the first half in the left column."""
    half = (len(entries) + 1) // 2
    pairs = zip_longest(entries[:half], entries[half:], fillvalue="")
    return ["   ".join(pair).rstrip() for pair in pairs]


def draw_axes(canvas: Canvas, view: AnyView, scale: int | None = None) -> None:
    """Draw the world's axes, as seen by the camera, in the bottom left corner."""
    scale = scale or text_scale(canvas)
    font, length = text_font(scale), AXIS_LENGTH * scale
    reach = length + 14 * scale
    x0, y0 = reach, canvas.pixels.shape[0] - reach
    # Row k of the rotation is the world's axis k in camera space: right, up, back.
    axes = zip(view.rotation().tolist(), "XYZ", AXIS_COLORS, strict=True)
    for (right, up, _), letter, color in sorted(axes, key=lambda axis: axis[0][2]):
        x, y = round(x0 + right * length), round(y0 - up * length)
        canvas.line(x0, y0, x, y, color, width=2 * scale)
        half_width, half_height = (side / 2 for side in font.text_size(letter))
        x, y = x0 + right * (length + 8 * scale), y0 - up * (length + 8 * scale)
        canvas.text(round(x - half_width), round(y - half_height), letter, color, font=font)
