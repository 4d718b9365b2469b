"""The public function that saves meshes."""

from __future__ import annotations

import os
from typing import Any, BinaryIO

from ...base.calls import checks_types
from ...base.files.atomic_write import AtomicFiles, StreamFiles, checked_path
from ...errors import InvalidArgumentError, located, warn
from ...model.geometry.mesh import Mesh
from .writer_registry import find_writer


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
        ``ascii`` : bool, for PLY and STL: text instead of little-endian binary.

    Raises
    ------
    FileAccessError
        The file cannot be written.
    InvalidArgumentError
        The format is unknown, lacks an option, or needs side files that a file object cannot have.
    """
    if not isinstance(mesh, Mesh):
        raise InvalidArgumentError(f"mesh must be a Mesh, not {type(mesh).__name__}")
    target: Any = path
    is_stream = hasattr(target, "write")
    name = "<stream>" if is_stream else checked_path(target)
    writer = find_writer(name, format)
    unknown = sorted(set(options) - set(writer.options))
    if unknown:
        raise InvalidArgumentError(f"{writer.name} files have no option {unknown[0]!r}")
    with StreamFiles(target) if is_stream else AtomicFiles() as files:
        told = writer.write(mesh, name, files, **options)
    for message in told:
        warn(located(message, name))
