"""Loads meshes and textures with sharing: equal content is stored once.

In: files, or objects made elsewhere. Out: the shared object for the content, kept as long as
somebody else holds it. A file that changed on disk is reloaded on request, into the existing
objects, so that every scene shows it.
"""

from __future__ import annotations

import hashlib
import os
import threading
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn
from weakref import WeakValueDictionary

from ..base.calls import checks_types, shows_annotations
from ..base.files.stamps import FileState
from ..base.numbers import shown
from ..errors import Engine3DError, InvalidArgumentError, warn
from ..model.geometry.derived import arrays_of
from ..model.geometry.mesh import Mesh
from ..model.geometry.twins import take_over
from ..model.materials.material import (
    TEXTURE_SLOTS,
    Material,
    placed_textures_of,
    put_texture,
    textures_of,
)
from ..model.materials.textures import Texture, image_file_of, remember_image_file
from ..model.scene.usage import uses_in
from .loaders import load_mesh, load_texture
from .reading.linked_files import found_files
from .reading.open_files import unreadable

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ..model.materials.textures import TextureOptions
    from ..model.scene.scene import Scene


@shows_annotations
class ResourceStats(NamedTuple):
    """Statistics of a `Resources`.

    Attributes
    ----------
    meshes, textures : int
    mesh_bytes, texture_bytes : int
        Size of their arrays in Python.
    loads, shared : int
        The number of requests, and how many of them found an existing object.
    """

    meshes: int
    textures: int
    mesh_bytes: int
    texture_bytes: int
    loads: int
    shared: int


@shows_annotations
class Resource(NamedTuple):
    """A loaded mesh or texture.

    Attributes
    ----------
    name : str
        Its own name, or else that of its file.
    kind : {"mesh", "texture"}
    thing : Mesh or Texture
    size : int
        Size of its arrays in bytes.
    path : str or None
        The file it was loaded from.
    users : int
        How many nodes of the given scenes use it.
    """

    name: str
    kind: str
    thing: Mesh | Texture
    size: int
    path: str | None
    users: int


class Resources:
    """Loads meshes and textures, each content once.

    A shared thing is one object: changing it changes it for all users, and afterwards it is no
    longer shared with new loads of the old content.
    """

    def __init__(self) -> None:
        self._by_file: WeakValueDictionary[Any, Any] = WeakValueDictionary()
        self._by_content: WeakValueDictionary[Any, Any] = WeakValueDictionary()
        self._files: dict[tuple[Any, ...], _Loaded] = {}
        self._loads = self._shared = 0
        # Held for lookups and updates, not while files are read.
        self._lock = threading.RLock()

    def load_mesh(self, path: str | os.PathLike[str], **options: Any) -> Mesh:
        """Return the mesh of a file; parameters and exceptions as in `load_mesh`.

        Its textures are shared too.
        """
        return self._load(load_mesh, path, options)

    def load_texture(
        self, path: str | os.PathLike[str], **options: Unpack[TextureOptions]
    ) -> Texture:
        """Return the texture of a file; parameters and exceptions as in `load_texture`."""
        return self._load(load_texture, path, options)

    def share(self, thing: Mesh | Texture) -> Mesh | Texture:
        """Return the existing object with this content, or keep this one.

        Raises
        ------
        InvalidArgumentError
            The argument is neither a Mesh nor a Texture.
        """
        if not isinstance(thing, (Mesh, Texture)):
            raise InvalidArgumentError(f"thing must be a Mesh or Texture, not {shown(thing)}")
        with self._lock:
            self._loads += 1
            return self._same(thing)

    def reload_changed(self) -> tuple[str, ...]:
        """Reload the files that changed since they were loaded; return their paths.

        A model also counts as changed if a file that it names, such as a texture, changed. If a
        file is now damaged or missing, its object stays as it is, with an `Engine3DWarning`.
        """
        done = []
        for key, loaded in list(self._files.items()):
            thing = self._by_file.get(key)
            if thing is None:
                self._files.pop(key, None)
                continue
            if not any(state.changed() for state in loaded.states.values()):
                continue
            loaded.states = {path: FileState(path) for path in loaded.states}
            path = key[1]
            try:
                fresh, states = _read(loaded.load, path, loaded.options)
            except Engine3DError as error:
                warn(f"not loaded again: {error}")
                continue
            with self._lock:
                self._forget_content(thing)
                become(thing, fresh)
                loaded.states, loaded.versions = states, versions_of(thing)
            done.append(path)
        return tuple(done)

    def listed(self, *scenes: Scene) -> tuple[Resource, ...]:
        """Return the loaded things, each once, in loading order.

        Parameters
        ----------
        *scenes : Scene
            Scenes whose nodes count as users.
        """
        uses = uses_in(scenes)
        paths = {id(thing): key[1] for key, thing in list(self._by_file.items())}
        return tuple(
            Resource(
                thing.name or os.path.basename(paths.get(id(thing), "")),
                "mesh" if isinstance(thing, Mesh) else "texture",
                thing,
                size_of(thing),
                paths.get(id(thing)),
                uses.get(thing, 0),
            )
            for thing in self._things()
        )

    @checks_types
    def find(self, name: str) -> Mesh | Texture | None:
        """Return the first loaded thing with a name, or None."""
        return next((entry.thing for entry in self.listed() if entry.name == name), None)

    def _things(self) -> list[Mesh | Texture]:
        with self._lock:
            things = {id(thing): thing for thing in self._by_content.values()}
            things.update((id(thing), thing) for thing in self._by_file.values())
        return list(things.values())

    @property
    def stats(self) -> ResourceStats:
        """The current counts and sizes."""
        things = self._things()
        meshes = [thing for thing in things if isinstance(thing, Mesh)]
        textures = [thing for thing in things if isinstance(thing, Texture)]
        return ResourceStats(
            len(meshes),
            len(textures),
            sum(map(size_of, meshes)),
            sum(map(size_of, textures)),
            self._loads,
            self._shared,
        )

    def __reduce_ex__(self, protocol: Any) -> NoReturn:
        raise TypeError("Resources cannot be copied or pickled: they are what is shared")

    def _load(self, load: Any, path: Any, options: Any) -> Any:
        if not isinstance(path, (str, os.PathLike)):
            kind = type(path).__name__
            raise InvalidArgumentError(f"resources are loaded by their paths, not from {kind}")
        name = _real_path(path)
        key = (load.__name__, name, tuple(sorted(options.items())))
        with self._lock:
            self._loads += 1
            thing = self._known(key)
        if thing is not None:
            return thing
        thing, states = _read(load, name, options)
        with self._lock:
            return self._known(key) or self._keep(key, thing, _Loaded(load, options, states))

    def _known(self, key: tuple[Any, ...]) -> Any:
        """Return the thing loaded by the same call, unless it was changed since."""
        thing, loaded = self._by_file.get(key), self._files.get(key)
        if thing is None or loaded is None or loaded.versions != versions_of(thing):
            return None
        self._shared += 1
        return thing

    def _keep(self, key: tuple[Any, ...], thing: Any, loaded: _Loaded) -> Any:
        """Return the object for what was read: this one, or an existing equal one."""
        for material in thing.materials if isinstance(thing, Mesh) else ():
            for slot, texture in textures_of(material).items():
                put_texture(material, slot, self._same(texture, count=False))
        thing = self._same(thing)
        loaded.versions = versions_of(thing)
        self._files[key] = loaded
        self._by_file[key] = thing
        return thing

    def _same(self, thing: Any, *, count: bool = True) -> Any:
        """Return an object with equal content, unless it was changed since."""
        content = _content(thing)
        other = self._by_content.get(content)
        if other is not None and (other is thing or _content(other) == content):
            self._shared += count
            return other
        self._by_content[content] = thing
        return thing

    def _forget_content(self, thing: Any) -> None:
        for content, other in list(self._by_content.items()):
            if other is thing:
                del self._by_content[content]


