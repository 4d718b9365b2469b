"""The time of what moves a scene: it is set, or goes on unless it is paused."""

from __future__ import annotations

from typing import NoReturn, SupportsIndex

from ...base.validation import Closed, finite
from ...errors import InvalidArgumentError
from .scene import Scene


class Clock(Closed):
    """Base of what moves a scene as time goes on.

    Parameters
    ----------
    scene : Scene

    Attributes
    ----------
    time : float
        Seconds, as far as `seek` and `advance` brought it.
    paused : bool
        Whether `advance` does nothing.

    Raises
    ------
    InvalidArgumentError
    """

    time: float
    paused: bool
    _speed = 1.0

    def __init__(self, scene: Scene) -> None:
        if not isinstance(scene, Scene):
            raise InvalidArgumentError(f"scene must be a Scene, not {type(scene).__name__}")
        self._scene = scene
        self.time = 0.0
        self.paused = False

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        name = type(self).__name__
        raise TypeError(f"an {name} belongs to its Scene: it cannot be copied or pickled")

    def seek(self, time: float) -> None:
        """Move everything to where it is at a time, in seconds."""
        self.time = finite(time, "time")
        self._move()

    def advance(self, seconds: float) -> None:
        """Let time go on, unless paused, and move everything."""
        if self._goes_on(seconds):
            self._move()

    def _goes_on(self, seconds: float) -> bool:
        """Let time go on, unless paused; return whether it did."""
        if not self.paused:
            self.time += finite(seconds, "seconds") * self._speed
        return not self.paused

    def _move(self) -> None:
        """Move everything to where it is at `time`."""
        raise NotImplementedError
