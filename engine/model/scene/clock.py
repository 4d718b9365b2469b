"""The clock of animations: set by seeking, or advanced unless paused."""

from __future__ import annotations

from typing import NoReturn, SupportsIndex

from ...base.validation import Closed, finite
from ...errors import InvalidArgumentError
from .scene import Scene


class Clock(Closed):
    """Base of classes that move a scene over time.

    Parameters
    ----------
    scene : Scene

    Attributes
    ----------
    time : float
        Seconds, set by `seek` and increased by `advance`.
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
        """Set the time in seconds, and move everything to its state then."""
        self.time = finite(time, "time")
        self._move()

    def advance(self, seconds: float) -> None:
        """Advance the time, unless paused, and move everything."""
        if self._goes_on(seconds):
            self._move()

    def _goes_on(self, seconds: float) -> bool:
        """Advance the time, unless paused; return whether it advanced."""
        if not self.paused:
            self.time += finite(seconds, "seconds") * self._speed
        return not self.paused

    def _move(self) -> None:
        """Move everything to its state at `time`."""
        raise NotImplementedError
