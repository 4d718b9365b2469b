"""The public function that saves meshes."""

from __future__ import annotations

import os
from typing import Any, BinaryIO

from ...base.calls import checks_types
from ...base.files.atomic_write import AtomicFiles, StreamFiles, checked_path
from ...errors import InvalidArgumentError, located, warn
from ...model.geometry.mesh import Mesh
from ...model.scene.scene import Scene
from .writer_registry import Writer, find_writer


@checks_types
def save_mesh(
    mesh: Mesh,
    path: str | os.PathLike[str] | BinaryIO,
    *,
    format: str | None = None,
    **options: Any,
) -> None:
    """Write a mesh to a file, whole or not at all.

    Parameters
    ----------
    mesh : Mesh
    path : str, path-like or binary file object
        The extension selects the format: ``.obj`` (materials go to an ``.mtl`` beside it and
        textures to PNG files, all named after the model; foreign files with these names are not
        replaced), ``.ply``, ``.stl``, or ``.glb`` and ``.gltf`` (all in one file, with physical
        materials). Reading the file gives the same arrays, as far as the format holds them; losses
        are issued as `Engine3DWarning`. A file object needs ``format``, and cannot take OBJ
        materials.
    format : str, optional
        The format's name; overrides the extension.
    **options
        ``ascii`` : bool, for PLY and STL: text instead of little-endian binary. Writers of other
        packages (docs/plugins.md) have options of their own.

    Raises
    ------
    FileAccessError
        The file cannot be written.
    InvalidArgumentError
        The format is unknown, lacks an option, or needs side files that a file object cannot have.
    """
    if not isinstance(mesh, Mesh):
        raise InvalidArgumentError(f"mesh must be a Mesh, not {type(mesh).__name__}")
    writer = find_writer(_name_of(path), format)
    thing: Mesh | Scene = mesh
    if writer.of_scenes:
        thing = Scene()
        thing.add(mesh, name=mesh.name)
    write(thing, path, writer, **options)


def write(thing: Mesh | Scene, path: Any, writer: Writer, /, **options: Any) -> None:
    """Write what a writer takes to a path or a binary file object; otherwise as `save_mesh`."""
    name = _name_of(path)
    unknown = sorted(set(options) - set(writer.options))
    if unknown:
        raise InvalidArgumentError(f"{writer.name} files have no option {unknown[0]!r}")
    with StreamFiles(path) if hasattr(path, "write") else AtomicFiles() as files:
        told = writer.write(thing, name, files, **options)
    for message in told:
        warn(located(message, name))


def _name_of(path: Any) -> str:
    return "<stream>" if hasattr(path, "write") else checked_path(path)
