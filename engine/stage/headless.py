"""Frames without a screen: turntables and animations, as RGBA arrays one by one.

In: a `ViewRenderer` and a first `Viewpoint`. Out: a generator of (H, W, 4) uint8 arrays that loop
smoothly: the scene's own animation over its period or, without one, a turn of the camera.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from .view_renderer import ViewRenderer
from .views.viewpoint import Viewpoint

#: Animation players stutter outside these limits.
SHORTEST_FRAME = 0.02
LONGEST_FRAME = 0.1


def seconds_a_frame(view_renderer: ViewRenderer, count: int) -> float:
    """Return the display time in seconds of each of ``count`` pictures of one period."""
    seconds = view_renderer.viewed.period / count
    return min(LONGEST_FRAME, max(SHORTEST_FRAME, seconds))


def turntable(
    view_renderer: ViewRenderer, view: Viewpoint, count: int, start: float = 0.0
) -> Iterator[np.ndarray]:
    """Yield ``count`` pictures of one turn of the camera around the scene, with playing clips."""
    moves = view_renderer.viewed.period if view_renderer.viewed.player else 0.0
    for index in range(count):
        turned = view.copy()
        turned.azimuth = view.azimuth + 2 * math.pi * index / count
        yield view_renderer.draw(turned, start + moves * index / count).color


def animation(
    view_renderer: ViewRenderer, view: Viewpoint, count: int, start: float = 0.0
) -> Iterator[np.ndarray]:
    """Yield ``count`` pictures of the scene's animation, or of a turntable if it has none."""
    if view_renderer.viewed.update is None:
        yield from turntable(view_renderer, view, count)
        return
    for index in range(count):
        time = start + view_renderer.viewed.period * index / count
        yield view_renderer.draw(view, time).color
