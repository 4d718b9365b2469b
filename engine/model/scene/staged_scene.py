"""A scene drawn together with nodes beside it, without changing the scene.

In: a scene; nodes drawn after its own, values that override its own, and its hidden nodes. Out: the
data that a renderer reads; the scene itself is unchanged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..materials.material import Finish
from ..materials.textures import Reading
from .nodes import Node
from .scene import Scene
from .staged_data import StagedData
from .surroundings import SCENE_VALUES, Surroundings


class StagedScene(Surroundings):
    """A scene, and the nodes drawn with it.

    Parameters
    ----------
    scene : Scene
        The scene; it is not changed.

    Attributes
    ----------
    scene : Scene
    beside : Scene
        Its nodes are drawn after those of the scene, with ids above theirs.
    background, ambient, light_clamp, exposure, …
        As in `Scene`: the scene's own values, until they are assigned.
    """

    scene: Scene
    beside: Scene
    data: StagedData  # for the engine's own parts, as in `Scene`

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.beside = Scene()
        self.data = StagedData(scene.data, self.beside.data)

    def __getattr__(self, name: str) -> Any:
        """Return the scene's own value of anything that was not assigned."""
        if name[1:] not in SCENE_VALUES:
            raise AttributeError(f"a StagedScene has no {name}")
        return getattr(self.scene, name)

    def clear(self) -> None:
        """Remove all nodes beside the scene."""
        self.beside = Scene()
        self.data.added = self.beside.data

    def keep_lights(self, kept: bool) -> None:
        """Switch the scene's own lights on or off."""
        self.data.keeps_lights = kept

    def show_textures(self, shown: bool) -> None:
        """Switch the textures of the scene's materials on or off."""
        self.data.shows_textures = shown

    def read_textures(self, reading: Reading | None) -> None:
        """Read textures otherwise than they say.

        Parameters
        ----------
        reading : callable or None
            Called with a `Texture`; returns its anisotropy and its bias in this picture.
        """
        self.data.reading = reading

    def finish_materials(self, finish: Finish | None) -> None:
        """Draw materials otherwise than they say.

        Parameters
        ----------
        finish : callable or None
            As in `SceneData`.
        """
        self.data.finish = finish

    def hide(self, nodes: Iterable[Node], part_of: Callable[[Any], Any] | None = None) -> None:
        """Hide nodes of the scene, but not their children; all other nodes show.

        Parameters
        ----------
        nodes : iterable of Node
        part_of : callable, optional
            Called with a `Mesh` or `InstancedMesh`; returns the part of it to draw.
        """
        self.data.hidden, self.data.part_of = frozenset(nodes), part_of
        self.data.objects.forget_parts()

    def own_pixels(self, object_id: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Return which pixels of a frame's ``object_id`` show the scene's own nodes."""
        return (object_id >= 0) & (object_id < self.data.first_added_id)

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The scene's bounds, as in `Scene`."""
        return self.data.bounds()


#: The scenes that renderers draw.
AnyScene: TypeAlias = Scene | StagedScene
