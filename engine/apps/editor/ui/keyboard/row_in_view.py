"""Rows of lists that scroll to where they are seen."""

from __future__ import annotations

from ..translated_imgui import imgui


def scroll_to_row(place: int, covered: int = 0) -> None:
    """Scroll the current window to a row of text, to the middle, unless the row is seen.

    Parameters
    ----------
    place : int
        Of the row; 0 is the first.
    covered : int
        How many rows' height something else takes of the window, such as a head.
    """
    height = imgui.get_text_line_height_with_spacing()
    top, room = imgui.get_scroll_y(), imgui.get_window_height()
    if not top <= place * height <= top + room - (1 + covered) * height:
        imgui.set_scroll_y(place * height - room / 2)