def _real_path(path: str | os.PathLike[str]) -> str:
    try:
        return os.path.realpath(os.fspath(path))
    except (OSError, ValueError) as error:
        raise unreadable(os.fspath(path), error) from error


class _Loaded:
    """How a file was loaded: the function, its options, and the states of all files read."""

    def __init__(self, load: Any, options: dict[str, Any], states: dict[str, FileState]) -> None:
        self.load, self.options, self.states = load, options, states
        self.versions: tuple[Any, ...] = ()


def versions_of(thing: Mesh | Texture) -> tuple[Any, ...]:
    """Return the versions of a thing, which differ after any change to it."""
    materials = thing.materials if isinstance(thing, Mesh) else ()
    textures = (texture for material in materials for texture in textures_of(material).values())
    return tuple(part.version for part in (thing, *materials, *textures))


def _read(
    load: Any, path: str, options: dict[str, Any]
) -> tuple[Mesh | Texture, dict[str, FileState]]:
    """Load a file; return the result, and the states of all files before they were read."""
    states = {path: FileState(path)}

    def note(found: str) -> None:
        if found not in states:
            states[found] = FileState(found)

    with found_files(note):
        thing = load(path, **options)
    return thing, states


def size_of(thing: Mesh | Texture) -> int:
    """Return the size of a thing's arrays in bytes, as Python holds them."""
    if isinstance(thing, Texture):
        return thing.pixels.nbytes
    return sum(array.nbytes for array in arrays_of(thing).values() if array is not None)


def _content(thing: Any) -> tuple[Any, ...]:
    """Return a key that is equal for things with equal content, regardless of names."""
    digest = hashlib.blake2b(digest_size=20)
    if isinstance(thing, Texture):
        digest.update(thing.pixels.data)
        kind = thing.color_space, thing.filter, thing.wrap, thing.anisotropy, thing.lod_bias
        return ("texture", digest.digest(), thing.pixels.shape, *kind)
    shapes = []
    for name, array in sorted(arrays_of(thing).items()):
        shapes.append((name, None if array is None else (array.shape, array.dtype.str)))
        if array is not None:
            digest.update(array)
    materials = tuple(_material_content(material) for material in thing.materials)
    groups = tuple((name, array.tobytes()) for name, array in thing.groups.items())
    values = tuple(
        (name, on, array.shape, array.dtype.str, array.tobytes())
        for name, (array, on) in thing.values.held().items()
    )
    return ("mesh", digest.digest(), tuple(shapes), materials, groups, values)


def _material_content(material: Material) -> tuple[Any, ...]:
    unseen = {*TEXTURE_SLOTS, "version"}
    look = [value for name, value in vars(material).items() if name not in unseen]
    placed = placed_textures_of(material)
    textures = tuple(
        (slot, use.uv_set, use.offset, use.rotation, use.scale, _content(use.texture))
        for slot, use in placed.items()
    )
    return (*map(repr, look), textures)


def become(thing: Mesh | Texture, fresh: Any) -> None:
    """Replace the content of an object with that of another of its kind."""
    if isinstance(thing, Texture):
        thing.pixels = fresh.pixels
        remember_image_file(thing, image_file_of(fresh))
    else:
        take_over(thing, fresh)
