"""Reloads meshes and textures from changed files, or from new locations of missing ones.

In: objects from files. Out: commands that reload them into the same objects, so that all nodes show
the new content.
"""

from __future__ import annotations

import os

from ...base.language import translated
from ...errors import FileFormatError, InvalidArgumentError
from ...io.loaders import load_document, load_mesh, load_texture
from ...io.resources import become
from ...model.geometry.mesh import Mesh
from ...model.geometry.origins import FileOrigin, noted_origin
from ...model.materials.textures import Texture, image_file_of
from .contents import contents, put_contents
from .history import Command


class Reload(Command):
    """Reloads a mesh or texture from its file; materials become those of the file.

    Parameters
    ----------
    thing : Mesh or Texture
    path : path-like, optional
        Another file that takes the place of the thing's own.

    Raises
    ------
    InvalidArgumentError
        The thing is of no file.
    """

    def __init__(self, thing: Mesh | Texture, path: str | os.PathLike[str] | None = None) -> None:
        own = path_of(thing)
        if own is None and path is None:
            raise InvalidArgumentError(f"{thing!r} is of no file, or was changed since")
        self._thing = thing
        self._path = own if path is None else os.path.abspath(os.fspath(path))
        self._new: dict | None = None
        self.label = translated("Load {name} again", name=os.path.basename(self._path))

    def do(self) -> None:
        if self._new is not None:
            put_contents(self._thing, self._new)
            return
        fresh = self._loaded()
        self._old = contents(self._thing)
        become(self._thing, fresh)
        self._new = contents(self._thing)

    def undo(self) -> None:
        put_contents(self._thing, self._old)

    def _loaded(self) -> Mesh | Texture:
        if isinstance(self._thing, Texture):
            return load_texture(self._path)
        came = noted_origin(self._thing)
        is_of_file = came is not None and isinstance(came.origin, FileOrigin)
        origin = came.origin if is_of_file else FileOrigin(self._path, None, None)
        part = origin.part
        how = {"format": origin.format, "crease_angle": origin.crease_angle}
        if part is None:
            return load_mesh(self._path, **how)
        for _, mesh, _ in load_document(self._path, **how).objects:
            if (came := noted_origin(mesh)) is not None and came.origin.part == part:
                return mesh
        raise FileFormatError(f"it has no part {part[0]!r} number {part[1]}", self._path)


def path_of(thing: Mesh | Texture) -> str | None:
    """Return the file of a mesh or texture."""
    if isinstance(thing, Texture):
        return image_file_of(thing).path
    came = noted_origin(thing)
    return came.origin.path if came is not None and isinstance(came.origin, FileOrigin) else None
