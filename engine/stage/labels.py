"""What is written over a picture: the numbers of the grid, the bar of numbers, axes, metadata.

In: a frame and what it shows. Out: the same frame, and how much of a picture the bar takes.
"""

from __future__ import annotations

from ..rendering.frame import Frame
from .free_region import NOTHING, Taken
from .stage_settings import Settings
from .staging import Staging
from .viewed_scene import ViewedScene
from .viewpoint import Viewpoint


def taken_by_bar(
    viewed: ViewedScene, settings: Settings, size: tuple[int, int], scale: int
) -> Taken:
    """What of a picture the bar of numbers takes; ``scale`` is that of texts."""
    bar = viewed.bar if settings.bar else None
    if bar is None:
        return NOTHING
    from .scalar_bar import place_bar

    return place_bar(*size, bar, scale).taken(*size)


def draw_labels(frame: Frame, view: Viewpoint, staging: Staging, split: bool, scale: int) -> None:
    """Write what the settings say over a frame.

    Parameters
    ----------
    frame : Frame
    view : Viewpoint
        From where it was drawn.
    staging : Staging
    split : bool
        Whether outputs stand side by side.
    scale : int
        Of texts.
    """
    settings, viewed, theme = staging.settings, staging.viewed, staging.theme
    bar = viewed.bar if settings.bar else None
    if not (settings.axes or settings.metadata or settings.axes_grid or bar is not None):
        return
    from .overlay import draw_axes, draw_block
    from .scalar_bar import draw_scalar_bar

    canvas = frame.canvas()
    if settings.axes_grid and not split:
        staging.box.label(frame, scale, theme)
    if bar is not None:
        draw_scalar_bar(canvas, bar, scale, theme)
    if settings.axes:
        draw_axes(canvas, view, scale)
    if settings.metadata:
        draw_block(canvas, viewed.metadata(), corner="top right", scale=scale, theme=theme)
