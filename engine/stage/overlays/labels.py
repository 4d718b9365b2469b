"""Text over a picture: the numbers of the grid, the bar of numbers, axes, metadata.

In: a frame and what it shows. Out: the same frame.
"""

from __future__ import annotations

from collections.abc import Callable

from ...rendering.frame import Frame
from ..staging import Staging
from ..views.viewpoint import Viewpoint


def draw_labels(
    frame: Frame,
    view: Viewpoint,
    staging: Staging,
    split: bool,
    text_scale: Callable[[Frame], int],
) -> None:
    """Write what the settings say over a frame.

    Parameters
    ----------
    frame : Frame
    view : Viewpoint
        From where it was drawn.
    staging : Staging
    split : bool
        Whether outputs stand side by side.
    text_scale : callable
        Returns the scale of texts over a picture.
    """
    settings, viewed, theme = staging.settings, staging.viewed, staging.theme
    bar = viewed.bar if settings.bar else None
    if not (settings.axes or settings.metadata or settings.axes_grid or bar is not None):
        return
    from .overlay import draw_axes, draw_block
    from .scalar_bar import draw_scalar_bar

    canvas, scale = frame.canvas(), text_scale(frame)
    if settings.axes_grid and not split:
        staging.box.label(frame, scale, theme)
    if bar is not None:
        draw_scalar_bar(canvas, bar, scale, theme)
    if settings.axes:
        draw_axes(canvas, view, scale)
    if settings.metadata:
        draw_block(canvas, viewed.metadata(), corner="top right", scale=scale, theme=theme)
