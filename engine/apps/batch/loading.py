"""Models and textures that a process caches between pictures.

In: the paths of files. Out: meshes, textures and scenes, each file read once while it is among the
last few; each read file is recorded as an input of the picture. If a script changes an object, its
file is read again for the next picture.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NamedTuple

from ...base.calls import checks_types
from ...base.files.atomic_write import checked_path
from ...base.plugins.participants import participants
from ...base.plugins.plugin import Plugin
from ...base.plugins.registry import are_here
from ...errors import warn
from ...io.loaders import load_document
from ...io.reading.documents import Document
from ...io.reading.linked_files import found_files
from ...io.resources import Resources, versions_of
from ...io.scenes.scene_loading import scene_from_document
from ...model.geometry.mesh import Mesh
from ...model.materials.textures import Texture
from ...model.scene.scene import Scene
from .file_digests import Inputs, digest_of

#: Number of files that a process keeps loaded.
KEPT = 16


class Held(NamedTuple):
    """A cached file.

    Attributes
    ----------
    thing : object
    files : dict of str to str
        The hashes of the files that it came from, by path.
    plugins : list of Plugin
        Those that took part in reading them.
    """

    thing: Any
    files: dict[str, str | None]
    plugins: list[Plugin]


class LoadedFiles:
    """The files that one process, or one of its threads, keeps loaded."""

    def __init__(self) -> None:
        self._resources = Resources()
        self._kept: OrderedDict[tuple, Held] = OrderedDict()
        self.inputs: Inputs | None = None
        self.out = ""  # the output folder

    def mesh(self, path: str, options: dict[str, Any]) -> Mesh:
        """Return the mesh of a file, shared as by `Resources.load_mesh`."""
        return self._shared("mesh", self._resources.load_mesh, path, options)

    def texture(self, path: str, options: dict[str, Any]) -> Texture:
        """Return the texture of a file, shared as by `Resources.load_texture`."""
        return self._shared("texture", self._resources.load_texture, path, options)

    def scene(self, path: str, root: str | None = None) -> Scene:
        """Return a new scene of a file's contents, with cached meshes."""
        path = os.path.realpath(path)
        key = "scene", path, root, self.out
        held = self._kept.get(key)
        if held is None or _changed(held.thing):
            with _found(path) as (files, plugins):
                document = load_document(path, companion=not_written_to(self.out), root=root)
            held = Held((document, _versions(document)), files, plugins)
        self._keep(key, held)
        document = held.thing[0]
        scene = scene_from_document(document)
        # those of the document were already issued
        for text in scene.warnings[len(document.warnings) :]:
            warn(f"{path}: {text}")
        return scene

    def forget_changed(self) -> None:
        """Drop cached results of files that have changed, or whose plug-ins are gone."""
        for key, held in list(self._kept.items()):
            is_old = any(digest_of(path) != digest for path, digest in held.files.items())
            if is_old or not are_here(plugin.stamp for plugin in held.plugins):
                del self._kept[key]
                self._resources = Resources()

    def _shared(self, kind: str, load, path: str, options: dict[str, Any]):
        path = os.path.realpath(path)
        key = kind, path, tuple(sorted(options.items()))
        held = self._kept.get(key)
        with _found(path) as (files, plugins):
            thing = load(path, **options)  # cached files are not read again
        same = held is not None and held.thing is thing
        self._keep(key, held if same else Held(thing, files, plugins))
        return thing

    def _keep(self, key: tuple, held: Held) -> None:
        """Cache a result, and record its files."""
        self._kept[key] = held
        self._kept.move_to_end(key)
        while len(self._kept) > KEPT:
            self._kept.popitem(last=False)
        if self.inputs is not None:
            for path in held.files:
                self.inputs.note(path)
            for plugin in held.plugins:
                self.inputs.note_plugin(plugin)


@contextmanager
def _found(path: str) -> Iterator[tuple[dict[str, str | None], list[Plugin]]]:
    """Collect the paths read within the block, with their hashes before, and the plug-ins."""
    files, plugins = {path: digest_of(path)}, []

    def note(one: str) -> None:
        one = os.path.realpath(one)
        files.setdefault(one, digest_of(one))

    with found_files(note), participants(plugins.append):
        yield files, plugins


def _versions(document: Document) -> tuple:
    """Return versions that differ after any change to a document's meshes."""
    meshes = [mesh for _, mesh, _ in document.objects]
    if document.tree is not None:
        meshes += [part.mesh for record in document.tree.meshes for part in record.parts]
    if document.scene is not None:
        meshes += list(document.scene.meshes.values())
    return tuple(map(versions_of, meshes))


def _changed(held: tuple[Document, tuple]) -> bool:
    return _versions(held[0]) != held[1]


_current: ContextVar[LoadedFiles | None] = ContextVar("loaded_files", default=None)


def not_written_to(out: str) -> Callable[[str], bool]:
    """Return a test that an image beside a model is not a picture of the batch.

    A picture of a model in its folder, with its name, must not become its texture.
    """
    folder = os.path.realpath(out) + os.sep
    return lambda path: not os.path.realpath(path).startswith(folder)


@contextmanager
def loading(files: LoadedFiles, inputs: Inputs, out: str) -> Iterator[None]:
    """Make `load_mesh` and `load_texture` use the given files within the block."""
    files.forget_changed()
    token, files.inputs, files.out = _current.set(files), inputs, out
    try:
        yield
    finally:
        _current.reset(token)
        files.inputs = None


@checks_types
def load_mesh(path: str | os.PathLike[str], **options: Any) -> Mesh:
    """Load a mesh in a script: once per process, for all its pictures.

    The file, and the files it names, become inputs of the picture.

    Parameters
    ----------
    path : path-like
    **options
        As of `engine3d.load_mesh`.

    Raises
    ------
    FileFormatError, FileAccessError, InvalidArgumentError
    """
    return _files().mesh(checked_path(path), options)


@checks_types
def load_texture(path: str | os.PathLike[str], **options: Any) -> Texture:
    """Load a texture in a script, as `load_mesh` loads a mesh.

    Parameters
    ----------
    path : path-like
    **options
        As of `engine3d.load_texture`.

    Raises
    ------
    FileFormatError, FileAccessError, InvalidArgumentError
    """
    return _files().texture(checked_path(path), options)


def _files() -> LoadedFiles:
    """Return the files of the picture in progress, or new ones outside a batch."""
    files = _current.get()
    if files is None:
        files = LoadedFiles()
        _current.set(files)
    return files
