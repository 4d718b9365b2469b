"""The progress bar of an animation, at the bottom of the window.

In: a `Canvas` over the frame, a fraction from 0 to 1. Out: the same pixels, drawn on.
"""

from __future__ import annotations

from ...stage.overlays.theme import Theme
from ...stage.overlays.ui_scale import scaled

HEIGHT = 4


def draw_bar(canvas, share: float, *, scale: float, theme: Theme) -> None:
    """Draw the bar: the played part in one colour, the rest in another."""
    height, played = scaled(HEIGHT, scale), round(min(1.0, max(0.0, share)) * canvas.width)
    top = max(canvas.height - height, 0)
    canvas.rectangle(0, top, canvas.width, height, theme.block)
    if played:
        canvas.rectangle(0, top, played, height, theme.title)
