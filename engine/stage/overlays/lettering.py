"""The fonts of texts over pictures, by the scale of the screen."""

from __future__ import annotations

from ...rendering.fonts.font import Font, font

_TEXT, _HEADING = 14, 22
#: Its characters are 8 pixels wide.
_TABLE = 40 / 3


def text_font(scale: float) -> Font:
    """Return the font of most texts."""
    return font("sans", _TEXT * scale)


def heading_font(scale: float) -> Font:
    """Return the font of titles of pages."""
    return font("sans", _HEADING * scale)


def table_font(scale: float) -> Font:
    """Return the font of figures and words in columns, which are counted in characters."""
    return font("mono", _TABLE * scale)
