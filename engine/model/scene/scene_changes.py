"""Notices changes of a scene and of all that it draws, without visiting all of it.

In: a scene. Out: whether a picture of it may differ from one before. Scenes count the changes of
their nodes, and a `Watch` hears of changed meshes, materials and textures, so that a look costs as
much for many nodes as for one.
"""

from __future__ import annotations

from typing import Any

from ...base.dirty_tracking import Watch
from .scene import Scene
from .surroundings import SCENE_VALUES
from .usage import uses_in


class SceneChanges:
    """The changes of a scene since this was made; a scene may have several of these.

    Parameters
    ----------
    scene : Scene
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._state = self._look()
        self._watch = Watch(uses_in([scene]))

    @property
    def any(self) -> bool:
        """Whether the scene, or anything that it draws, has changed."""
        return bool(self._watch.found()) or self._look() != self._state

    def _look(self) -> tuple[Any, ...]:
        """Return what the scene itself counts."""
        scene, data = self._scene, self._scene.data
        data.update()
        moment = None if data.posing is None else data.posing.moment
        values = tuple(getattr(scene, name) for name in SCENE_VALUES)
        return data.census(), data.arrays.changes, data.objects.version, moment, values
