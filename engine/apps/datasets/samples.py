"""Samples: the input of a data set writer for one picture.

In: a scene as drawn, with labels of its nodes. Out: a `Sample`; masks of each thing's visible part,
and boxes around masks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...errors import InvalidArgumentError
from ...model.geometry.mesh import Mesh
from ...model.scene.cameras import Camera
from ...model.scene.instances import InstancedMesh
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from ...rendering.frame import Frame
from ...rendering.options import RenderOptions
from ...rendering.renderer import Renderer

#: Moves a scene to another moment; returns the camera and its pose there, None for the same.
Move: TypeAlias = Callable[[], tuple[Camera, NDArray[np.float64]] | None]


@dataclass
class Sample:
    """One picture of a data set, as its writer gets it.

    Parameters
    ----------
    name : str
        Of its files, without an extension; may have folders in it.
    index : int
        Its place in the data set, from 0 on.
    frame : Frame
        With the outputs that the writer asks for.
    scene : Scene
        As it was drawn.
    camera : Camera
    pose : (4, 4) float64
        world-from-camera.
    renderer : Renderer
        What drew it, for further frames of the same view.
    labels : mapping of Node to str, optional
        The things to be found, and their categories. A node stands for all that hangs below it.
        Left out: each node that holds a mesh is a thing, and its name its category.
    options : RenderOptions
        How it was drawn.
    seed : int
    to_next, to_previous : callable, optional
        Moves the scene to the next or previous picture's moment, for optical flow. Called without
        arguments, perhaps one after the other; returns ``(camera, pose)``, or None where these stay
        the same.
    """

    name: str
    index: int
    frame: Frame
    scene: Scene
    camera: Camera
    pose: NDArray[np.float64]
    renderer: Renderer
    labels: Mapping[Node, str] | None = None
    options: RenderOptions = field(default_factory=RenderOptions)
    seed: int = 0
    to_next: Move | None = None
    to_previous: Move | None = None

    def things(self) -> list[Thing]:
        """Return the labelled things, in order of node IDs.

        Raises
        ------
        InvalidArgumentError
            A label is no text, or is of what is no node of the scene.
        """
        if self.labels is None:
            chosen = {n: n.name or "object" for n in self.scene.nodes if _is_drawn(n)}
        else:
            chosen = dict(self.labels)
        known = set(self.scene.nodes)
        for node, category in chosen.items():
            if not (isinstance(node, Node) and node in known):
                raise InvalidArgumentError(f"labels: {node!r} is no node of the scene")
            if not (isinstance(category, str) and category):
                raise InvalidArgumentError(f"labels: {category!r} is no name of a category")
        nodes = sorted(chosen, key=lambda node: node.id)
        if self.labels is None:
            return [Thing(node, chosen[node], (node,)) for node in nodes]
        return [Thing(node, chosen[node], tuple(_below(node, chosen))) for node in nodes]


@dataclass(frozen=True)
class Thing:
    """A thing that can be detected in a picture.

    Attributes
    ----------
    node : Node
    category : str
    parts : tuple of Node
        Those that hold meshes: the node itself and what hangs below it.
    """

    node: Node
    category: str
    parts: tuple[Node, ...]

    def mask(self, object_id: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Return the thing's visible pixels, (H, W)."""
        ids = [part.id for part in self.parts]
        return object_id == ids[0] if len(ids) == 1 else np.isin(object_id, ids)


def _is_drawn(node: Node) -> bool:
    return isinstance(node.object, (Mesh, InstancedMesh)) and node.shown


def _below(node: Node, labelled: Mapping[Node, str]) -> Iterator[Node]:
    """Return the drawn nodes of a thing, without other things below it."""
    if _is_drawn(node):
        yield node
    for child in node.children:
        if child not in labelled:
            yield from _below(child, labelled)


def box_of(mask: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """Return x, y, width and height of the box around a mask; four zeros if it is empty."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if not len(rows):
        return 0, 0, 0, 0
    x, y = int(columns[0]), int(rows[0])
    return x, y, int(columns[-1]) + 1 - x, int(rows[-1]) + 1 - y
