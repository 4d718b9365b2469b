"""Text and marks over the picture: blocks of lines, axes.

In: a `Canvas` over the frame's pixels. Out: the same pixels, drawn on. Text is on translucent
blocks in the corners; lines wider than the picture are wrapped.
"""

from __future__ import annotations

from ...rendering.canvas import Canvas
from ...rendering.fonts.font import Font
from ..views.camera_view import AnyView
from .lettering import table_font, text_font
from .theme import DARK, Theme
from .ui_scale import scale_for, scaled

#: Pixels at scale 1: within a block of text, and around it.
PADDING = 8
MARGIN = 10
#: X, Y and Z in the usual red, green and blue, light enough for a dark background.
AXIS_COLORS = ((235, 80, 80, 255), (95, 205, 95, 255), (95, 140, 255, 255))
AXIS_LENGTH = 34


def text_scale(canvas: Canvas) -> float:
    """Return the font scale for a picture."""
    return scale_for(canvas.width, canvas.height)


def draw_block(
    canvas: Canvas,
    lines: list[str],
    *,
    corner: str = "top left",
    scale: float | None = None,
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
    scale : float, optional
        Factor on the font's size; by default chosen for the picture.
    theme : Theme
    is_table : bool
        Whether the lines have columns, each character as wide.
    """
    scale = scale or text_scale(canvas)
    font, padding = (table_font if is_table else text_font)(scale), scaled(PADDING, scale)
    around = 2 * (padding + scaled(MARGIN, scale))
    lines = _fitting(lines, font, canvas.width - around, canvas.height - around)
    if not lines:
        return
    width = max(map(font.width, lines)) + 2 * padding
    height = font.line_height * len(lines) + 2 * padding
    x, y = place(canvas, width, height, corner, scale)
    canvas.rectangle(x, y, width, height, theme.block)
    for row, line in enumerate(lines):
        canvas.text(x + padding, y + padding + row * font.line_height, line, theme.text, font=font)


def _fitting(lines: list[str], font: Font, width: int, height: int) -> list[str]:
    """Return the lines, wrapped to a width and cut to a height."""
    width, rows = max(width, 1), max(height // font.line_height, 1)
    wrapped = [part for line in lines for part in font.wrapped(line, width)]
    return wrapped if len(wrapped) <= rows else [*wrapped[: rows - 1], "…"]


def place(
    canvas: Canvas, width: int, height: int, corner: str, scale: float = 1.0
) -> tuple[int, int]:
    """Return the top left pixel of a block in the given corner."""
    picture_height, picture_width = canvas.pixels.shape[:2]
    margin = scaled(MARGIN, scale)
    x, y = margin, margin
    if "right" in corner:
        x = picture_width - width - margin
    if corner in ("bottom", "middle"):
        x = (picture_width - width) // 2
    if "bottom" in corner:
        y = picture_height - height - margin
    if corner == "middle":
        y = (picture_height - height) // 2
    return max(x, 0), max(y, 0)


def draw_axes(canvas: Canvas, view: AnyView, scale: float | None = None) -> None:
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
