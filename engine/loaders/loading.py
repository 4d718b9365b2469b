"""The three functions that load files."""

from __future__ import annotations

import os
import warnings

from ..errors import Engine3DWarning, FileFormatError
from ..mesh import Mesh
from ..textures import Texture
from .documents import Document
from .registry import find_reader
from .sources import read_source


def load_mesh(path: str | os.PathLike) -> Mesh:
    """Load a model as one mesh with its materials, in the file's coordinates.

    Parameters
    ----------
    path : str or path-like
        See `engine3d.loaders.formats` for what can be read.

    Returns
    -------
    mesh : Mesh
        All objects of the file joined, triangles in the file's order. What was left out or
        replaced (a missing texture, say) stands in ``mesh.warnings``, and is warned of as
        `Engine3DWarning`.

    Raises
    ------
    FileAccessError
        The file cannot be read.
    FileFormatError
        It is damaged or in a format that is not known; the message names file and line.
    """
    document = _read_document(path, split=False)
    meshes = [entry.mesh for entry in document.objects]
    mesh = meshes[0] if len(meshes) == 1 else Mesh.concatenate(meshes)
    mesh.name = mesh.name or os.path.splitext(os.path.basename(os.fspath(path)))[0]
    mesh.warnings = list(document.warnings)
    return mesh


def load_document(path: str | os.PathLike) -> Document:
    """Load everything that a model file holds: its objects one by one, lights and cameras.

    Parameters and exceptions are those of `load_mesh`.
    """
    return _read_document(path, split=True)


def load_texture(path: str | os.PathLike, **options) -> Texture:
    """Load an image as a texture.

    Parameters
    ----------
    path : str or path-like
        TGA, PNG, JPEG and whatever else Pillow reads.
    **options
        Passed on to `Texture`: ``color_space``, ``filter``, ``wrap``, ``name``.

    Raises
    ------
    FileAccessError
        The file cannot be read.
    FileFormatError
        It is damaged, too large, or no image.
    """
    source = read_source(path)
    pixels = find_reader(source, "image").read(source)
    options.setdefault("name", os.path.basename(source.path))
    return Texture(pixels, **options)


def _read_document(path, *, split: bool) -> Document:
    source = read_source(path)
    reader = find_reader(source, "mesh")
    try:
        document = reader.read(source, split=split)
    except MemoryError as error:
        raise FileFormatError("needs more memory than there is", source.path) from error
    for message in document.warnings:
        warnings.warn(message, Engine3DWarning, stacklevel=3)
    return document
