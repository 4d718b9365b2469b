"""The function that saves meshes."""

from __future__ import annotations

import os
import warnings
from typing import Any

from ..atomic_write import checked_path
from ..errors import Engine3DWarning, InvalidArgumentError, located
from ..mesh import Mesh
from .registry import find_writer


def save_mesh(
    mesh: Mesh, path: str | os.PathLike[str], *, format: str | None = None, **options: Any
) -> None:
    """Write a mesh to a file, so that it is there whole or not at all.

    Parameters
    ----------
    mesh : Mesh
    path : str or path-like
        Its extension names the format: ``.obj`` (materials go to an ``.mtl`` beside it and textures
        to PNG files beside that, all under the model's name), ``.ply`` or ``.stl``. Read again, the
        file gives the same arrays, as far as its format holds them; what it does not hold is warned
        of as `Engine3DWarning`.
    format : str, optional
        The format's name, whatever the extension.
    **options
        ``ascii`` : bool, of PLY and STL: text instead of little-endian binary.

    Raises
    ------
    FileAccessError
        The file cannot be written.
    InvalidArgumentError
        The format is not known, or has no such option.
    """
    if not isinstance(mesh, Mesh):
        raise InvalidArgumentError(f"not a Mesh: {type(mesh).__name__}")
    path = checked_path(path)
    writer = find_writer(path, format)
    unknown = sorted(set(options) - set(writer.options))
    if unknown:
        raise InvalidArgumentError(f"{writer.name} files have no option {unknown[0]!r}")
    for message in writer.write(mesh, path, **options):
        warnings.warn(located(message, path), Engine3DWarning, stacklevel=2)
