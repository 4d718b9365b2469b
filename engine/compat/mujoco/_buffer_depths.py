"""The depths of a context's buffer: drawn when somebody asks for them, or before it is too late.

In: rectangles of pictures, and how their depths are drawn. Out: depths.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

_MOST_WAITING = 8

#: Left, bottom, width, height.
Rectangle = tuple[int, int, int, int]
#: Draws a rectangle's depths by a context that it does not hold, (H, W) float32, the top row first.
Draw = Callable[[Any], np.ndarray]


def _covers(above: Rectangle, below: Rectangle) -> bool:
    return all(
        above[k] <= below[k] and below[k] + below[2 + k] <= above[k] + above[2 + k] for k in (0, 1)
    )


class BufferDepths:
    """Depths of a buffer, 1 at the near plane and 0 at the far one, the lowest row first.

    Most pictures' depths are never read: they wait to be drawn.
    """

    def __init__(self) -> None:
        self._waiting: list[tuple[Rectangle, Draw]] = []  # the later ones lie above
        self._drawn: np.ndarray | None = None  # what lies below those that wait

    def clear(self) -> None:
        """Make all depths far."""
        self._waiting, self._drawn = [], None

    def begin(self, rectangle: Rectangle) -> None:
        """Forget what a picture will cover."""
        self._waiting = [each for each in self._waiting if not _covers(rectangle, each[0])]

    def add(self, rectangle: Rectangle, draw: Draw, context: Any) -> None:
        """Remember how the depths of a rectangle are drawn."""
        self.begin(rectangle)
        if len(self._waiting) >= _MOST_WAITING:
            self._draw_first(context)
        self._waiting.append((rectangle, draw))

    def settle(self, context: Any) -> None:
        """Draw all that waits, since what it is drawn from will change."""
        while self._waiting:
            self._draw_first(context)

    def of(self, rectangle: Rectangle, context: Any) -> np.ndarray:
        """Return the depths of a rectangle, (H, W) float32."""
        if self._waiting and self._waiting[-1][0] == rectangle:
            return self._waiting[-1][1](context)[::-1]
        self.settle(context)
        left, bottom, width, height = rectangle
        return self._memory(context)[bottom : bottom + height, left : left + width]

    def _memory(self, context: Any) -> np.ndarray:
        shape = context.offHeight, context.offWidth
        if self._drawn is None or self._drawn.shape != shape:
            self._drawn = np.zeros(shape, np.float32)
        return self._drawn

    def _draw_first(self, context: Any) -> None:
        (left, bottom, width, height), draw = self._waiting.pop(0)
        memory = self._memory(context)
        if left + width <= context.offWidth and bottom + height <= context.offHeight:
            memory[bottom : bottom + height, left : left + width] = draw(context)[::-1]
