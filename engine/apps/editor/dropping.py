"""Files dropped on an edited scene: models become nodes, images textures.

In: a path, and the drop position. Out: an undoable command.
"""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike

from ...base.language import translated
from ...errors import InvalidArgumentError
from ...io.loaders import formats, load_document, load_texture
from ...io.reading.sources import stem_and_extension
from ...io.scenes.scene_loading import scene_from_document
from ...model.geometry.mesh import Mesh
from ...model.scene.nodes import Node
from ...model.scene.scene import Scene
from .history import Command
from .new_things.free_names import FreeNames
from .node_commands import AddNodes, copy_nodes
from .value_commands import SetValues


def drop_file(
    scene: Scene,
    path: str | os.PathLike[str],
    *,
    at: ArrayLike | None = None,
    onto: Node | None = None,
) -> Command:
    """Return the command for a dropped file.

    Parameters
    ----------
    scene : Scene
    path : path-like
        A model or a scene becomes a node of its name, with all that the file holds below it; an
        image becomes the texture of all materials of the node that it is dropped onto.
    at : (3,) float, optional
        World position of the middle of the model's underside; where its file places it if left
        out.
    onto : Node, optional
        The node under the mouse.

    Raises
    ------
    FileFormatError, FileAccessError
        The file cannot be read.
    InvalidArgumentError
        An image was not dropped onto a node with a mesh.
    """
    name = os.fspath(path)
    stem, extension = stem_and_extension(name)
    if any(extension in entry.extensions for entry in formats("image")):
        return _paint(name, onto)
    loaded = scene_from_document(load_document(name))
    offset = np.zeros(3) if at is None else np.asarray(at, np.float64) - _underside(loaded)

    def add(scene: Scene) -> None:
        free = FreeNames(scene.data.names()).free(stem)
        group = scene.add(name=free, translation=offset)
        tops = [node for node in loaded.nodes if node.parent is None]
        copy_nodes(scene, dict.fromkeys(tops, group))

    return AddNodes(scene, add, translated("Add {name}", name=os.path.basename(name)))


def _underside(scene: Scene) -> np.ndarray:
    """Return the centre of the lower side of the box around a scene."""
    low, high = scene.bounds
    middle = (low + high) * 0.5
    middle[1] = low[1]
    return middle


def _paint(name: str, onto: Node | None) -> Command:
    mesh = getattr(onto, "object", None)
    mesh = getattr(mesh, "mesh", mesh)  # for instances
    if not isinstance(mesh, Mesh):
        raise InvalidArgumentError("an image becomes a texture: drop it onto a node with a mesh")
    texture = load_texture(name)
    return SetValues(
        mesh.materials,
        {"texture": texture},
        translated("Paint with {name}", name=os.path.basename(name)),
    )
