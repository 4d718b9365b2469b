"""Models and textures that a process keeps between pictures.

In: the paths of files. Out: meshes, textures and scenes, each file read once for as long as it is
among the last few; whatever is read is taken down as something that the picture follows from. What
a script changed is read anew for the next picture: each sees the file as it is.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

from ..files.resources import Resources, versions_of
from ..geometry.mesh import Mesh
from ..loaders import load_document
from ..loaders.documents import Document
from ..loaders.linked_files import found_files
from ..materials.textures import Texture
from ..scene.loading import scene_from_document
from ..scene.scene import Scene
from .file_digests import InputFiles

#: Files that a process keeps loaded.
KEPT = 16


class LoadedFiles:
    """What one process, or one thread of it, keeps loaded."""

    def __init__(self) -> None:
        self._resources = Resources()
        self._kept: OrderedDict[tuple, tuple[Any, list[str]]] = OrderedDict()
        self.inputs: InputFiles | None = None

    def mesh(self, path: str, options: dict[str, Any]) -> Mesh:
        """Return the mesh of a file, as `Resources.load_mesh` shares it."""
        return self._shared("mesh", self._resources.load_mesh, path, options)

    def texture(self, path: str, options: dict[str, Any]) -> Texture:
        """Return the texture of a file, as `Resources.load_texture` shares it."""
        return self._shared("texture", self._resources.load_texture, path, options)

    def scene(self, path: str) -> Scene:
        """Return a scene of its own of what a file holds, with the meshes that are loaded."""
        path, key = os.path.realpath(path), ("scene", os.path.realpath(path))
        held = self._kept.get(key)
        if held is None or _changed(held[0]):
            with self._found(path) as found:
                document = load_document(path)
            held = (document, _versions(document)), found
        self._keep(key, held)
        return scene_from_document(held[0][0])

    def _shared(self, kind: str, load, path: str, options: dict[str, Any]):
        path = os.path.realpath(path)
        key = kind, path, tuple(sorted(options.items()))
        held = self._kept.get(key)
        with self._found(path) as found:
            thing = load(path, **options)  # what is kept is not read again
        self._keep(key, (thing, found if held is None or held[0] is not thing else held[1]))
        return thing

    @contextmanager
    def _found(self, path: str) -> Iterator[list[str]]:
        """Collect the paths that are read within the block."""
        found = [path]
        if self.inputs is not None:
            self.inputs.note(path)
        with found_files(lambda one: found.append(os.path.realpath(one))):
            yield found

    def _keep(self, key: tuple, held: tuple[Any, list[str]]) -> None:
        """Keep what is loaded, and take down the files that it came from."""
        self._kept[key] = held
        self._kept.move_to_end(key)
        while len(self._kept) > KEPT:
            self._kept.popitem(last=False)
        for path in held[1] if self.inputs is not None else ():
            self.inputs.note(path)


def _versions(document: Document) -> tuple:
    """What is another once somebody has changed a mesh of a document."""
    meshes = [mesh for _, mesh, _ in document.objects]
    if document.tree is not None:
        meshes += [part.mesh for record in document.tree.meshes for part in record.parts]
    if document.scene is not None:
        meshes += list(document.scene.meshes.values())
    return tuple(map(versions_of, meshes))


def _changed(held: tuple[Document, tuple]) -> bool:
    return _versions(held[0]) != held[1]


_current: ContextVar[LoadedFiles | None] = ContextVar("loaded_files", default=None)


@contextmanager
def loading(files: LoadedFiles, inputs: InputFiles) -> Iterator[None]:
    """Let `load_mesh` and `load_texture` go through some files within the block."""
    token, files.inputs = _current.set(files), inputs
    try:
        yield
    finally:
        _current.reset(token)
        files.inputs = None


def load_mesh(path: str | os.PathLike[str], **options: Any) -> Mesh:
    """Load a mesh in a script: once a process, whichever pictures show it.

    The file, and those that it names, become files that the picture follows from.

    Parameters
    ----------
    path : path-like
    **options
        As of `engine3d.load_mesh`.

    Raises
    ------
    FileFormatError, FileAccessError, InvalidArgumentError
    """
    return _files().mesh(os.fspath(path), options)


def load_texture(path: str | os.PathLike[str], **options: Any) -> Texture:
    """Load a texture in a script, as `load_mesh` does a mesh.

    Parameters
    ----------
    path : path-like
    **options
        As of `engine3d.load_texture`.

    Raises
    ------
    FileFormatError, FileAccessError, InvalidArgumentError
    """
    return _files().texture(os.fspath(path), options)


def _files() -> LoadedFiles:
    """Those of the picture that is drawn; outside of a batch, where scripts are tried, others."""
    files = _current.get()
    if files is None:
        files = LoadedFiles()
        _current.set(files)
    return files
