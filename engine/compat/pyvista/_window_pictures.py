"""The picture of a window of VTK.

In: a ``vtkRenderWindow`` with its renderers, which has no OpenGL. Out: pixels and depths.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import InvalidArgumentError, warn
from ._layer import depth_of, draw_layer
from ._lights import lamps_of
from ._props import Content, content_of, draw_content, passes_of
from ._renderer_view import View, view_of
from ._samples import Samples
from ._surroundings import surroundings_of
from .annotations.overlay import Overlay

_SAMPLES = 4  # of a pixel, whatever kind of antialiasing is asked for
_LARGEST = 16384
_BEHIND = 0.005  # of the distance: how far behind a surface a label is hidden


class Picture(NamedTuple):
    """What a window shows.

    Attributes
    ----------
    rgba : (H, W, 4) uint8
        Alpha is 0 where only a background shows.
    depth : (H, W) float32 or None
        Distance along the view axis of each pixel's renderer; 0 where nothing is.
    """

    rgba: NDArray[np.uint8]
    depth: NDArray[np.float32] | None


def picture_of(
    window: Any, scale: int = 1, *, is_smooth: bool = True, wants_depth: bool = False
) -> Picture:
    """Draw a window.

    Parameters
    ----------
    window : vtkRenderWindow
    scale : int
        How many times as wide and high as the window the picture is.
    is_smooth : bool
        Four samples a pixel, instead of one.
    wants_depth : bool

    Raises
    ------
    InvalidArgumentError
        The picture is too large, or of what the window holds nothing can be drawn.
    """
    size = _size_of(window, scale)
    samples = Samples(size, _SAMPLES if is_smooth else 1)
    depth = np.zeros(size[::-1], np.float32) if wants_depth else None
    contents = []
    for renderer in _renderers(window):
        renderer.InvokeEvent("StartEvent")  # little axes turn with the scene by it
        view = view_of(renderer, size)
        if view is not None:
            contents.append(_draw(renderer, view, samples, depth, scale))
    _tell_undrawn(contents)
    return Picture(samples.pixels(), depth)


def _size_of(window: Any, scale: int) -> tuple[int, int]:
    """Return the size of a window's picture, checked."""
    width, height = (side * scale for side in window.GetSize())
    if not (0 < width <= _LARGEST and 0 < height <= _LARGEST):
        raise InvalidArgumentError(
            f"a picture is 1 to {_LARGEST} pixels wide and high, not {width} x {height}"
        )
    return width, height


def _renderers(window: Any) -> list[Any]:
    """Return the renderers that are on, those below first."""
    renderers = window.GetRenderers()
    renderers.InitTraversal()
    found = [renderers.GetNextItem() for _ in range(renderers.GetNumberOfItems())]
    return sorted((one for one in found if one.GetDraw()), key=lambda one: one.GetLayer())


def is_smooth(window: Any) -> bool:
    """Return whether a window asks for antialiasing of any kind."""
    if window.GetMultiSamples() > 1:
        return True
    return any(
        renderer.GetUseFXAA() or "vtkSSAAPass" in passes_of(renderer)
        for renderer in _renderers(window)
    )


def _draw(
    renderer: Any, view: View, samples: Samples, depth: NDArray[np.float32] | None, scale: int
) -> Content:
    """Draw a renderer's rectangle, and add to the depths."""
    part = samples.part(view.left, view.top, view.width, view.height)
    if renderer.GetLayer() == 0 or not renderer.GetPreserveColorBuffer():
        part.fill(_background(renderer, view), renderer.GetBackgroundAlpha())
    content = content_of(renderer, view)
    draw_layer(
        part,
        content.parts,
        lamps_of(renderer, view),
        view,
        bool(renderer.GetUseDepthPeeling()),
        surroundings_of(renderer, view),
    )
    found = None
    if depth is not None or content.labels:
        found = depth_of(content.parts, view, samples.pattern[0])
    if depth is not None and found is not None:
        there = depth[view.top : view.top + view.height, view.left : view.left + view.width]
        np.copyto(there, found, where=found > 0.0)
    draw_content(Overlay(renderer, view, part, scale), content, _hider(view, found))
    return content


def _background(renderer: Any, view: View) -> NDArray[np.float64]:
    """Return the colours of a background: (3,), or (H, 1, 3) of one that changes upwards."""
    low = np.array(renderer.GetBackground())
    if not renderer.GetGradientBackground():
        return low
    high = np.array(renderer.GetBackground2())
    up = 1.0 - (np.arange(view.height) + 0.5) / view.height
    return low + (high - low) * up[:, None, None]


def _hider(
    view: View, depth: NDArray[np.float32] | None
) -> Callable[[NDArray[np.float64]], NDArray[np.bool_]]:
    """Return a function that tells which places of view space something hides."""

    def hidden(places: NDArray[np.float64]) -> NDArray[np.bool_]:
        assert depth is not None
        x, y, w = view.pixels(places).T
        inside = (w > 0.0) & (x >= 0) & (x < view.width) & (y >= 0) & (y < view.height)
        column = np.where(inside, x, 0.0).astype(np.int64)
        row = np.where(inside, y, 0.0).astype(np.int64)
        there = depth[row, column]
        return ~inside | ((there > 0.0) & (-places[:, 2] > there * (1.0 + _BEHIND)))

    return hidden


def _tell_undrawn(contents: list[Content]) -> None:
    undrawn = list(dict.fromkeys(name for one in contents for name in one.undrawn))
    if not undrawn:
        return
    named = ", ".join(undrawn)
    if all(one.is_empty for one in contents):
        raise InvalidArgumentError(
            f"engine3d does not draw {named}, and this plotter holds nothing else"
        )
    warn(f"engine3d does not draw {named}")
