"""The three functions that load files."""

from __future__ import annotations

import contextlib
import errno
import os
import warnings
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Literal

import numpy as np

from ...base.calls import checks_types
from ...errors import Engine3DWarning, FileFormatError, InvalidArgumentError
from ...model.geometry.creases import CREASE_ANGLE, check_crease_angle
from ...model.geometry.mesh import Mesh
from ...model.geometry.origins import FileOrigin, remember_origin
from ...model.materials.textures import ImageFile, Texture, remember_image_file
from ..formats.images import images_of_one_model
from .documents import Document
from .extents import extent_warnings
from .linked_files import checked_root
from .reader_registry import find_reader
from .sources import File, Source, read_source

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ...model.materials.textures import TextureOptions


# Told the share of the work that is done; what it returns does not matter.
Progress = Callable[[float], object]


@checks_types
def load_mesh(
    path: File,
    *,
    format: str | None = None,
    progress: Progress | None = None,
    crease_angle: float = CREASE_ANGLE,
    root: str | os.PathLike[str] | None = None,
) -> Mesh:
    """Load a model as one mesh with its materials, in the file's coordinates.

    Parameters
    ----------
    path : str, path-like, bytes, binary file object or Traversable
        See `engine3d.loaders.formats` for what can be read. Files compressed by gzip are unpacked.
        Bytes are the content itself; what is not in a folder finds no material libraries and
        textures.
    format : str, optional
        The format's name, such as ``"obj"``. Left out, it is told by the content and the name.
    progress : callable, optional
        ``progress(fraction)`` is called with the share of the work that is done: 0.0 once the file
        is open, 1.0 at the end, never less than before. OBJ files call it every four
        megabytes; most formats tell the beginning and the end only. What it raises ends loading.
    crease_angle : float, optional
        Radians, 0 to pi, for files that have neither normals nor smoothing groups: edges whose
        triangles meet at more than this are drawn sharp, others smooth. 35 degrees if left out; pi
        makes all smooth, 0 all flat.
    root : path-like, optional
        A folder that files named in the model may be in, besides the model's own folder, which
        they may otherwise not leave: images in ``../images``, say. Names that are relative are
        looked for there, too, and the only folder that files are looked for in if the model is
        bytes.

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
    InvalidArgumentError
        There is no such ``format``, or ``path`` is none of these things.
    """
    root = checked_root(root)
    with read_source(path) as source:
        source = source._replace(crease_angle=check_crease_angle(crease_angle), root=root)
        document = _read_document(source, format, progress, split=False)
    return whole_mesh(document, source, format)


@checks_types
def load_document(
    path: File,
    *,
    format: str | None = None,
    progress: Progress | None = None,
    companion: Callable[[str], bool] | None = None,
    crease_angle: float = CREASE_ANGLE,
    scalars: Literal["vertices", "faces"] | None = None,
    root: str | os.PathLike[str] | None = None,
) -> Document:
    """Load everything that a model file holds: its objects one by one, lights and cameras.

    Other parameters and exceptions are those of `load_mesh`.

    Parameters
    ----------
    companion : callable, optional
        ``companion(path)`` tells whether the image ``path`` beside a model without materials may
        become its texture for its name alone (`companion_texture`); any may if left out.
    scalars : {"vertices", "faces"}, optional
        Read also numbers of vertices, or of faces, that have no meaning of their own:
        `Document.scalars`. Vertices are split where their faces have different numbers.
    """
    root = checked_root(root)
    with read_source(path) as source:
        source = source._replace(
            crease_angle=check_crease_angle(crease_angle), scalars=scalars, root=root
        )
        if companion is not None:
            source = source._replace(companion=companion)
        document = _read_document(source, format, progress, split=True)
    if companion is None:
        parts_of(document, source, format)
    return document


def whole_mesh(document: Document, source: Source, format: str | None) -> Mesh:
    """Return all meshes of a document as one, which knows its file."""
    meshes = [entry.mesh for entry in document.objects]
    with _faults_of(source):
        mesh = meshes[0] if len(meshes) == 1 else Mesh.concatenate(meshes)
    mesh.name = mesh.name or source.stem
    mesh.warnings = list(document.warnings)
    _remember(mesh, document, source, format, None)
    return mesh


