"""What a scene that changes while it is read does to who reads it: one clear error.

In: a `Scene`, around a block that reads it. Out: nothing; or, where the block failed and nodes came
or went since it began, an error that says so instead of whatever it failed with.
"""

from __future__ import annotations

from .errors import SceneChangedError
from .scene import Scene


class UnchangedScene:
    """Context in which a scene's nodes stay the same, or else what fails is told to fail of that.

    Parameters
    ----------
    scene : Scene
    """

    __slots__ = ("_scene", "_then")

    def __init__(self, scene: Scene) -> None:
        self._scene = scene

    def __enter__(self) -> None:
        self._then = self._counts()

    def __exit__(self, kind, error, trace) -> None:
        if isinstance(error, Exception) and self._counts() != self._then:
            raise SceneChangedError(
                "nodes were added to the scene or removed while it was drawn: change a scene "
                "between frames, not from another thread during one"
            ) from error

    def _counts(self) -> tuple[int, int]:
        return self._scene._arrays.count, self._scene._removals
