"""A scene and what is put beside it, drawn as one: neither holds anything of the other.

In: a scene; nodes that are drawn after its own, values that take the place of its own, and what of
it is hidden. Out: what a renderer reads of a scene, and the scene itself as it was.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from .nodes import Node
from .scene import Scene
from .staged_data import StagedData
from .surroundings import SCENE_VALUES, Surroundings


class StagedScene(Surroundings):
    """A scene, and what is drawn with it.

    Parameters
    ----------
    scene : Scene
        Stays as it is.

    Attributes
    ----------
    scene : Scene
    beside : Scene
        Its nodes are drawn after those of the scene, with ids above theirs.
    background, ambient, light_clamp, exposure, …
        As of `Scene`: those of the scene, until they are assigned.
    """

    scene: Scene
    beside: Scene
    data: StagedData  # for the engine's own parts, as of `Scene`

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
        """Take away all that is beside the scene."""
        self.beside = Scene()
        self.data.added = self.beside.data

    def keep_lights(self, kept: bool) -> None:
        """Let the lights of the scene shine, or not."""
        self.data.keeps_lights = kept

    def show_textures(self, shown: bool) -> None:
        """Draw the materials of the scene with their textures, or without."""
        self.data.shows_textures = shown

    def hide(self, nodes: Iterable[Node], part_of: Callable[[Any], Any] | None = None) -> None:
        """Leave nodes of the scene out of pictures, but not those below them; all others show.

        Parameters
        ----------
        nodes : iterable of Node
        part_of : callable, optional
            Called with a `Mesh` or `InstancedMesh`; returns what is drawn of it.
        """
        self.data.hidden, self.data.part_of = frozenset(nodes), part_of
        self.data.objects.forget_parts()

    def own_pixels(self, object_id: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Return which pixels of a frame's ``object_id`` show something of the scene itself."""
        return (object_id >= 0) & (object_id < self.data.first_added_id)

    @property
    def bounds(self) -> NDArray[np.float64]:
        """As of `Scene`."""
        return self.data.bounds()


#: What renderers draw.
AnyScene: TypeAlias = Scene | StagedScene