def parts_of(document: Document, source: Source, format: str | None) -> dict[tuple[str, int], Mesh]:
    """Return the meshes of a document; each knows which part of the file it is.

    A part is named by the object's name, and how many of that name stand before it.
    """
    parts: dict[tuple[str, int], Mesh] = {}
    seen: dict[str, int] = {}
    for name, mesh, _ in document.objects:
        part = name, seen.get(name, 0)
        seen[name] = part[1] + 1
        parts[part] = mesh
        _remember(mesh, document, source, format, part)
    return parts


def _remember(
    mesh: Mesh,
    document: Document,
    source: Source,
    format: str | None,
    part: tuple[str, int] | None,
) -> None:
    """Note which part of a file a mesh is, unless that file alone would not give it again.

    A scene's file has no parts to be named, and what was read from another root could only be read
    from there.
    """
    if source.has_name and document.scene is None and source.root is None:
        origin = FileOrigin(
            os.path.abspath(source.path), format, part, crease_angle=source.crease_angle
        )
        remember_origin(mesh, origin)


@checks_types
def load_texture(
    path: File, *, format: str | None = None, **options: Unpack[TextureOptions]
) -> Texture:
    """Load an image as a texture.

    Parameters
    ----------
    path : str, path-like, bytes, binary file object or Traversable
        TGA, PNG, JPEG and whatever else Pillow reads. Bytes are the content itself.
    format : str, optional
        The format's name, such as ``"tga"``. Left out, it is told by the content and the name.
    **options
        Passed on to `Texture`: ``color_space``, ``filter``, ``wrap``, ``name``, ``anisotropy``,
        ``lod_bias``.

    Raises
    ------
    FileAccessError
        The file cannot be read.
    FileFormatError
        It is damaged, too large, or no image.
    InvalidArgumentError
        There is no such ``format``, or ``path`` is none of these things.
    """
    with read_source(path) as source:
        return texture_of(source, format, **options)


def texture_of(
    source: Source,
    format: str | None = None,
    *,
    is_data: bool = False,
    **options: Unpack[TextureOptions],
) -> Texture:
    """Return the texture of an open image; as `load_texture` otherwise.

    Where pixels are light, codes are proportional to it if they are data, or linear colours.
    """
    with _memory_of(source):
        reader = find_reader(source, "image", format)
    is_data = is_data or options.get("color_space") == "linear"
    with _faults_of(source):
        read = (reader.read_linear if is_data else None) or reader.read
        pixels = read(source)
    options.setdefault("name", os.path.basename(source.path) if source.has_name else "")
    texture = Texture(pixels, **options)
    if source.has_name:
        remember_image_file(texture, ImageFile(os.path.abspath(source.path)))
    return texture


def _read_document(
    source: Source, format: str | None, progress: Progress | None, *, split: bool
) -> Document:
    if progress is not None:
        source = source._replace(progress=progress)
    document = document_of(source, format, split=split)
    for message in document.warnings:
        warnings.warn(message, Engine3DWarning, stacklevel=3)
    return document


def document_of(source: Source, format: str | None, *, split: bool) -> Document:
    """Return what an open model file holds, without warning of anything."""
    with _memory_of(source):
        reader = find_reader(source, "mesh", format)
    source.progress(0.0)
    # Numbers out of range become infinite, and are treated as such.
    with _faults_of(source), np.errstate(all="ignore"), images_of_one_model():
        document = reader.read(source, split=split)
        document.warnings.extend(extent_warnings(document))
    document.up = reader.up
    source.progress(1.0)
    return document


@contextlib.contextmanager
def _memory_of(source: Source) -> Iterator[None]:
    """Name the file where there is no memory for it, or for the library that reads it."""
    try:
        yield
    except (MemoryError, ImportError, OSError) as error:
        # The loader of libraries has no type of error for this.
        is_of_loader = isinstance(error, ImportError) and "failed to map" in str(error)
        if isinstance(error, MemoryError) or is_of_loader or _is_lack(error):
            raise FileFormatError("needs more memory than there is", source.path) from error
        raise


def _is_lack(error: Exception) -> bool:
    return getattr(error, "errno", None) == errno.ENOMEM


@contextlib.contextmanager
def _faults_of(source: Source) -> Iterator[None]:
    """Name the file in errors of what is made of its content."""
    try:
        with _memory_of(source):
            yield
    except InvalidArgumentError as error:  # more of something than a mesh can hold
        raise FileFormatError(str(error), source.path) from error
