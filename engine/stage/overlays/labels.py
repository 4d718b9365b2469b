"""Text over a picture: grid numbers, dimensions, colour bar, axes, metadata.

In: a frame and its scene. Out: the same frame, with labels.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...rendering.frame import Frame
from ..staging import Staging
from ..views.camera_view import AnyView
from ..views.free_region import NOTHING


def draw_labels(
    frame: Frame,
    view: AnyView,
    staging: Staging,
    split: bool,
    text_scale: Callable[[Frame], float],
) -> None:
    """Draw the labels that the settings ask for over a frame.

    Parameters
    ----------
    frame : Frame
    view : Viewpoint or CameraView
        The viewpoint that it was drawn from.
    staging : Staging
    split : bool
        Whether outputs are shown side by side.
    text_scale : callable
        Returns the scale of texts for a picture.
    """
    settings, viewed, theme = staging.settings, staging.viewed, staging.theme
    bar = viewed.bar if settings.bar else None
    sizes = (settings.dimensions or settings.measured) and not split
    if not (settings.axes or settings.metadata or settings.axes_grid or sizes or bar is not None):
        return
    from .overlay import draw_axes, draw_block
    from .scalar_bar import draw_scalar_bar, place_bar

    canvas, scale = frame.canvas(), text_scale(frame)
    if settings.axes_grid and not split:
        size = canvas.width, canvas.height
        beside = NOTHING if bar is None else place_bar(*size, bar, scale).taken(*size)
        staging.box.label(frame, scale, theme, beside)
    if sizes:
        _draw_sizes(frame, staging, scale)
    if bar is not None:
        draw_scalar_bar(canvas, bar, scale, theme)
    if settings.axes:
        draw_axes(canvas, view, scale)
    if settings.metadata:
        lines, corner = viewed.metadata(), "top right"
        draw_block(canvas, lines, corner=corner, scale=scale, theme=theme, is_table=True)


def _draw_sizes(frame: Frame, staging: Staging, scale: float) -> None:
    """Draw the box of the model with its dimensions, and what is measured."""
    from .dimensions import draw_dimensions
    from .measurements import draw_measurement

    viewed, theme = staging.viewed, staging.theme
    if staging.settings.dimensions:
        draw_dimensions(frame, np.array(viewed.scene.bounds), viewed.unit, scale, theme)
    for measured in staging.settings.measured:
        here = measured._replace(points=measured.points - np.array(viewed.origin))
        draw_measurement(frame, here, viewed.unit, scale, theme)
