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

    def take_moves(self) -> bool:
        """Forget all changes if they are only such of places; return whether they are.

        Nodes and instances may move, and nodes deform, hide or show.
        """
        content, _ = now = self._look()
        if self._watch.found() or content != self._state[0]:
            return False
        self._state = now
        return True

    def _look(self) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return what the scene itself counts: of its content, and of where that is."""
        scene, data = self._scene, self._scene.data
        data.update()
        moment = None if data.posing is None else data.posing.moment
        values = tuple(getattr(scene, name) for name in SCENE_VALUES)
        return (data.census(), data.objects.version, values), (data.arrays.changes, moment)
