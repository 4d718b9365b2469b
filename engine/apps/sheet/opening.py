"""Opens the sources of a sheet: files, meshes and scenes alike.

In: the caller's sources. Out: a `ViewedScene`.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any, BinaryIO, TypeAlias

from ...errors import InvalidArgumentError, printable
from ...model.geometry.mesh import Mesh
from ...model.scene.scene import Scene
from ...stage.open_models import open_models
from ...stage.viewed_scene import ViewedScene

SheetSource: TypeAlias = str | os.PathLike[str] | BinaryIO | Mesh | Scene


def open_sources(sources: SheetSource | Iterable[SheetSource], **options: Any) -> list[ViewedScene]:
    """Return the viewed scene of one or several sources.

    Parameters
    ----------
    sources : path, binary file object, Mesh, Scene, or an iterable of these
    **options
        As of `engine3d.stage.open_model.open_model`, for files.

    Raises
    ------
    InvalidArgumentError
        There is none, or one is something else.
    FileFormatError, FileAccessError
    """
    is_one = isinstance(sources, (str, os.PathLike, Mesh, Scene)) or hasattr(sources, "read")
    if not is_one and not isinstance(sources, Iterable):
        raise InvalidArgumentError(
            f"models are paths, meshes or scenes, not {type(sources).__name__}"
        )
    given = [sources] if is_one else list(sources)
    if not given:
        raise InvalidArgumentError("a sheet needs a model")
    return [_open(source, options) for source in given]


def _open(source: Any, options: dict[str, Any]) -> ViewedScene:
    if isinstance(source, Scene):
        return ViewedScene(source, "scene", themed=True)
    if isinstance(source, Mesh):
        scene = Scene()
        scene.add(source, name=source.name)
        title = printable(source.name) or "mesh"
        return ViewedScene(scene, title, themed=True)
    if not isinstance(source, (str, os.PathLike)) and not hasattr(source, "read"):
        raise InvalidArgumentError(
            f"a model is a path, a Mesh or a Scene, not {type(source).__name__}"
        )
    return open_models([source], **options)
