"""Frames without a screen: turntables and animations, one RGBA array after another.

In: a `Studio` and a first `Viewpoint`. Out: a generator of (H, W, 4) uint8 arrays. But for a walk
they loop without a jump: the subject's own animation over its period or, without one, a turn of the
camera.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from .view_renderer import Studio
from .viewpoint import Viewpoint
from .walking import controller

#: Viewers of animations falter outside these.
SHORTEST_FRAME = 0.02
LONGEST_FRAME = 0.1
#: How long one turns where the way ends.
TURN_SECONDS = 0.3


def seconds_a_frame(studio: Studio, count: int) -> float:
    """Return how long each of ``count`` pictures of one period shows."""
    seconds = studio.subject.period / count
    return min(LONGEST_FRAME, max(SHORTEST_FRAME, seconds))


def turntable(studio: Studio, view: Viewpoint, count: int) -> Iterator[np.ndarray]:
    """Yield ``count`` pictures of one turn of the camera round the subject."""
    for index in range(count):
        turned = view.copy()
        turned.azimuth = view.azimuth + 2 * math.pi * index / count
        yield studio.draw(turned).color


def animation(studio: Studio, view: Viewpoint, count: int) -> Iterator[np.ndarray]:
    """Yield ``count`` pictures of the subject's animation, or of a turntable if it has none."""
    if studio.subject.update is None:
        yield from turntable(studio, view, count)
        return
    for index in range(count):
        yield studio.draw(view, studio.subject.period * index / count).color


def walk(studio: Studio, view: Viewpoint, count: int) -> Iterator[np.ndarray]:
    """Yield ``count`` pictures of somebody who walks ahead, and turns right where the way ends."""
    seconds = seconds_a_frame(studio, count)
    walker = controller(studio, view)
    view = view.copy()
    for index in range(count):
        walker.place(view)
        yield studio.draw(view, index * seconds % studio.subject.period).color
        before = walker.position
        walker.walk({"W"}, seconds)
        ahead = walker.position - before
        if ahead[0] * ahead[0] + ahead[2] * ahead[2] < (0.2 * walker.speed * seconds) ** 2:
            walker.walk({"Right"}, TURN_SECONDS)
