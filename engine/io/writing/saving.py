"""The function that saves meshes."""

from __future__ import annotations

import os
import warnings
from typing import Any, BinaryIO

from ...base.calls import checks_types
from ...base.files.atomic_write import AtomicFiles, StreamFiles, checked_path
from ...errors import Engine3DWarning, InvalidArgumentError, located
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
    """Write a mesh to a file, so that it is there whole or not at all.

    Parameters
    ----------
    mesh : Mesh
    path : str, path-like or binary file object
        Its extension names the format: ``.obj`` (materials go to an ``.mtl`` beside it and textures
        to PNG files beside that, all under the model's name; of files that others wrote there under
        these names none is replaced), ``.ply``, ``.stl``, or ``.glb`` and ``.gltf`` (all in one
        file, with the materials as physical ones). Read again, the file gives the same
        arrays, as far as its format holds them; what it does not hold is warned of as
        `Engine3DWarning`. A file object needs ``format``, and takes no materials of OBJ.
    format : str, optional
        The format's name, whatever the extension.
    **options
        ``ascii`` : bool, of PLY and STL: text instead of little-endian binary.

    Raises
    ------
    FileAccessError
        The file cannot be written.
    InvalidArgumentError
        The format is not known, has no such option, or needs files beside a file object.
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
        warnings.warn(located(message, name), Engine3DWarning, stacklevel=2)
