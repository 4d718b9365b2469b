"""Shows lessons in a window, step by step.

In: lessons, and a `Window` that waits. Out: the current step on the screen, enlarged by a whole
number, with its number in the title bar.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from .. import events
from .window import Window

BACKDROP = (30, 33, 40, 255)
NEXT_STEP = ("Right", "Space", "Return", "PageDown")
LAST_STEP = ("Left", "Backspace", "PageUp")
NEXT_LESSON = ("N", "Down")
LAST_LESSON = ("P", "Up")
LEAVE = ("Q", "Escape")


@dataclass(frozen=True)
class Lesson:
    """A lesson: its title, and a function that draws its steps, (H, W, 4) uint8."""

    title: str
    draw: Callable[[], Iterator[np.ndarray]]


class LessonWindow:
    """Shows lessons until the user closes the window, or presses Q or Escape.

    A step is drawn when it is first shown: all steps together may take seconds.

    Parameters
    ----------
    window : Window
        One that waits for events.
    lessons : sequence of Lesson
    number : int
        Index of the lesson to begin with.
    step_title : str
        What the title bar says of a step; {} stands for its number.
    """

    def __init__(
        self,
        window: Window,
        lessons: Sequence[Lesson],
        number: int = 0,
        step_title: str = "step {} - arrows: steps, N P: lessons",
    ):
        self._step_title = step_title
        self._window = window
        self._lessons = lessons
        self._open(number)

    def run(self) -> None:
        """Run until the window closes."""
        self._show()
        for event in self._window:
            match event:
                case events.KeyDown(key) if key in NEXT_STEP:
                    self._go_on()
                case events.KeyDown(key) if key in LAST_STEP:
                    self._go_back()
                case events.KeyDown(key) if key in NEXT_LESSON:
                    self._open(min(self._number + 1, len(self._lessons) - 1))
                case events.KeyDown(key) if key in LAST_LESSON:
                    self._open(max(self._number - 1, 0))
                case events.KeyDown(key) if key in LEAVE:
                    self._window.close()
                    continue
                case events.MouseButton("left", True):
                    self._go_on()
                case events.MouseButton("right", True):
                    self._go_back()
                case events.Resized():
                    pass
                case _:
                    continue
            self._show()

    def _open(self, number: int) -> None:
        """Start a lesson."""
        self._number, self._step = number, 0
        self._rest = self._lessons[number].draw()
        self._steps = [next(self._rest)]

    def _go_on(self) -> None:
        """Go to the next step, or to the next lesson after the last step."""
        if self._step + 1 == len(self._steps):
            self._steps += [step for step in [next(self._rest, None)] if step is not None]
        if self._step + 1 < len(self._steps):
            self._step += 1
        elif self._number + 1 < len(self._lessons):
            self._open(self._number + 1)

    def _go_back(self) -> None:
        """Go to the previous step, or to the last step of the previous lesson."""
        if self._step > 0:
            self._step -= 1
        elif self._number > 0:
            self._open(self._number - 1)
            self._steps += self._rest
            self._step = len(self._steps) - 1

    def _show(self) -> None:
        self._window.present(enlarged(self._steps[self._step], self._window.size))
        title = self._lessons[self._number].title
        self._window.title = f"{title} - {self._step_title.format(self._step + 1)}"


def enlarged(picture: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return a picture enlarged by a whole number, centred in a larger one.

    A picture too large to fit is returned unchanged.
    """
    height, width = picture.shape[:2]
    times = min(size[0] // width, size[1] // height)
    if times < 1:
        return picture
    shown = np.empty((size[1], size[0], 4), np.uint8)
    shown[:] = BACKDROP
    left, top = (size[0] - times * width) // 2, (size[1] - times * height) // 2
    large = picture.repeat(times, axis=0).repeat(times, axis=1)
    shown[top : top + times * height, left : left + times * width] = large
    return shown
